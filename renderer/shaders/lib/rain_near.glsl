// Drops and flakes round the camera, on cylinders about it: each cell of a cylinder holds one or none (Z18, Z24).
#include "lib/rain_hash.glsl"

uniform float u_rain_fall_mps, u_rain_flake_mps, u_rain_shutter_s, u_rain_drop_m, u_rain_flake_m, u_rain_streaks;
uniform vec4 u_rain_fallen, u_flakes_fallen;  // rows that they have fallen on each cylinder, within ROWS
uniform float u_flakes_swirl;                 // turns, 0 … 1
uniform vec2 u_rain_wind;                     // m/s

const int CYLINDERS = 4;
const float CYLINDER_M[4] = float[4](2.0, 5.0, 11.0, 24.0);
const float RAIN_ROWS = 64.0, FULL_MM_H = 30.0, TURN = 6.28318530718;
// passes/rain.py has the same: metres of a row a metre of distance
const float DROP_ROW = 0.30, FLAKE_ROW = 0.05;

struct Place {
    vec3 chance;   // of what is in the cell
    vec2 at;       // in it, 0 … 1
    vec2 side_m;
};

// The cell of a cylinder in a direction; `slant` is how far things go sideways while they fall a metre.
Place rain_place(vec3 dir, int layer, vec2 side_m, float fallen, float slant) {
    float away = CYLINDER_M[layer], flat_part = max(length(dir.xy), 1e-3);
    float height = dir.z / flat_part * away;
    float cells = floor(TURN * away / side_m.x);
    float across = mod(atan(dir.y, dir.x) / TURN * cells + slant * height / side_m.x + cells, cells);
    int column = int(across);
    float up = height / side_m.y + fallen + RAIN_ROWS * rain_hash(ivec3(column, layer, 7)).x;
    int row = int(mod(floor(up), RAIN_ROWS));
    return Place(rain_hash(ivec3(column, row, layer)), vec2(fract(across), fract(up)), side_m);
}

float across_wind(vec3 dir) {
    vec2 flat_part = dir.xy / max(length(dir.xy), 1e-3);
    return dot(u_rain_wind, vec2(-flat_part.y, flat_part.x));
}

float drop_trace(vec3 dir, int layer, float pixel_m, float share) {
    float away = CYLINDER_M[layer], row_m = DROP_ROW * away + 0.6;
    Place p = rain_place(dir, layer, vec2(0.018 * away, row_m), u_rain_fallen[layer], across_wind(dir) / u_rain_fall_mps);
    if (p.chance.x > share) return 0.0;
    float long_m = min(u_rain_fall_mps * u_rain_shutter_s * (0.6 + 0.8 * p.chance.z), 0.9 * p.side_m.y);
    float width = max(u_rain_drop_m, 0.7 * pixel_m);
    float x = (p.at.x - 0.2 - 0.6 * p.chance.y) * p.side_m.x, y = (p.at.y - 0.5) * p.side_m.y;
    float ends = 1.0 - smoothstep(0.25 * long_m, 0.5 * long_m, abs(y));
    return min(u_rain_drop_m / width, 1.0) * exp(-x * x / (width * width)) * ends * 0.6;
}

float flake_spot(vec3 dir, int layer, float pixel_m, float share) {
    float away = CYLINDER_M[layer], side = FLAKE_ROW * away + 0.03;
    Place p = rain_place(dir, layer, vec2(side), u_flakes_fallen[layer], across_wind(dir) * 0.25 / u_rain_flake_mps);
    if (p.chance.x > share) return 0.0;
    float phase = TURN * (p.chance.z + u_flakes_swirl * (1.0 + floor(3.0 * p.chance.y)));
    vec2 centre = vec2(0.5) + vec2(0.18 * cos(phase) + 0.24 * (p.chance.y - 0.5), 0.12 * sin(phase));
    float size = 0.5 * u_rain_flake_m * (0.5 + p.chance.z), radius = max(size, 0.7 * pixel_m);
    vec2 off = (p.at - centre) * p.side_m;
    return min(size * size / (radius * radius), 1.0) * exp(-dot(off, off) / (radius * radius)) * 0.9;
}

// How much of a pixel drops and flakes hide that are nearer than `away_m`.
float rain_near(vec3 dir, float rate, float snow, float away_m, float pixel_angle) {
    float share = clamp(sqrt(rate / FULL_MM_H), 0.0, 1.0) * 0.5 * u_rain_streaks, clear = 1.0;
    float poles = 1.0 - smoothstep(0.80, 0.95, abs(dir.z));  // cylinders have no top
    if (poles <= 0.0 || share <= 0.0) return 0.0;
    for (int i = 0; i < CYLINDERS; ++i) {
        float way = CYLINDER_M[i] / max(length(dir.xy), 1e-3), pixel_m = way * pixel_angle;
        if (way > away_m) break;
        if (snow < 1.0) clear *= 1.0 - drop_trace(dir, i, pixel_m, share * (1.0 - snow));
        if (snow > 0.0) clear *= 1.0 - flake_spot(dir, i, pixel_m, share * snow);
    }
    return (1.0 - clear) * poles;
}
