// The level's noise lattice: smooth value noise with its gradient. The twin is level/noise.py.

#include "level/tables.glsl"

const int LATTICE = 64;

float lattice_at(ivec2 cell) {
    int at = (cell.y & (LATTICE - 1)) * LATTICE + (cell.x & (LATTICE - 1));
    return texelFetch(u_tables, ivec2(at & (TABLE_TEXELS - 1), LATTICE_ROW + at / TABLE_TEXELS), 0).r;
}

vec3 value_noise(vec2 xy, float cell_m, ivec2 shift) {
    vec2 uv = xy / cell_m;
    vec2 base = floor(uv);
    ivec2 cell = ivec2(base) + shift;
    vec2 f = uv - base;
    vec2 w = f * f * (3.0 - 2.0 * f);
    vec2 dw = 6.0 * f * (1.0 - f) / cell_m;
    float v00 = lattice_at(cell), v10 = lattice_at(cell + ivec2(1, 0));
    float v01 = lattice_at(cell + ivec2(0, 1)), v11 = lattice_at(cell + ivec2(1, 1));
    float south = mix(v00, v10, w.x), north = mix(v01, v11, w.x);
    return vec3(mix(south, north, w.y), dw.x * mix(v10 - v00, v11 - v01, w.y), dw.y * (north - south));
}
