// A view of clouds: VIEW_VALUE, a row's expression of cloud_views.py, over the whole picture.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/cloud_march.glsl"
uniform sampler2D u_clouds, u_clouds_depth, u_cloud_perlin;
out vec4 out_value;

const float TILES = 2.0;   // of a noise over the picture's height
const float SLICE = 0.37;  // height of the slice, in tiles

float samples() { return float(cloud_march(normalize(pixel_ray()), 0.5).samples); }

void main() {
    vec2 uv = gl_FragCoord.xy / u_size, at = TILES * (gl_FragCoord.xy - 0.5 * u_size) / u_size.y;
    vec4 cloud = textureLod(u_clouds, uv, 0.0);
    float distance_m = cloud.a < 1.0 ? textureLod(u_clouds_depth, uv, 0.0).r : 0.0;
    vec4 shape = textureLod(u_cloud_shape, vec3(at, SLICE), 0.0), detail = textureLod(u_cloud_detail, vec3(at, SLICE), 0.0);
    vec4 curl = textureLod(u_cloud_curl, at, 0.0);
    float perlin = textureLod(u_cloud_perlin, at, 0.0).r;
    float profile = textureLod(u_cloud_profile, vec2((uv.y * 63.0 + 0.5) / 64.0, (uv.x * 2.0 + 0.5) / 3.0), 0.0).r;
    out_value = vec4(VIEW_VALUE, 1.0);
}
#endif
