// What the sea is made of at a pixel: foam from the shore masks, ripples by depth, light from below (D04 D09 L06 L07).
// sea.glsl finds the point and the normal; this says how it looks.
#include "lib/sky.glsl"
#include "lib/water.glsl"
#include "lib/foam.glsl"
#include "level/foam_amount.glsl"
#include "level/current.glsl"

// Ripples die out in thin sheets.
float ripple_share(float column) { return mix(0.10, 1.0, smoothstep(0.02, 1.6, column)); }

const float DRIFT_MPS = 0.3;  // bores carry more up the beach than drains back between them

// Way of the water at the surface, m/s. It knows nothing of the single front: foam is moved by it over seconds, and where
// it changes within metres it would be drawn out into teeth.
vec2 surface_flow(Sea sea) {
    vec2 uphill = -sea.bed.smoothed.yz;
    return uphill / max(length(uphill), 0.02) * (smoothstep(BREAKS_S, BROKEN_S, sea.shore.s) * u_shore_on * DRIFT_MPS);
}

uniform float u_foam_shadow, u_foam_shadow_limit_m;

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

// Foam as it lies on the water; `painted` is the foam layer.
Foam sea_foam(Sea sea, vec2 before, float column, float sharp, vec2 painted, vec4 current, bool waves, float pixel_m) {
    FoamAmount found = foam_amount(sea, before, column, sharp, painted, current, waves, stirred, pixel_m);
    if (!found.any) return Foam(found.veil, 0.0, 0.0, 0.5, 0.5);
    ride_the_sheet(sea, before);
    vec2 flow = surface_flow(sea) + current.rg;
    Foam foam = foam_at(before, found.amount, found.fresh, found.rim, flow, u_sun_direction.xy, pixel_m);
    foam.cover = max(foam.cover, found.veil);
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
