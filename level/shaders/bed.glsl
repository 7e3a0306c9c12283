// The bed as the waves know it: ShoreMap.packed, read with texelFetch and interpolated by hand, because texture units
// keep 8 bits of the fraction and the CPU twin must agree within a millimetre (D30). The twin is level/shore.py.

#include "level/dual.glsl"

// RGBA32F: clock depth, depth, sea, clock depth without rocks, at mean sea level; above these rows those of rivers
uniform sampler2D u_bed;
uniform int u_bed_rows;
uniform float u_bed_cell_m;
uniform float u_tide_m;  // how far the sea stands over that
uniform bool u_tide_on;  // with a tide, the third number is the one over which a cell is sea

const float BEYOND_M = 80.0;  // how far past the level's border shore waves go on

ivec2 bed_size() { return ivec2(textureSize(u_bed, 0).x, u_bed_rows); }

struct Bed {
    vec3 clock;   // duals: depth the shore clock reads (monotone on the way to land), m
    vec3 depth;   // depth, m, negative on land
    vec3 sea;     // 1 where the water is connected to the sea
    vec3 within;  // 1 in the level, fading to 0 beyond its border: there the bed is only a guess
    vec3 smoothed;  // clock depth without rocks: what the water's body is lifted over
};

vec4 bed_texel(ivec2 cell) {
    vec4 bed = texelFetch(u_bed, cell, 0);
    if (u_tide_on) bed.z = float(bed.z < u_tide_m);
    return bed;
}

Bed bed_at(vec2 xy) {
    vec2 size = vec2(bed_size());
    vec2 at = xy / u_bed_cell_m;
    vec2 inside = clamp(at, vec2(0.0), size - 1.0);
    vec2 base = min(floor(inside), size - 2.0);
    vec2 f = inside - base;
    ivec2 cell = ivec2(base);
    vec4 v00 = bed_texel(cell), v10 = bed_texel(cell + ivec2(1, 0));
    vec4 v01 = bed_texel(cell + ivec2(0, 1)), v11 = bed_texel(cell + ivec2(1, 1));
    vec4 v = mix(mix(v00, v10, f.x), mix(v01, v11, f.x), f.y) + vec4(u_tide_m, u_tide_m, 0.0, u_tide_m);
    vec4 dx = mix(v10 - v00, v11 - v01, f.y) / u_bed_cell_m * float(at.x == inside.x);
    vec4 dy = mix(v01 - v00, v11 - v10, f.x) / u_bed_cell_m * float(at.y == inside.y);
    vec2 out_m = (at - inside) * u_bed_cell_m;
    float away = length(out_m);
    vec3 within = d_const(1.0) - d_step(0.0, BEYOND_M, vec3(away, out_m / max(away, 1e-6)));
    return Bed(vec3(v.x, dx.x, dy.x), vec3(v.y, dx.y, dy.y), vec3(v.z, dx.z, dy.z), within, vec3(v.w, dx.w, dy.w));
}
