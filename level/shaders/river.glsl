// Water that isn't the sea (D13): its level over the sea, and what it leaves of the sea's waves. The second block of
// u_bed is RiverMap.packed, read as the bed is. The twins are level/river_map.py and level/river_water.py.
#include "level/bed.glsl"

uniform float u_river_wave_m, u_river_wave_cycles;  // height, cycles a metre
uniform vec2 u_river_wave_time;                     // cycles gone, of both trains

const float RIVER_JOIN_M = 0.12;
const vec2 RIVER_DROWNED_M = vec2(0.02, 0.5);

struct River {
    vec3 rise;   // duals: how far the water stands over the sea, m, its own waves included
    vec3 waves;  // what comes there of the sea's swell, × amplitude
    vec3 chop;   // and of its chop
    float share; // of a place that is its own water, 0 … 1
    float still; // rise without waves
    float rough; // 0 … 1
    float along; // metres down its way
    float white; // how far the current has the chop break, 0 … 1 (D35)
    vec3 own;    // duals: share, and `still`
    vec3 level;
};

// The higher of a level and the sea (0), rounded off within RIVER_JOIN_M of it.
vec3 over_sea(vec3 level) {
    float u = clamp((level.x + RIVER_JOIN_M) / (2.0 * RIVER_JOIN_M), 0.0, 1.0);
    return u < 1.0 ? vec3(RIVER_JOIN_M * u * u, u * level.yz) : level;
}

vec3 river_waves(vec3 along, float rough) {
    vec2 height = u_river_wave_m * rough * vec2(0.6, 0.4), cycles = u_river_wave_cycles * vec2(1.0, 1.618034);
    vec2 phase = 6.28318530718 * fract(along.x * cycles - u_river_wave_time);
    vec2 slope = 6.28318530718 * cycles * height * cos(phase);
    return vec3(dot(height, sin(phase)), (slope.x + slope.y) * along.yz);
}

// Swell, chop, white, rough of a sample: code_of_waves in Python.
vec4 waves_of_code(float code) {
    float waves = max(code, 0.0), above = floor(waves / 512.0), white = floor(above / 512.0);
    return vec4((waves - above * 512.0) / 255.0, (above - white * 512.0) / 255.0, white / 63.0, max(-code, 0.0));
}

River river_at(vec2 xy) {
    ivec2 size = bed_size();
    vec2 at = xy / u_bed_cell_m;
    vec2 inside = clamp(at, vec2(0.0), vec2(size) - 1.0);
    vec2 base = min(floor(inside), vec2(size) - 2.0);
    vec2 f = inside - base;
    ivec2 cell = ivec2(base) + ivec2(0, size.y);
    vec4 v00 = texelFetch(u_bed, cell, 0), v10 = texelFetch(u_bed, cell + ivec2(1, 0), 0);
    vec4 v01 = texelFetch(u_bed, cell + ivec2(0, 1), 0), v11 = texelFetch(u_bed, cell + ivec2(1, 1), 0);
    vec3 v = mix(mix(v00.xyz, v10.xyz, f.x), mix(v01.xyz, v11.xyz, f.x), f.y);
    vec2 within = vec2(equal(at, inside)) / u_bed_cell_m;
    vec3 dx = mix(v10.xyz - v00.xyz, v11.xyz - v01.xyz, f.y) * within.x;
    vec3 dy = mix(v01.xyz - v00.xyz, v11.xyz - v10.xyz, f.x) * within.y;
    vec4 w00 = waves_of_code(v00.w), w10 = waves_of_code(v10.w), w01 = waves_of_code(v01.w), w11 = waves_of_code(v11.w);
    vec4 w = mix(mix(w00, w10, f.x), mix(w01, w11, f.x), f.y);
    vec2 w_dx = mix(w10.xy - w00.xy, w11.xy - w01.xy, f.y) * within.x;
    vec2 w_dy = mix(w01.xy - w00.xy, w11.xy - w10.xy, f.x) * within.y;
    vec3 share = vec3(v.y, dx.y, dy.y), along = vec3(v.z, dx.z, dy.z);
    vec3 still = d_mul(share, over_sea(vec3(v.x - u_tide_m, dx.x, dy.x)));
    float rough = w.w * v.y;
    vec3 runs = d_const(1.0) - d_step(RIVER_DROWNED_M.x, RIVER_DROWNED_M.y, still);
    vec3 swell = d_mul(vec3(w.x, w_dx.x, w_dy.x), runs), chop = d_mul(vec3(w.y, w_dx.y, w_dy.y), runs);
    return River(still + river_waves(along, rough), swell, chop, v.y, still.x, rough, v.z, w.z * runs.x, share, still);
}
