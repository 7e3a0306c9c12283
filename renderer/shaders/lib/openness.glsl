// The map of the open sky (passes/openness.py; L02, L03): one fetch for what the land round a point does to its light.
#include "lib/height.glsl"

uniform sampler2D u_openness;  // open, rough × 2, bent normal east and north about one half

struct Openness {
    float open;   // share of the sky, weighted by the cosine, that the land leaves free; 1 on a plane
    float rough;  // change of slope round the place: a crease leaves one way straight, broken rock bends them all
    vec2 bent;    // east and north of the mean way to the free sky
};

Openness openness_at(vec2 xy) {
    vec2 last = vec2(textureSize(u_height, 0) - 1) * u_cell_m, size = vec2(textureSize(u_openness, 0));
    vec4 v = textureLod(u_openness, (clamp(xy / last, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.0);
    // beyond the border the land is made up: where it begins to sink is no crease
    vec2 within = min(xy, last - xy);
    float inside = min(within.x, within.y);
    float kept = smoothstep(-20.0, 0.0, inside);
    return Openness(mix(1.0, v.r, kept), 0.5 * v.g * smoothstep(9.0, 14.0, inside), (v.ba * 2.0 - 1.0) * kept);
}
