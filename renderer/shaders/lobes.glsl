// One octahedral map of the sky for one roughness: GGX lobes about the mirrored ray, view and normal taken for the same
// (Karis, Real Shading in Unreal Engine 4, 2013).
#define MAKE_LOBES
#include "lib/frame.glsl"
#include "lib/lobes.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/fog.glsl"
#ifdef HIGH_CLOUDS
#include "lib/high_light.glsl"
#endif
#ifdef CLOUDS
#include "lib/cloud_dome.glsl"
uniform sampler2D u_cloud_dome;
#endif
uniform int u_level;
uniform float u_cirrus;
uniform vec3 u_ground_radiance;
out vec4 out_radiance;
const int DIRECTIONS = 48;

vec3 world(vec3 dir) {
    vec3 up = sky_seen(vec3(dir.xy, max(dir.z, 0.0)), u_cirrus);
#ifdef HIGH_CLOUDS
    up = high_layers(up, vec3(dir.xy, max(dir.z, 0.0)), u_camera.xy, 1.0, 0.02);
#endif
    up = fog_over_sky(up, dir, 1.0);
#ifdef CLOUDS
    vec4 clouds = textureLod(u_cloud_dome, dome_place(dir), 0.0);
    up = up * clouds.a + clouds.rgb;
#endif
    return mix(u_ground_radiance, up, smoothstep(-0.03, 0.0, dir.z));
}

float radical_inverse(uint n) {
    n = (n << 16u) | (n >> 16u);
    n = ((n & 0x55555555u) << 1u) | ((n & 0xAAAAAAAAu) >> 1u);
    n = ((n & 0x33333333u) << 2u) | ((n & 0xCCCCCCCCu) >> 2u);
    n = ((n & 0x0F0F0F0Fu) << 4u) | ((n & 0xF0F0F0F0u) >> 4u);
    n = ((n & 0x00FF00FFu) << 8u) | ((n & 0xFF00FF00u) >> 8u);
    return float(n) * 2.3283064365386963e-10;
}

void main() {
    vec2 texel = gl_FragCoord.xy - vec2(0.0, LOBE_FROM[u_level]);
    vec3 n = oct_decode((texel - 1.0) / (LOBE_SIZE[u_level] - 2.0));
    float roughness = LOBE_ROUGHNESS[u_level];
    vec3 sum = vec3(0.0);
    if (roughness == 0.0) sum = world(n);
    else {
        vec3 side = normalize(abs(n.z) < 0.9 ? vec3(-n.y, n.x, 0.0) : vec3(0.0, -n.z, n.y)), other = cross(n, side);
        float alpha = roughness * roughness, weight = 0.0;
        for (int i = 0; i < DIRECTIONS; ++i) {
            float u = (float(i) + 0.5) / float(DIRECTIONS), phi = 6.28318530718 * radical_inverse(uint(i));
            float z2 = (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u), flat_part = sqrt(max(1.0 - z2, 0.0));
            vec3 h = flat_part * (cos(phi) * side + sin(phi) * other) + sqrt(z2) * n;
            vec3 l = reflect(-n, h);
            float n_l = dot(n, l);
            if (n_l <= 0.0) continue;
            sum += world(l) * n_l;
            weight += n_l;
        }
        sum /= max(weight, 1e-4);
    }
    out_radiance = vec4(min(sum, 60000.0), 1.0);
}
#endif
