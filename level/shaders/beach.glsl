// What the sea knows of the beach (H10, H20): BeachMap.packed, bilinear by hand. The twin is level/beach_map.py.
#include "level/dual.glsl"

uniform sampler2D u_beach;  // RG16F: sand over the still sea, m; sway −1 … 1
uniform float u_beach_cell_m;
uniform float u_shore_slide, u_shore_sway;

const float NO_BEACH_M = -64.0;

struct Beach {
    vec3 sand;  // duals
    vec3 sway;
};

const Beach NO_BEACH = Beach(vec3(NO_BEACH_M, 0.0, 0.0), vec3(0.0));

Beach beach_at(vec2 xy) {
    vec2 size = vec2(textureSize(u_beach, 0));
    vec2 at = xy / u_beach_cell_m;
    vec2 inside = clamp(at, vec2(0.0), size - 1.0);
    vec2 base = min(floor(inside), size - 2.0);
    vec2 f = inside - base;
    ivec2 cell = ivec2(base);
    vec2 v00 = texelFetch(u_beach, cell, 0).rg, v10 = texelFetch(u_beach, cell + ivec2(1, 0), 0).rg;
    vec2 v01 = texelFetch(u_beach, cell + ivec2(0, 1), 0).rg, v11 = texelFetch(u_beach, cell + ivec2(1, 1), 0).rg;
    vec2 v = mix(mix(v00, v10, f.x), mix(v01, v11, f.x), f.y);
    vec2 dx = mix(v10 - v00, v11 - v01, f.y) / u_beach_cell_m * float(at.x == inside.x);
    vec2 dy = mix(v01 - v00, v11 - v10, f.x) / u_beach_cell_m * float(at.y == inside.y);
    return Beach(vec3(at == inside ? v.x : NO_BEACH_M, dx.x, dy.x), vec3(v.y, dx.y, dy.y));
}
