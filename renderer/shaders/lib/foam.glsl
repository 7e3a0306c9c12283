// Foam (D04, H18): how much there is picks from thin lace to dense cover in one texture, without pops.
#include "level/flow_places.glsl"
#include "level/noise.glsl"
#include "level/foam_texture.glsl"
#include "lib/foam_beach.glsl"

uniform float u_flow_noise, u_flow_noise_m;

// Cover of foam for an amount 0 … 1. Fields are equalised: the part above 1 − amount is `amount` of the water.
float foam_cover(vec4 fields, float amount, float lod) {
    float field = mix(mix(fields.r, fields.g, smoothstep(0.18, 0.45, amount)), fields.b, smoothstep(0.5, 0.8, amount));
    // seen from afar the texture is flat grey: the threshold widens until cover is simply the amount
    float width = mix(0.10, 1.0, smoothstep(1.0, 6.0, lod));
    float cover = smoothstep(-width, width, field - (1.0 - amount) + 0.04);
    return mix(cover, amount, smoothstep(3.0, 6.5, lod)) * smoothstep(0.0, 0.10, amount);
}

// Foam moved by the flow: places start at different times (level/flow_places.glsl).
void foam_places(vec2 xy, vec2 flow, out vec2 first, out vec2 second, out float weight) {
#ifdef NO_FLOW
    flow_places(xy, vec2(0.0), 0.0, first, second, weight);
#else
    float early = flow_moves(flow) ? textureLod(u_noise, xy / (8.0 * u_flow_noise_m), 3.0).g * u_flow_noise : 0.0;
    flow_places(xy, flow, early, first, second, weight);
#endif
}

// Two copies of the texture with the contrast that averaging patterns would lose, about 0; `lee` of the first.
vec4 foam_pair(vec2 at, vec2 other, float second, vec2 lit_side, float lod, out float lee) {
    vec4 a = textureLod(u_foam, at, lod);
    vec4 ahead = textureLod(u_foam, at + lit_side, lod);
    lee = dot(ahead.rgb - a.rgb, vec3(0.25, 0.35, 0.4)) * (1.0 - second);
    vec4 b = second > 0.0 ? textureLod(u_foam, other, lod) : a;
    return (mix(a, b, second) - 0.5) / sqrt(second * second + (1.0 - second) * (1.0 - second));
}

// Fields at a place and, in `lee`, how much thicker the foam is a little way towards the light: its own shading.
vec4 foam_fields(vec2 xy, vec2 flow, vec2 to_light, float lod, out float lee) {
    float tile = u_foam_tile_m, second, ride = beach_ride.z;
    vec2 at, other, lit_side = to_light * (0.004 * exp2(0.7 * lod));
    vec4 mean = vec4(0.0);
    lee = 0.0;
    if (ride < 1.0) {
        foam_places(xy, flow, at, other, second);
        mean = foam_pair(at, other, second, lit_side, lod, lee);
    }
    if (ride > 0.0) {
        float lee_there;
        beach_places(xy, tile, JUMP, OTHER, at, other, second);
        vec4 there = foam_pair(at, other, second, lit_side, lod, lee_there);
        mean = mix(mean, there, ride) / sqrt(ride * ride + (1.0 - ride) * (1.0 - ride));
        lee = mix(lee, lee_there, ride);
    }
    // rafts three tiles wide, still, break the repetition and give the foam a shape from afar
    vec4 raft = textureLod(u_foam, turn(xy, 0.53, 0.848) / (tile * 3.3), max(lod - 1.7, 0.0)) - 0.5;
    return clamp((0.8 * mean + 0.52 * raft) / 0.95 + 0.5, 0.0, 1.0);
}

struct Foam {
    float cover;     // share of the pixel that is foam
    float amount;    // before the texture: thickness
    float bubbles;   // pale volume of air under the surface
    float relief;    // height of the foam, 0 … 1
    float fresh;     // 1 just beaten up, 0 old lace
};

const Foam NO_FOAM = Foam(0.0, 0.0, 0.0, 0.0, 0.0);

// The texture's answer to an amount of foam. `fresh` foam is bright and thick, `rim` a line of bubbles; `before`
// undeformed xy; `flow` m/s; `to_light` horizontal, towards the sun.
Foam foam_at(vec2 before, float amount, float fresh, float rim, vec2 flow, vec2 to_light, float pixel_m) {
    if (amount < 0.004) return NO_FOAM;
    float lod = log2(max(pixel_m * FOAM_TEXELS / u_foam_tile_m, 1e-4));
    float close = 1.0 - smoothstep(-0.5, 2.5, lod), grain = 0.4;
    vec4 cells = vec4(0.5, 0.5, 0.5, 0.35);
    if (close > 0.0) {
        cells = textureLod(u_foam, turn(before, 0.454, 0.891) * (4.7 / u_foam_tile_m), max(lod + 2.2, 0.0));
        grain = mix(grain, 0.5 * cells.g + 0.5 * cells.a, close);
    }
    // cells within cells fray the threads, bubbles eat into the edges: the texture alone would be blurred
    float lee;
    vec2 frayed = before + (cells.gb - 0.5) * (0.019 * u_foam_tile_m * close);
    vec4 fields = foam_fields(frayed, flow, to_light, max(lod, 0.0), lee);
    fields.rgb += ((cells.a - 0.35) * 0.22 + (cells.g - 0.5) * vec3(0.16, 0.22, 0.20)) * close;
    float cover = foam_cover(fields, amount, max(lod, 0.0));
    float fine = mix(fields.a, 0.4, smoothstep(0.0, 3.0, lod));
    cover = saturate(cover * (0.84 + 0.10 * fresh + 0.20 * fine) + 0.30 * rim * fine * (1.0 - cover));
    float relief = cover * mix(mix(fields.b, fields.g, 0.4), 0.5 + grain, 0.35 * close);
    relief -= mix(1.6, 2.4, fresh) * lee;
    return Foam(cover, amount, smoothstep(0.15, 0.9, amount), saturate(relief), fresh);
}

// Reflectance of foam, 0.6 to 0.8 where it is thick: fresh foam is brighter than old (Koepke 1984).
vec3 foam_albedo(Foam foam) {
    float thick = mix(0.58, 0.74, smoothstep(0.25, 0.9, foam.amount));
    return vec3(0.94, 0.97, 0.98) * mix(thick, 0.78, foam.fresh) * mix(0.84, 1.04, foam.relief);
}

const float FOAM_ROUGHNESS = 0.85;
