// What the sea is made of at a pixel: foam from the shore masks, ripples by depth, light from below (D04 D09 L06 L07).
// sea.glsl finds the point and the normal; this says how it looks.
#include "lib/sky.glsl"
#include "lib/water.glsl"
#include "lib/foam.glsl"
#include "lib/swash.glsl"
#include "lib/current.glsl"

const float BREAKS_S = 0.45, BROKEN_S = 0.85;  // share of the shore range over which fronts turn into foam

// Metres of water over the bed, from the shore map: steady where the ray's way through thin water isn't.
float water_column(Sea sea, float height) { return sea.bed.depth.x + height - u_sea_level_m; }

// Ripples die out in thin sheets.
float ripple_share(float column) { return mix(0.10, 1.0, smoothstep(0.02, 1.6, column)); }

const float DRIFT_MPS = 0.3;  // bores carry more up the beach than drains back between them

// Way of the water at the surface, m/s. It knows nothing of the single front: foam is moved by it over seconds, and where
// it changes within metres it would be drawn out into teeth.
vec2 surface_flow(Sea sea) {
    vec2 uphill = -sea.bed.smoothed.yz;
    return uphill / max(length(uphill), 0.02) * (smoothstep(BREAKS_S, BROKEN_S, sea.shore.s) * u_shore_on * DRIFT_MPS);
}

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
uniform float u_foam_transient, u_foam_constant, u_foam_shadow, u_foam_shadow_limit_m;
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

const float RIDES_S = 0.80, CARRIED_S = 0.96;  // share of the range over which foam begins to ride the sheet
const float MOST_CARRIED_M = 5.0;              // on a flat it would be torn
const float BROAD_M = 22.0;                    // half the length over which the way up the beach is taken

// Way up the beach times its slope, over so broad a piece of it that rocks turn nothing.
vec2 broad_uphill(vec2 xy) {
    vec2 size = vec2(textureSize(u_bed, 0)), at = xy / u_bed_cell_m + 0.5, off = vec2(BROAD_M / u_bed_cell_m, 0.0);
    vec4 depths = vec4(textureLod(u_bed, (at - off) / size, 0.0).a, textureLod(u_bed, (at + off) / size, 0.0).a,
                       textureLod(u_bed, (at - off.yx) / size, 0.0).a, textureLod(u_bed, (at + off.yx) / size, 0.0).a);
    depths = max(depths, 0.0);  // a rock that stands out is no beach
    return (depths.xz - depths.yw) / (2.0 * BROAD_M);
}

// Foam on the beach is carried up with the sheet and back by the shore's own phase (H20). Places that move with it lie
// close together: were they carried as far as each one's own slope says, foam would be combed into teeth up the beach.
void ride_the_sheet(Sea sea, vec2 before) {
    ShoreMasks m = sea.shore;
    float s = 1.0 - sea.bed.smoothed.x / u_shore_range_m;
    float phase = swash_phase(m), share = smoothstep(RIDES_S, CARRIED_S, s) * sea.bed.sea.x * u_shore_on * u_shore_vertex;
#ifdef RIVERS
    share *= 1.0 - smoothstep(0.0, 0.6, sea.river.share);  // in a mouth the current takes it along
#endif
    float number = floor(m.arrived) + float(u_shore_cycle * u_shore_count);
    beach_ride = vec3(phase, u_shore_turns > 0 ? float(looped_wave(int(number))) : number, share);
    beach_turns = float(u_shore_turns);
    if (share <= 0.0) return;
    vec2 uphill = broad_uphill(before);
    float steep = max(length(uphill), 0.06);
    float way_m = min(max(m.edge_s - 1.0, 0.0) * u_shore_range_m / steep, MOST_CARRIED_M);
    beach_carried = uphill / steep * (way_m * smoothstep(0.0, 1.0, s));
}

// Foam that the pushed water makes at this pixel (D18).
float stirred = 0.0;

// What the waves leave: crest line, torn back, lace on the sheet, its rim on the sand; `painted` is the foam layer.
Foam sea_foam(Sea sea, vec2 before, float column, float sharp, vec2 painted, vec4 current, bool waves, float pixel_m) {
    vec2 layers = foam_painted(painted, sea.shore);
    float paint = max(layers.x, layers.y);
    ShoreMasks m = sea.shore;
    float shore = sea.bed.sea.x * u_shore_on;
    float veil, offshore = whitecaps(before, sea.height01 * sharp, pixel_m, veil) * sea.deep;
    veil *= waves ? sea.deep : 0.0;
    // what a shore wave lifts has foam of its own: only the open sea's heights count
    float still = waves ? foam_of_height(sea.height01 * min(2.0 * sea.deep, 1.0) * sharp) * sharp : 0.0;
    bool far_out = shore * m.s < 0.2 && current.a > u_foam_shore_far_m;
    if (far_out && offshore + paint + still + stirred < 0.004) return Foam(veil, 0.0, 0.0, 0.5, 0.5);
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
    ride_the_sheet(sea, before);
    vec2 flow = surface_flow(sea) + current.rg;
    Foam foam = foam_at(before, amount, max(crest, rim), rim, flow, u_sun_direction.xy, pixel_m);
    foam.cover = max(foam.cover, veil);
    return foam;
}

// Where the foam lies that shades what is below a place: towards the sun by the depth up to a limit, so that no shade
// reaches past the level's border.
vec2 foam_shade_place(vec2 before, float depth) {
    return before + u_sun_direction.xy * min(max(depth, 0.0), u_foam_shadow_limit_m);
}

// Shade that the constant foam at a place throws (D21): its texture at mip 2, moved with the same two phases; `painted`
// and `current` are those of the place itself. 1 where the sun comes through.
float foam_shade(vec2 at, vec2 painted, vec4 current, float pixel_m) {
    float amount = max(painted.y * u_foam_constant, foam_of_shore(current.a, 0.5)) * (1.0 - u_quiet_foam * current.b);
    if (u_foam_shadow * amount < 0.01) return 1.0;
    vec2 first, second;
    float weight, lod = max(log2(max(pixel_m * FOAM_TEXELS / u_foam_tile_m, 1e-4)), 2.0);
    foam_places(at, current.rg, first, second, weight);
    vec4 fields = textureLod(u_foam, first, lod);
    if (weight > 0.0) fields = mix(fields, textureLod(u_foam, second, lod), weight);
    return 1.0 - u_foam_shadow * foam_cover(fields, 0.6 * amount, lod);
}

// How much of a shore wave stands here, 0 … 1.
float wave_body(Sea sea, float sharp) {
    float stands = smoothstep(0.12, 0.8, sea.shore.lift.x / max(u_shore_height_m, 0.1));
#ifdef PLUNGE
    // a lip is as thick on its way down as it was on the crest
    vec2 shift = vec2(sea.shore.shift_x.x, sea.shore.shift_y.x);
    stands = max(stands, smoothstep(0.4, 1.4, length(shift)) * sea.shore.breaker.plunging.x);
#endif
    return stands * sea.bed.sea.x * u_shore_on * sharp;
}

// 0 where the bed is so steep that a front would stand on a strip of a metre: the edge of a reef or a bar seen from the
// calm side. There it is a spent low wave, no wall of water.
float wave_breadth(Sea sea) {
    return smoothstep(1.2, 2.6, u_shore_width * u_shore_range_m / max(length(sea.bed.smoothed.yz), 1e-3));
}

// 1 on its steep shoreward face, where the eye looks a long way through green water.
float wave_face(Sea sea, vec3 normal, float body) {
    vec2 uphill = -sea.bed.smoothed.yz;
    float steep = length(uphill);
    return steep > 1e-4 ? body * smoothstep(0.04, 0.30, dot(normal.xy, uphill / steep)) : 0.0;
}

// Form of a standing wave in the light that comes out of it: sides that turn away from the sun take in less.
float wave_shade(vec3 normal, float body) {
    float turned = (dot(normal, vec3(u_sun_direction.xy, max(u_sun_direction.z, 0.0))) + 0.35) / (max(u_sun_direction.z, 0.0) + 0.35);
    return mix(1.0, clamp(turned, 0.45, 1.5), body);
}
