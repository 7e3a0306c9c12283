// Foam (D04, H18): how much there is picks from thin lace to dense cover in one texture, without pops.
#include "lib/noise.glsl"

uniform sampler2D u_foam;        // R lace, G middle, B dense, each equalised; A bubbles
uniform float u_foam_tile_m;
uniform float u_foam_amount;
uniform vec4 u_foam_phase;       // two phases half a cycle apart (−½ … ½), weight of the second, seconds a cycle

const float FOAM_TEXELS = 512.0;

// Cover of foam for an amount 0 … 1. Fields are equalised: the part above 1 − amount is `amount` of the water.
float foam_cover(vec4 fields, float amount, float lod) {
    float field = mix(mix(fields.r, fields.g, smoothstep(0.18, 0.45, amount)), fields.b, smoothstep(0.5, 0.8, amount));
    // seen from afar the texture is flat grey: the threshold widens until cover is simply the amount
    float width = mix(0.10, 1.0, smoothstep(1.0, 6.0, lod));
    float cover = smoothstep(-width, width, field - (1.0 - amount) + 0.04);
    return mix(cover, amount, smoothstep(3.0, 6.5, lod)) * smoothstep(0.0, 0.10, amount);
}

// Fields at a place and, in `lee`, how much thicker the foam is a little way towards the light: its own shading.
vec4 foam_fields(vec2 xy, vec2 flow, vec2 to_light, float lod, out float lee) {
    float tile = u_foam_tile_m;
    float second = u_foam_phase.z;
    vec2 way = flow * u_foam_phase.w;
    vec4 a = textureLod(u_foam, (xy - way * u_foam_phase.x) / tile, lod);
    vec4 ahead = textureLod(u_foam, (xy - way * u_foam_phase.x + to_light * (0.004 * tile * exp2(0.7 * lod))) / tile, lod);
    lee = dot(ahead.rgb - a.rgb, vec3(0.25, 0.35, 0.4)) * (1.0 - second);
    vec4 b = textureLod(u_foam, (xy - way * u_foam_phase.y) / tile + vec2(0.37, 0.61), lod);
    // rafts three tiles wide, still, break the repetition and give the foam a shape from afar
    vec4 raft = textureLod(u_foam, turn(xy, 0.53, 0.848) / (tile * 3.3), max(lod - 1.7, 0.0)) - 0.5;
    // keep the contrast that averaging patterns would lose
    vec4 mean = mix(a, b, second) - 0.5;
    mean /= sqrt(second * second + (1.0 - second) * (1.0 - second));
    return clamp((0.8 * mean + 0.52 * raft) / 0.95 + 0.5, 0.0, 1.0);
}

struct Foam {
    float cover;     // share of the pixel that is foam
    float amount;    // before the texture: thickness
    float bubbles;   // pale volume of air under the surface
    float relief;    // height of the foam, 0 … 1
};

// `before` undeformed xy; masks of the shore waves; `shore_edge` 1 at the water's edge, falling to 0 some way out;
// `crest` foam of breaking crests offshore; `flow` m/s; `to_light` horizontal, towards the sun.
Foam foam_at(vec2 before, float line, float back, float fall, float shore_edge, float crest, vec2 flow, vec2 to_light,
             float pixel_m) {
    // where it lies: foam is marbled at every scale, so the same cells serve five times as wide
    float marble_lod = log2(max(pixel_m * FOAM_TEXELS / (5.3 * u_foam_tile_m), 1.0));
    float near = textureLod(u_foam, turn(before, 0.29, 0.957) / (5.3 * u_foam_tile_m), marble_lod).g;
    float wide = noise_at(before, 140.0, pixel_m).g;
    float patches = wide * 0.55 + near * 0.45;
    float torn = smoothstep(0.30, 0.72, patches);
    float front = saturate(fall * (0.15 + 0.95 * torn));
    float wake = back * back * smoothstep(0.42, 0.85, patches) * 0.42;
    float crown = line * line * (0.04 + 0.50 * torn);
    float lace = shore_edge * (0.04 + 0.30 * torn);
    float rim = smoothstep(0.62, 0.92, shore_edge) * (0.10 + 0.50 * near);
    float amount = 1.0 - (1.0 - front) * (1.0 - wake) * (1.0 - crown) * (1.0 - lace) * (1.0 - rim) * (1.0 - saturate(crest));
    amount = saturate(amount * u_foam_amount);
    if (amount < 0.004) return Foam(0.0, 0.0, 0.0, 0.0);
    float lod = log2(max(pixel_m * FOAM_TEXELS / u_foam_tile_m, 1e-4));
    float lee;
    vec4 fields = foam_fields(before, flow, to_light, max(lod, 0.0), lee);
    float close = 1.0 - smoothstep(-1.0, 1.5, lod);
    if (close > 0.0)  // bubbles eat into the edges where the texture alone would be blurred
        fields.rgb += (textureLod(u_foam, before * (4.7 / u_foam_tile_m), max(lod + 2.2, 0.0)).a - 0.35) * 0.26 * close;
    float cover = foam_cover(fields, amount, max(lod, 0.0));
    float fine = mix(fields.a, 0.4, smoothstep(0.0, 3.0, lod));
    cover = saturate(cover * (0.86 + 0.22 * fine) + 0.25 * rim * fine * (1.0 - cover));
    return Foam(cover, amount, smoothstep(0.15, 0.9, amount), saturate(cover * mix(fields.b, fields.g, 0.4) - 1.6 * lee));
}

// Painted foam joins what the waves made; it goes through the same texture.
Foam foam_painted(Foam foam, vec2 before, float paint, float pixel_m) {
    if (paint < 0.004) return foam;
    float lod = max(log2(max(pixel_m * FOAM_TEXELS / u_foam_tile_m, 1e-4)), 0.0);
    float amount = saturate(paint);
    float cover = foam_cover(textureLod(u_foam, before / u_foam_tile_m + 0.21, lod), amount, lod);
    return Foam(max(foam.cover, cover), max(foam.amount, amount), max(foam.bubbles, amount), max(foam.relief, cover));
}

// Reflectance of foam: thick foam is nearly white, thin foam lets the water through (Koepke 1984 for old foam).
vec3 foam_albedo(Foam foam) { return vec3(0.80, 0.83, 0.84) * mix(0.72, 1.0, smoothstep(0.2, 0.8, foam.amount))
           * mix(0.66, 1.06, foam.relief); }

const float FOAM_ROUGHNESS = 0.85;
