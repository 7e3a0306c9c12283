// Kinds of sea by hectare as colours, for the view of them (H01, H27).
#include "lib/sea_horizon.glsl"

uniform sampler2D u_patch_kinds;  // kind / 255 by hectare, KINDS of level/patches.py
uniform ivec2 u_patch_first;      // column and row of its first hectare

const float GRID_M = 10.0;

vec3 patch_colour(vec2 xy, float pixel_m) {
    const vec3 COLOURS[4] =
        vec3[4](vec3(0.10, 0.22, 0.55), vec3(0.12, 0.55, 0.50), vec3(0.85, 0.68, 0.30), vec3(0.45, 0.10, 0.10));
    ivec2 at = ivec2(floor(xy / PATCH_M)) - u_patch_first, size = textureSize(u_patch_kinds, 0);
    bool known = all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, size));
    int kind = known ? int(texelFetch(u_patch_kinds, at, 0).r * 255.0 + 0.5) : 0;
    if (!in_mesh(xy)) return vec3(0.10, 0.10, 0.12);  // the horizon's plane
    vec2 fine = abs(fract(xy / GRID_M + 0.5) - 0.5) * GRID_M, coarse = abs(fract(xy / PATCH_M + 0.5) - 0.5) * PATCH_M;
    float shown = 1.0 - smoothstep(0.15, 0.5, pixel_m / GRID_M);
    float far = 1.0 - smoothstep(0.05, 0.2, pixel_m / PATCH_M);
    float line = 0.25 * shown * (1.0 - smoothstep(0.0, 1.5 * pixel_m, min(fine.x, fine.y)));
    line = max(line, 0.6 * far * (1.0 - smoothstep(0.5 * pixel_m, 2.0 * pixel_m + 0.3, min(coarse.x, coarse.y))));
    return mix(COLOURS[min(kind, 3)], vec3(0.9), line);
}
