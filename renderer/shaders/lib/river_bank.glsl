// The band over a river's level that is always wet: what laps and splashes reaches so high, grains draw it further.
#include "level/river.glsl"
#include "level/noise.glsl"

uniform float u_river_wet_m;

// 0 … 1; `height` over the still sea. Under the river its water darkens the ground already.
float river_damp(vec2 xy, float height, float pixel_m) {
    River river = river_at(xy);
    if (u_river_wet_m <= 0.0 || river.share <= 0.02) return 0.0;
    float over = height - river.still / river.share;
    float reach = u_river_wet_m * (0.4 + 1.2 * noise_at(xy, 9.0, pixel_m).g) * (1.0 + 2.0 * river.rough);
    return (1.0 - smoothstep(0.4 * reach, reach, over)) * smoothstep(-0.5, -0.1, over) * smoothstep(0.02, 0.2, river.share);
}
