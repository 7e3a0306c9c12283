// The surface of the sea at a moment: offshore groups, then the shore waves on top (D30). The twin is level/waves.py.
#include "level/shore.glsl"
#include "level/gerstner.glsl"
#include "level/force.glsl"
#include "level/patches.glsl"
#ifdef RIVERS
#include "level/river.glsl"
#endif

uniform float u_sea_level_m, u_deep_full_m, u_sea_on, u_wave_height_m;

const float DEEP_M = 4.0;  // there is no sand that the slice knows

struct Sea {
    vec3 position;     // world, after deformation
    vec3 normal;
    vec2 before;       // world xy before deformation: foam and normal maps ride on it (H30)
    float height01;    // height over the still sea against the largest possible sum
    float deep;        // weight of the offshore waves
    ShoreMasks shore;  // at the world position after deformation
    Bed bed;           // there too
    float sheet;       // water over the sand, m; at or below 0 the sheet lies on it without thickness (H10)
    float still;       // how far its level is over the sea's, where a river is (D13)
#ifdef RIVERS
    River river;
#endif
};

// Weight of the offshore waves: they fade in with depth (D11) and exist only in the sea.
vec3 deep_weight(Bed bed) {
    return d_mul(d_step(u_deep_start_m, u_deep_full_m, bed.smoothed), bed.sea) * u_sea_on;
}

// The sand that the sheet slides on, over the still sea: only where the sea comes (H10).
float beach_under(Bed bed, Beach beach) { return u_shore_slide > 0.0 && bed.sea.x > 0.0 ? beach.sand.x - u_tide_m : NO_BEACH_M; }

#ifdef RIVERS
// What a river leaves of a shore wave; where it makes it higher, it stays as wide.
void fade_shore(inout ShoreMasks shore, vec3 waves) {
    shore.lift = d_mul(shore.lift, waves);
    waves = waves.x > 1.0 ? d_const(1.0) : waves;
    shore.line *= waves.x;
    shore.back *= waves.x;
    shore.fall *= waves.x;
#ifdef PLUNGE
    shore.shift_x = d_mul(shore.shift_x, waves);
    shore.shift_y = d_mul(shore.shift_y, waves);
#endif
}
#endif

Sea sea_surface(vec2 before) {
    Bed start = bed_at(before);
    vec3 weight = deep_weight(start), chop = weight;
#ifdef RIVERS
    River there = river_at(before);
    chop = d_mul(weight, there.chop);
    weight = d_mul(weight, there.waves);
#endif
#ifdef WAVE_OBJECTS
    objects_depth = start.smoothed;
    objects_sea = start.sea * u_sea_on;
#ifdef RIVERS
    objects_depth += there.level + u_deep_start_m * there.own;  // H32: on water of its own they stand wherever it is deep
    objects_sea = (start.sea + there.own - d_mul(start.sea, there.own)) * u_sea_on;
#endif
#endif
    Deformed p = gerstner(before, weight, chop);
    vec2 after = vec2(p.x.x, p.y.x);
    Bed bed = bed_at(after);
    bed.within = d_mul(bed.within, patch_shore(after));
    Beach beach = NO_BEACH;  // WebGL chooses between no structs by ?:
    if (!(before_waves(bed) && bed.depth.x > DEEP_M)) beach = beach_at(after);
    ShoreMasks shore = shore_masks(bed, beach.sway, after);
    // d lift / d before = d lift / d after · d after / d before
#ifdef RIVERS
    River river = river_at(after);
    fade_shore(shore, river.waves);
    vec3 lift = shore.lift + river.rise;
    float still = river.still;
#else
    vec3 lift = shore.lift;
    const float still = 0.0;
#endif
#ifdef RIVERS
    vec3 floats = bed.sea * (1.0 - river.share) + d_const(river.share), depth = bed.depth + river.rise;
    lift += d_mul(d_mul(force_lift(after), floats), d_step(0.0, 0.5, depth));
#else
    lift += d_mul(d_mul(force_lift(after), bed.sea), d_step(0.0, 0.5, bed.depth));
#endif
    float rise = p.z.x + lift.x, sheet = rise - beach_under(bed, beach);
    float held = sheet < 0.0 ? beach_contact(after).x : 0.0;  // H10: the higher of the two, with its slope
    vec2 up = mix(lift.yz, beach.sand.yz, held);
    vec2 slope = (1.0 - held) * p.z.yz + vec2(dot(up, vec2(p.x.y, p.y.y)), dot(up, vec2(p.x.z, p.y.z)));
#ifdef PLUNGE
    // the body is carried on along the way of its wave (H23): d world / d before = (1 + d shift / d after) · d after / d before
    vec2 p_x = p.x.yz, p_y = p.y.yz;
    p.x.yz += shore.shift_x.y * p_x + shore.shift_x.z * p_y;
    p.y.yz += shore.shift_y.y * p_x + shore.shift_y.z * p_y;
    after += vec2(shore.shift_x.x, shore.shift_y.x);
#endif
    vec3 normal = normalize(cross(vec3(p.x.y, p.y.y, slope.x), vec3(p.x.z, p.y.z, slope.y)));
    return Sea(vec3(after, u_sea_level_m + rise - held * sheet), normal, before,
               clamp((rise - still) / u_wave_height_m, -1.0, 1.0), min(weight.x, 1.0), shore, bed, sheet, still
#ifdef RIVERS
               , river
#endif
               );
}
