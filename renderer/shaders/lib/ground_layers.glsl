// The eight generated ground materials (L05; level/ground_textures.py): fetched at two scales, on three planes on cliffs.
// Levels of detail are explicit, so that fetches may stand in branches. With GROUND_CHEAP one scale and one plane.
#include "lib/noise.glsl"

uniform sampler2DArray u_ground_shape;   // slope east, slope north, height, roughness
uniform sampler2DArray u_ground_colour;  // sRGB albedo, slope²
uniform vec4 u_ground_layers[8];         // tile_m, amplitude_m, steepest (heights a tile), relief_m

const int SAND = 0, SHINGLE = 1, STRATA = 2, REEF = 3, GRASS = 4, DUNE = 5, FLOOR = 6, WEED = 7, LAYERS = 8;
// how much of the layer's second, larger scale is added; how many tiles of the first one it is long
const float FAR[8] = float[8](0.22, 0.3, 0.55, 0.6, 0.5, 0.0, 0.3, 0.4);
const float FAR_TILES = 6.3;
const float STRANDS_LOD = 2.5;  // blades of the larger scale would be ropes: only their clumps are used

// A place's own shift of the tiles: neighbouring patches show different parts of a tile, so that none is seen to repeat.
struct Patch {
    vec2 one, other;  // shifts of the two nearest patches, in tiles
    float share;      // of the other
};

struct Sample {
    vec3 lean;        // what the relief takes from the normal
    float height;     // 0 … 1, mean one half
    float roughness;
    vec3 albedo;      // linear
    float variance;   // of the slopes that a pixel of this size can't show (L04)
};

vec2 patch_shift(float index) { return fract(sin(vec2(index * 12.99 + 1.7, index * 78.23 + 4.1)) * 43.7); }

Patch patch_at(float place) {
    float index = floor(place);
    return Patch(patch_shift(index), patch_shift(index + 1.0), smoothstep(0.3, 0.7, place - index));
}

// Patches some ten metres wide for the materials, and broad ones for the noise that tints them.
#ifdef GROUND_CHEAP
Patch small_patch(vec2 xy, float pixel_m) { return Patch(vec2(0.0), vec2(0.0), 0.0); }
#else
Patch small_patch(vec2 xy, float pixel_m) { return patch_at(11.0 * noise_at(turn(xy, 0.25, 0.968), 307.0, pixel_m).r); }
#endif
Patch wide_patch(vec2 xy, float pixel_m) { return patch_at(9.0 * noise_at(turn(xy, -0.66, 0.751), 877.0, pixel_m).r); }

// Noise without a period: two shifts of it, blended so that its contrast stays (Heitz & Neyret 2018).
vec4 free_noise(vec2 xy, float tile_m, float pixel_m, Patch tile) {
    vec4 noise = noise_at(xy + tile.one * tile_m, tile_m, pixel_m);
    if (tile.share <= 0.0) return noise;
    if (tile.share >= 1.0) return noise_at(xy + tile.other * tile_m, tile_m, pixel_m);
    noise = mix(noise, noise_at(xy + tile.other * tile_m, tile_m, pixel_m), tile.share) - 0.5;
    return clamp(0.5 + noise * inversesqrt(1.0 - 2.0 * tile.share * (1.0 - tile.share)), 0.0, 1.0);
}

// sRGB to linear, a polynomial that leaves the curve by less than 0.002.
vec3 linear_colour(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

Sample ground_texel(int layer, vec2 xy, float tile_m, float pixel_m, Patch tile) {
    float texels = float(textureSize(u_ground_shape, 0).x), lod = log2(max(pixel_m * texels / tile_m, 1e-4));
    vec3 at = vec3(xy / tile_m + tile.one, float(layer));
    vec4 shape = textureLod(u_ground_shape, at, lod), colour = textureLod(u_ground_colour, at, lod);
#ifndef GROUND_CHEAP
    if (tile.share > 0.0) {
        at.xy += tile.other - tile.one;
        shape = mix(shape, textureLod(u_ground_shape, at, lod), tile.share);
        colour = mix(colour, textureLod(u_ground_colour, at, lod), tile.share);
    }
#endif
    vec4 row = u_ground_layers[layer];
    vec2 slope = shape.xy * 2.0 - 1.0;
    float steepest = row.z * row.y / row.x;
    return Sample(vec3(slope * steepest, 0.0), shape.z, shape.w, linear_colour(colour.rgb),
                  max(colour.a - dot(slope, slope), 0.0) * steepest * steepest);
}

// The larger scale: only height and slope.
vec3 ground_far(int layer, vec2 xy, float pixel_m, Patch tile) {
    float tile_m = u_ground_layers[layer].x * FAR_TILES, texels = float(textureSize(u_ground_shape, 0).x);
    float lod = max(log2(max(pixel_m * texels / tile_m, 1e-4)), layer < GRASS || layer == FLOOR ? 0.0 : STRANDS_LOD);
    vec3 at = vec3(xy / tile_m + tile.one, float(layer));
    vec4 shape = textureLod(u_ground_shape, at, lod);
    if (tile.share > 0.0) {
        at.xy += tile.other - tile.one;
        shape = mix(shape, textureLod(u_ground_shape, at, lod), tile.share);
    }
    vec4 row = u_ground_layers[layer];
    return vec3((shape.xy * 2.0 - 1.0) * row.z * row.y / row.x, shape.z);
}

Sample add_far(Sample near, int layer, vec2 xy, float pixel_m, Patch tile) {
#ifndef GROUND_CHEAP
    if (FAR[layer] > 0.0) {
        vec3 far = ground_far(layer, turn(xy, -0.59, 0.807), pixel_m, tile);
        near.lean.xy += FAR[layer] * turn(far.xy, 0.59, 0.807);
        near.height = clamp(near.height + FAR[layer] * (far.z - 0.5), 0.0, 1.0);
        near.albedo *= 1.0 + FAR[layer] * (far.z - 0.5);
    }
#endif
    return near;
}

Sample weighed(Sample a, Sample b, float t) {
    return Sample(mix(a.lean, b.lean, t), mix(a.height, b.height, t), mix(a.roughness, b.roughness, t),
                  mix(a.albedo, b.albedo, t), mix(a.variance, b.variance, t));
}

// Beds lie level: on the two upright planes y is the height, so that they run on round a corner.
Sample strata_sample(vec3 p, vec3 n, float pixel_m, Patch tile) {
    float tile_m = u_ground_layers[STRATA].x;
    float east = n.x * n.x / max(n.x * n.x + n.y * n.y, 1e-4);
    Sample side;
#ifndef GROUND_CHEAP
    if (east > 0.08) {
        side = ground_texel(STRATA, p.yz, tile_m, pixel_m, tile);
        vec3 far = ground_far(STRATA, p.yz, pixel_m, tile);
        side.lean = vec3(0.0, side.lean.xy + FAR[STRATA] * far.xy);
        side.height += FAR[STRATA] * (far.z - 0.5);
    }
    if (east < 0.92) {
        Sample north = ground_texel(STRATA, p.xz, tile_m, pixel_m, tile);
        vec3 far = ground_far(STRATA, p.xz, pixel_m, tile);
        north.lean = vec3(north.lean.x + FAR[STRATA] * far.x, 0.0, north.lean.y + FAR[STRATA] * far.y);
        north.height += FAR[STRATA] * (far.z - 0.5);
        side = east > 0.08 ? weighed(north, side, smoothstep(0.25, 0.75, east)) : north;
    }
    side.albedo *= 0.55 + 0.9 * side.height;
    float top = smoothstep(0.6, 0.85, n.z);
    if (top > 0.01) side = weighed(side, ground_texel(REEF, p.xy, u_ground_layers[REEF].x, pixel_m, tile), top);
#else
    side = ground_texel(STRATA, east > 0.5 ? p.yz : p.xz, tile_m, pixel_m, tile);
    side.lean = east > 0.5 ? side.lean.zxy : side.lean.xzy;
#endif
    return side;
}

Sample ground_sampled(int layer, vec3 p, vec3 n, float pixel_m, Patch tile) {
    if (layer == STRATA) return strata_sample(p, n, pixel_m, tile);
    return add_far(ground_texel(layer, p.xy, u_ground_layers[layer].x, pixel_m, tile), layer, p.xy, pixel_m, tile);
}
