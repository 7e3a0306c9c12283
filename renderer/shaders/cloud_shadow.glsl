// How much of the sun comes through the clouds to each place at the sea's level (Z19).
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/cloud_light.glsl"
uniform float u_shadow_reach_m;     // half the map's side
uniform vec2 u_cloud_shadow_slant;  // metres towards the sun a metre up
uniform int u_shadow_steps;
uniform float u_shadow_sine, u_shadow_texels;  // of the sun; texels a side
out float out_through;

void main() {
    float texel = 2.0 * u_shadow_reach_m / u_shadow_texels;
    vec2 foot = (gl_FragCoord.xy - 0.5 * u_shadow_texels) * texel;
    float rise = (u_clouds_top_m - u_clouds_base_m) / float(u_shadow_steps), depth = 0.0;
    float lod = clamp(log2(texel / (u_clouds_scale_m / 128.0)), 0.0, 2.5);
    for (int i = 0; i < u_shadow_steps && depth < 8.0; ++i) {
        float altitude = u_clouds_base_m + (float(i) + 0.5) * rise;
        vec3 p = vec3(foot + u_cloud_shadow_slant * altitude, altitude);
        depth += cloud_extinction(p, altitude, lod, true) * rise / u_shadow_sine;
    }
    out_through = exp(-depth);
}
#endif
