// The eight generated ground materials (L05; level/ground_textures.py): every layer is two fetches of both arrays, for
// two patches of level ground or for the two upright planes of a steep one, and one of a larger scale. Software runs
// both sides of every branch, so that what differs between layers is numbers and not code. GROUND_CHEAP: one fetch.
#include "level/noise.glsl"

uniform sampler2DArray u_ground_shape;   // slope east, slope north, height, roughness
uniform sampler2DArray u_ground_colour;  // sRGB albedo, slope² / 2
uniform vec4 u_ground_layers[8];         // tile_m, amplitude_m, steepest (heights a tile), relief_m

const int SAND = 0, SHINGLE = 1, STRATA = 2, REEF = 3, GRASS = 4, DUNE = 5, FLOOR = 6, WEED = 7, LAYERS = 8;
// how much of the layer's second, larger scale is added; how many tiles of the first one it is long
const float FAR[8] = float[8](0.12, 0.3, 0.40, 0.6, 0.5, 0.0, 0.3, 0.4);
const float FAR_TILES = 6.3;
const float COMBED = 0.2;  // share of the bend that ripples take: the wind makes no whorls
const float STEEP = 0.77;  // z of the normal, some 40 degrees
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

// `edge` is the half width of the border between two patches, as a part of them.
Patch patch_at(float place, float edge) {
    float index = floor(place);
    return Patch(patch_shift(index), patch_shift(index + 1.0), smoothstep(0.5 - edge, 0.5 + edge, place - index));
}

// Patches some ten metres wide for the materials, and broad ones for the noise that tints them. With GROUND_CHEAP one
// shift a patch and a ragged border, from noise that is there already.
#ifdef GROUND_CHEAP
const float WIDE_EDGE = 0.35;
Patch small_patch(vec2 xy, vec4 broad, vec4 mid, float pixel_m) {
    vec2 shift = patch_shift(floor(13.0 * broad.r + 0.6 * mid.b));
    return Patch(shift, shift, 0.0);
}
#else
const float WIDE_EDGE = 0.45;
Patch small_patch(vec2 xy, vec4 broad, vec4 mid, float pixel_m) {
    return patch_at(25.0 * noise_at(turn(xy, 0.25, 0.968), 449.0, pixel_m).r, 0.12);
}
#endif
// Smooth enough to need no coarser mip levels, between which patches would jump.
Patch wide_patch(vec2 xy, float pixel_m) {
    return patch_at(12.0 * noise_at(turn(xy, -0.66, 0.751), 877.0, min(pixel_m, 2.0)).r, WIDE_EDGE);
}

// Noise without a period: two shifts of it, blended so that its contrast stays (Heitz & Neyret 2018). With GROUND_CHEAP
// one, which fades to its mean at the border.
vec4 free_noise(vec2 xy, float tile_m, float pixel_m, Patch tile) {
#ifdef GROUND_CHEAP
    vec2 shift = tile.share < 0.5 ? tile.one : tile.other;
    return mix(vec4(0.5), noise_at(xy + shift * tile_m, tile_m, pixel_m), abs(2.0 * tile.share - 1.0));
#else
    vec4 noise = noise_at(xy + tile.one * tile_m, tile_m, pixel_m);
    noise = mix(noise, noise_at(xy + tile.other * tile_m, tile_m, pixel_m), tile.share) - 0.5;
    return clamp(0.5 + noise * inversesqrt(1.0 - 2.0 * tile.share * (1.0 - tile.share)), 0.0, 1.0);
#endif
}

// sRGB to linear, a polynomial that leaves the curve by less than 0.002.
vec3 linear_colour(vec3 c) { return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878); }

float ground_lod(float tile_m, float pixel_m) {
    return log2(max(pixel_m * float(textureSize(u_ground_shape, 0).x) / tile_m, 1e-4));
}

// `bent_m` moves the larger scale, so that its tiles are not seen to repeat.
Sample ground_sampled(int layer, vec3 p, vec3 n, float pixel_m, Patch tile, vec2 bent_m) {
    vec4 row = u_ground_layers[layer];
    // where level tiles would be drawn long, steep ground has the cliffs' planes; the border between is ragged
    bool upright = layer == STRATA || n.z < STEEP + 0.006 * bent_m.x;
    float east = n.x * n.x / max(n.x * n.x + n.y * n.y, 1e-4);  // which way a cliff faces
    // beds lie level: y is the height on both upright planes, so that they run on round a corner
    vec2 one = upright ? p.yz : p.xy, other = upright ? p.xz : p.xy;
    vec3 u_one = upright ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0), u_other = vec3(1.0, 0.0, 0.0);
    vec3 v = upright ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0);
    float lod = ground_lod(row.x, pixel_m);
#ifdef GROUND_CHEAP
    if (upright && east < 0.5 + 0.03 * bent_m.y) {
        one = other;
        u_one = u_other;
    }
    vec3 at = vec3(one / row.x + (upright ? vec2(0.0) : tile.one), float(layer));
    vec4 shape = textureLod(u_ground_shape, at, lod), colour = textureLod(u_ground_colour, at, lod);
    vec2 slope = shape.xy * 2.0 - 1.0;
    vec3 lean = slope.x * u_one + slope.y * v;
#else
    float share = upright ? 1.0 - smoothstep(0.25, 0.75, east) : tile.share;
    vec3 at_one = vec3(one / row.x + (upright ? vec2(0.0) : tile.one), float(layer));
    vec3 at_other = vec3(other / row.x + (upright ? vec2(0.37, 0.0) : tile.other), float(layer));
    vec4 here = textureLod(u_ground_shape, at_one, lod), there = textureLod(u_ground_shape, at_other, lod);
    vec4 colour = mix(textureLod(u_ground_colour, at_one, lod), textureLod(u_ground_colour, at_other, lod), share);
    vec4 shape = mix(here, there, share);
    here.xy = here.xy * 2.0 - 1.0;
    there.xy = there.xy * 2.0 - 1.0;
    vec3 lean = mix(here.x * u_one + here.y * v, there.x * u_other + there.y * v, share);
    vec2 slope = shape.xy * 2.0 - 1.0;
    // the larger scale: height and slope only
    float far_m = row.x * FAR_TILES, far_lod = ground_lod(far_m, pixel_m);
    if (layer >= GRASS && layer != FLOOR) far_lod = max(far_lod, STRANDS_LOD);
    vec2 level_way = turn(p.xy, -0.59, 0.807) + bent_m * (layer == SAND || layer == FLOOR ? COMBED : 1.0);
    vec4 far = textureLod(u_ground_shape, vec3((upright ? one : level_way) / far_m, float(layer)), far_lod);
    vec4 far_other = textureLod(u_ground_shape, vec3((upright ? other : level_way) / far_m, float(layer)), far_lod);
    far = mix(far, far_other, share);
    far.xy = far.xy * 2.0 - 1.0;
    if (!upright) far.xy = turn(far.xy, 0.59, 0.807);
    lean += FAR[layer] * (far.x * mix(u_one, u_other, share) + far.y * v);
    shape.z = clamp(shape.z + FAR[layer] * (far.z - 0.5), 0.0, 1.0);
#endif
    float steepest = row.z * row.y / row.x;
    vec3 albedo = linear_colour(colour.rgb) * (1.0 + (layer == STRATA ? 0.7 : FAR[layer]) * (shape.z - 0.5));
    return Sample(lean * steepest, shape.z, shape.w, albedo, max(2.0 * colour.a - dot(slope, slope), 0.0) * steepest * steepest);
}
