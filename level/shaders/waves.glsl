// The surface of the sea at a moment: offshore groups, then the shore waves on top (D30). The twin is level/waves.py.
#include "level/shore.glsl"
#include "level/gerstner.glsl"
#include "level/force.glsl"
#include "level/patches.glsl"

uniform float u_sea_level_m, u_deep_start_m, u_deep_full_m, u_sea_on, u_wave_height_m;

struct Sea {
    vec3 position;     // world, after deformation
    vec3 normal;
    vec2 before;       // world xy before deformation: foam and normal maps ride on it (H30)
    float height01;    // height over the still sea against the largest possible sum
    float deep;        // weight of the offshore waves
    ShoreMasks shore;  // at the world position after deformation
    Bed bed;           // there too
};

// Weight of the offshore waves: they fade in with depth (D11) and exist only in the sea.
vec3 deep_weight(Bed bed) {
    return d_mul(d_step(u_deep_start_m, u_deep_full_m, bed.smoothed), bed.sea) * u_sea_on;
}

Sea sea_surface(vec2 before) {
    vec3 weight = deep_weight(bed_at(before));
    Deformed p = gerstner(before, weight);
    vec2 after = vec2(p.x.x, p.y.x);
    Bed bed = bed_at(after);
    bed.within = d_mul(bed.within, patch_shore(after));
    ShoreMasks shore = shore_masks(bed, after);
    // d lift / d before = d lift / d after · d after / d before
    vec3 lift = shore.lift + d_mul(d_mul(force_lift(after), bed.sea), d_step(0.0, 0.5, bed.depth));
    vec2 slope = p.z.yz + vec2(dot(lift.yz, vec2(p.x.y, p.y.y)), dot(lift.yz, vec2(p.x.z, p.y.z)));
    vec3 normal = normalize(cross(vec3(p.x.y, p.y.y, slope.x), vec3(p.x.z, p.y.z, slope.y)));
    float rise = p.z.x + lift.x;
    return Sea(vec3(after, u_sea_level_m + rise), normal, before, clamp(rise / u_wave_height_m, -1.0, 1.0), weight.x,
               shore, bed);
}
