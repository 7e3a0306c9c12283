// How much foam lies on a point of the sea (D04, D07, H18), before its texture: what waves leave, what wind and paint add.
#include "level/waves.glsl"
#include "level/swash.glsl"
#include "level/noise.glsl"
#include "level/wind.glsl"
#include "level/flow_places.glsl"
#include "level/foam_texture.glsl"

uniform float u_foam_amount;
uniform float u_whitecaps;       // share of the open sea that is white in this wind
uniform vec4 u_cap_place, u_cap_age;  // of two generations: offset in tiles each; age −½ … ½ each, share of the caps each

// How foam lies in patches, 0 … 1: the same cells five times as wide, and broad clouds.
float foam_patches(vec2 before, float pixel_m, out float near) {
    float lod = log2(max(pixel_m * FOAM_TEXELS / (5.3 * u_foam_tile_m), 1.0));
    near = foam_texture(turn(before, 0.29, 0.957) / (5.3 * u_foam_tile_m), lod).g;
    return noise_at(before, 140.0, pixel_m).g * 0.55 + near * 0.45;
}

const float CAP_TILE_M = 120.0, CAP_FIELD_M = 430.0;  // a cap is a few metres wide, a field of them some tens
const float CAP_DRIFT_M = 14.0;                       // a crest carries its cap so far
const float CAP_AMOUNT = 0.78, CAP_COVER = 0.62;      // foam in a cap, and what it covers there after its texture
const float CAP_LOST = 0.012;                         // the noise's peaks are blunt: what that costs, fitted to the mean

// Amount of foam on the breaking crests of the open sea; `crest` height against the largest, mean 0. Caps are where two
// noises are both high, so that each need only be asked for the root of the share: 8 bits know no rarer thing. `veil`
// is the cover where pixels are too large for single caps.
float whitecaps(vec2 xy, float crest, float pixel_m, out float veil) {
    veil = 0.0;
    if (u_whitecaps <= 0.0) return 0.0;
    float coarse = smoothstep(1.5, 6.0, pixel_m);
    veil = u_whitecaps * coarse;
    if (coarse >= 1.0) return 0.0;
    // crests lie across the wind
    vec2 way = vec2(2.2 * dot(xy, u_wind_way), u_wind_way.x * xy.y - u_wind_way.y * xy.x);
    float field = noise_at(way, CAP_FIELD_M, pixel_m).a;
    float sum = 0.0;
    for (int i = 0; i < 2; ++i) {
        vec2 age = i == 0 ? u_cap_age.xz : u_cap_age.yw, place = i == 0 ? u_cap_place.xy : u_cap_place.zw;
        float share = sqrt(u_whitecaps / CAP_COVER * age.y * clamp(1.0 + 2.0 * crest, 0.2, 1.8));
        share = 1.03 * share + CAP_LOST * age.y;
        float cap = noise_at(way - vec2(age.x * CAP_DRIFT_M, 0.0) + place * CAP_TILE_M, CAP_TILE_M, pixel_m).g;
        vec2 edge = vec2(1.0 - share), wide = vec2(share);
        vec2 in_it = smoothstep(edge - wide, edge + wide, vec2(field, cap));
        sum = max(sum, in_it.x * in_it.y);
    }
    return sum * CAP_AMOUNT * (1.0 - coarse);
}

const float BREAKS_S = 0.45, BROKEN_S = 0.85;  // share of the shore range over which fronts turn into foam

// Metres of water over the bed, from the shore map: steady where the ray's way through thin water isn't.
float water_column(Sea sea, float height) { return sea.bed.depth.x + height - u_sea_level_m; }

// Where foam lies on a shore wave: carried on by as much as the wave stands there, so that it is not drawn out down its
// face, and goes to and fro with the wave as the water does.
vec2 on_face(vec2 before, Sea sea) {
    vec2 uphill = -sea.bed.smoothed.yz;
    return before - uphill / max(length(uphill), 1e-4) * max(sea.shore.lift.x, 0.0);
}

// The falling crest: a bright line some metres wide that topples over the face, lower the further the wave has broken
// (D04). `down_m` counts from the top of the wave over its face, `to_m` turns shares of the range into metres.
float crest_foam(ShoreMasks m, float to_m, float down_m, float broken, float tear) {
    float reach_m = mix(-0.5, 1.0, broken) * min(u_shore_width * to_m, 9.0);
    float over = 1.0 - smoothstep(-1.6, 1.6, down_m - reach_m + 6.0 * (tear - 0.5));
    float behind = exp2(min(down_m, 0.0) / mix(0.7, 1.6, broken));
    return over * behind * smoothstep(0.05, 0.4, broken) * smoothstep(0.02, 0.3, max(m.fall, m.line));
}

uniform float u_foam_shore, u_foam_shore_near_m, u_foam_shore_far_m;
uniform float u_foam_height, u_foam_height_low, u_foam_height_high;
uniform float u_foam_transient, u_foam_constant;
uniform float u_quiet_foam;

const float FOAM_ASHORE_M = 3.0;  // so far past the still water line the swash takes it along

// Constant foam by the distance to the shore (H18), torn into patches: a ring round the coast would be drawn by a ruler.
float foam_of_shore(float distance_m, float torn) {
    float near = 1.0 - smoothstep(u_foam_shore_near_m, max(u_foam_shore_far_m, u_foam_shore_near_m + 0.1), distance_m);
    return u_foam_shore * near * near * torn * smoothstep(-FOAM_ASHORE_M, 0.5 * FOAM_ASHORE_M, distance_m);
}

#ifdef PLUNGE
// Foam of a crest that throws its lip (D34): a thin line on its edge while that falls, then all that it falls on.
float lip_foam(ShoreMasks m, float to_m, float down_m, float tear) {
    float fallen = smoothstep(0.5, 1.2, m.progress), reach_m = mix(0.1, 1.0, fallen) * min(u_shore_width * to_m, 9.0);
    float wide_m = mix(0.4, 1.6, fallen);
    float over = 1.0 - smoothstep(-wide_m, wide_m, down_m - reach_m + mix(2.0, 4.0, fallen) * wide_m * (tear - 0.5));
    float behind = exp2(min(down_m + mix(0.1, 0.6, fallen), 0.0) / mix(0.4, 1.8, fallen));
    return over * behind * white_water(m.progress, m.breaker) * smoothstep(0.02, 0.3, max(m.fall, m.line));
}
#endif

// Foam on high water (H18): height against the largest possible sum.
float foam_of_height(float height01) {
    return u_foam_height * smoothstep(u_foam_height_low, max(u_foam_height_high, u_foam_height_low + 1e-3), height01);
}

// Painted foam (D07): the broad layer comes with the backs and falling crests of the waves, the other is always there.
vec2 foam_painted(vec2 painted, ShoreMasks m) {
    return saturate(vec3(painted.x * u_foam_transient * (m.back + m.line + m.fall), painted.y * u_foam_constant, 0.0)).xy;
}

struct FoamAmount {
    float amount;  // 0 … 1
    float fresh;   // 1 just beaten up, 0 old lace
    float rim;     // a line of bubbles at the water's edge
    float veil;    // cover of whitecaps where pixels are too large for single ones
    bool any;      // false far out where nothing lies
};

// What the waves leave: crest line, torn back, lace on the sheet, its rim on the sand; `before` on_face, `column`
// water_column, `painted` the foam layer, `current` current_at, `stirred` what pushed water adds.
FoamAmount foam_amount(Sea sea, vec2 before, float column, float sharp, vec2 painted, vec4 current, bool waves, float stirred, float pixel_m) {
    vec2 layers = foam_painted(painted, sea.shore);
    float paint = max(layers.x, layers.y);
    ShoreMasks m = sea.shore;
    float shore = sea.bed.sea.x * u_shore_on;
    float veil, offshore = whitecaps(before, sea.height01 * sharp, pixel_m, veil) * sea.deep;
    veil *= waves ? sea.deep : 0.0;
    // what a shore wave lifts has foam of its own: only the open sea's heights count
    float still = waves ? foam_of_height(sea.height01 * min(2.0 * sea.deep, 1.0) * sharp) * sharp : 0.0;
    bool far_out = shore * m.s < 0.2 && current.a > u_foam_shore_far_m;
    if (far_out && offshore + paint + still + stirred < 0.004) return FoamAmount(0.0, 0.0, 0.0, veil, false);
    float near;
    float patches = foam_patches(before, pixel_m, near);
    float torn = smoothstep(0.30, 0.70, patches);
    float broken = smoothstep(BREAKS_S, BROKEN_S, m.s + 0.30 * (patches - 0.5));
    float rolling = broken, plunging = 0.0, whole = 0.0;
#ifdef PLUNGE
    // foam and shape of a wave are one (D34): it starts at the lip, where that comes down the water stays white
    whole = min(u_shore_plunge, 1.0);
    rolling = mix(broken, white_water(m.progress, m.breaker), whole);
    plunging = whole * m.breaker.plunging.x;
    vec2 down = mix(vec2(-0.8, 1.6), vec2(0.5, 1.5), plunging);
    float torn_here = m.breaker.here.x + 0.06 * (patches - 0.5) * u_shore_break_rate;
    broken = mix(broken, smoothstep(down.x, down.y, torn_here) * m.breaker.shows.x, whole);
#endif
    float steep = max(length(sea.bed.smoothed.yz), 0.015);
    float to_m = u_shore_range_m / steep, down_m = (m.s - m.front + 0.5 * u_shore_width) * to_m;
    // behind a bar or a rim the wave has spent itself: no crest falls there, no sheet runs up
    float open = 1.0 - smoothstep(0.5 * POOL_M, 2.5 * POOL_M, sea.bed.depth.x - sea.bed.clock.x);
    float runs_up = 1.0 - smoothstep(POOL_M, 4.0 * POOL_M, sea.bed.depth.x - sea.bed.clock.x);
    // on a flat a front is as wide as the flat: torn there, whole where the bed is steep or it has steepened itself
    float narrow = max(smoothstep(0.012, 0.05, length(sea.bed.smoothed.yz)), 0.75 * whole);
    open *= mix(0.15 + 0.75 * torn * patches, 1.0, narrow);
    float crest = crest_foam(m, to_m, down_m, rolling, patches);
#ifdef PLUNGE
    float splash = smoothstep(0.02, 0.22, m.splash + 0.25 * (patches - 0.5) * step(0.005, m.splash));
    crest = mix(crest, max(lip_foam(m, to_m, down_m, patches), 0.9 * splash), plunging);
#endif
    crest *= open;
    float back = max(m.back, m.line) * broken;
    float wake = back * back * back * (0.06 + 0.50 * torn) * (0.45 + 0.55 * exp2(min(down_m, 0.0) / 7.0));
    // the sheet: dense while it runs up, lace whose holes grow while it drains
    float sheet = exp2(-max(column, 0.0) / 0.13) * shore;
    float drained = swash_drained(swash_phase(m));
    float lace = sheet * mix(0.22 + 0.50 * torn, 0.30 * torn, smoothstep(0.0, 0.6, drained));
    float edge_m = (m.edge_s - m.s) * u_shore_range_m / steep;
    float rim = shore - shore * smoothstep(0.15, 1.0, edge_m / (mix(0.9, 0.4, drained) + 2.0 * pixel_m + 1.1 * near));
    rim *= runs_up;
    // what it carries up is left on the sand where it turns (lib/wet.glsl)
    rim *= mix(0.38 + 0.55 * near, 0.25 * near, smoothstep(0.05, 0.4, drained)) * (1.0 - smoothstep(0.2, 0.6, steep));
    crest *= mix(0.97, 0.80, smoothstep(0.95, 1.02, m.s));
    float constant = foam_of_shore(current.a, torn) * sea.bed.sea.x;
    float clean = (1.0 - crest) * (1.0 - wake) * (1.0 - lace) * (1.0 - rim) * (1.0 - offshore);
    clean *= (1.0 - 0.85 * stirred * (0.4 + 0.6 * torn)) * (1.0 - constant) * (1.0 - still * (0.35 + 0.65 * torn));
    clean = waves ? clean : 1.0;
    float amount = 1.0 - (1.0 - saturate((1.0 - clean) * u_foam_amount)) * (1.0 - paint * (0.34 + 0.26 * back));
    amount *= 1.0 - u_quiet_foam * current.b;
    return FoamAmount(amount, max(crest, rim), rim, veil, true);
}
