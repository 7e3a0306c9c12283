// Air and haze over distance, on land, water and sky alike (L02, D38).
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/fog.glsl"
uniform sampler2D g_eye_depth;
uniform sampler2D hdr;
out vec4 out_radiance;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float eye_depth = texelFetch(g_eye_depth, pixel, 0).r;
    vec4 radiance = texelFetch(hdr, pixel, 0);
    vec3 ray = pixel_ray();
    float eye = u_camera.z - u_level_sea_level_m;
    if (eye_depth > 0.0) {
        vec3 relative = ray * eye_depth;
        float away = length(relative);
        radiance.rgb = fog(radiance.rgb, relative / away, eye, eye + relative.z, away);
    } else radiance.rgb = fog_over_sky(radiance.rgb, normalize(ray), eye);
    out_radiance = radiance;
}
#endif
