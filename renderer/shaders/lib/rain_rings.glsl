// Rings of raindrops on any water (D17): slopes alone. Four turned layers of cells, in each of them one drop after the
// other at its own place, or none; level/rain_rings.py is the twin and says how many.
#ifdef RAIN_RINGS
#include "lib/rain_hash.glsl"
#include "lib/rings.glsl"
#include "level/noise.glsl"

uniform float u_rain_ripples;
uniform float u_rain_share;       // of the cells that a drop falls into
uniform float u_rain_rings_mean;  // slope² of a layer on the whole
uniform vec4 u_rain_layer[4];     // side of a cell m; cycles: part of one, number of whole ones, after how many they repeat

const vec2 RAIN_TURN[4] = vec2[4](vec2(0.6, 0.8), vec2(-0.28, 0.96), vec2(0.96, -0.28), vec2(0.8, 0.6));  // sine, cosine
// all in sides of a cell: half the width of the waves, how far their middle runs at least and at most
const float DROP_HALF = 0.10, DROP_LEAST = 0.12, DROP_MOST = 0.34;
const float DROP_PHASE = 7.5;  // of the waves at their rim: some more than a whole one to both sides
const float DROP_SLOPE = 1.0, ROW_SHIFT = 0.618034;

// Slope outwards at r of a drop's waves, whose middle runs `reach` while its age goes to 1.
float drop_slope(float r, float age, float reach) {
    float u = (r - reach * age) / DROP_HALF, window = max(1.0 - u * u, 0.0);
    float left = min(12.0 * age, 1.0) * (1.0 - age * age) * inversesqrt(1.0 + 2.0 * reach * age / DROP_HALF);
    return DROP_SLOPE * left * window * window * sin(DROP_PHASE * u) * min(4.0 * r / DROP_HALF, 1.0);
}

// Slope of a layer at a place in sides of its cells.
vec2 drop_rings(vec2 at, vec4 layer, int index) {
    float row = floor(at.y);
    at.x += fract(ROW_SHIFT * row);
    ivec2 cell = ivec2(floor(at));
    float cycles = layer.y + rain_hash(ivec3(cell, index)).x;
    int number = int(mod(floor(cycles) + layer.z, layer.w));
    vec3 chance = rain_hash(ivec3(cell, 4 * number + index + 4));
    if (chance.x >= u_rain_share) return vec2(0.0);
    float size = chance.x / u_rain_share, reach = mix(DROP_LEAST, DROP_MOST, size);
    vec2 off = fract(at) - 0.5 - (1.0 - 2.0 * (reach + DROP_HALF)) * (chance.yz - 0.5);
    float r = max(length(off), 1e-4);
    return off / r * (mix(0.6, 1.0, size) * drop_slope(r, fract(cycles), reach));
}

// Slope that they add, and in z the slope² of those too small for a pixel.
vec3 rain_slope(vec2 xy, float pixel_m) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec4 layer = u_rain_layer[i];
        vec2 way = RAIN_TURN[i];
        float shown = ring_shown(DROP_PHASE / (DROP_HALF * layer.x), pixel_m);
        if (shown > 0.02) {
            vec2 slope = drop_rings(turn(xy, way.x, way.y) / layer.x, layer, i);
            sum.xy += turn(slope, -way.x, way.y) * (shown * u_rain_ripples);
        } else shown = 0.0;
        sum.z += u_rain_rings_mean * (1.0 - shown * shown);
    }
    return sum;
}
#endif
