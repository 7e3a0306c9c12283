// Cirrus and altocumulus on a sphere above the shell of the clouds: flat, four patterns each with a wind of its own (Z13).
// Needs lib/sky.glsl and lib/fog.glsl where it is seen.

#include "level/noise.glsl"

uniform sampler2D u_high_clouds;         // streaks, hooks, ripples, heaps
uniform vec4 u_high_moved_ice, u_high_moved_heaps;  // metres each has moved, within its tile: two patterns each
uniform vec2 u_high_way;                 // of the wind: patterns lie along it
uniform float u_clouds_cirrus, u_clouds_alto;

const float STREAKS_M = 46000.0, HOOKS_M = 31000.0, RIPPLES_M = 13000.0, HEAPS_M = 17000.0, FIELDS_M = 61000.0;

// World metres along the wind and to its left.
vec2 high_place(vec2 xy) { return vec2(dot(xy, u_high_way), dot(xy, vec2(-u_high_way.y, u_high_way.x))); }

float high_pattern(vec2 xy, float tile_m, float lod, int channel) {
    return textureLod(u_high_clouds, xy / tile_m, lod)[channel];
}

// Optical depth of the ice over world metres; `lod` of the finest pattern.
float cirrus_at(vec2 xy, float lod) {
    xy = high_place(xy);
    float streaks = high_pattern(xy - u_high_moved_ice.xy, STREAKS_M, lod, 0);
    float hooks = high_pattern(xy - u_high_moved_ice.zw, HOOKS_M, lod, 1);
    float veil = smoothstep(1.0 - u_clouds_cirrus, 1.7 - u_clouds_cirrus, streaks + 0.25);
    return veil * streaks * 0.9 + hooks * smoothstep(0.0, 0.6, u_clouds_cirrus) * 0.8;
}

// Optical depth of the small heaps.
float alto_at(vec2 xy, float lod) {
    xy = high_place(xy);
    vec4 broad = textureLod(u_noise, (xy - u_high_moved_heaps.zw) / FIELDS_M, 1.0);
    float field = broad.r, other = broad.g;
    float there = smoothstep(0.75 - 0.75 * u_clouds_alto, 1.05 - 0.75 * u_clouds_alto, 0.5 * field + 0.5 * other);
    if (u_clouds_alto <= 0.0 || there <= 0.0) return 0.0;
    float ripples = high_pattern(xy - u_high_moved_heaps.xy, RIPPLES_M, lod, 2);
    float heaps = high_pattern(xy - u_high_moved_heaps.xy, HEAPS_M, lod, 3);
    float lumps = mix(ripples, heaps, smoothstep(0.4, 0.6, field));
    // thin at the rim and all the way in: a hard edge would look like torn paper
    float inner = clamp((lumps - 0.75 + 0.65 * there) / (0.75 + 0.1 * there), 0.0, 1.0);
    return 1.3 * inner * inner;
}
