// Where a pixel's ray meets the wave: the mesh is off it by its curvature between vertices (D30, H21).
#include "level/waves.glsl"
#include "level/noise.glsl"
#include "lib/sea_below.glsl"

uniform float u_swell_length_m, u_chop_length_m;
#ifdef TESSELLATED
const int BEYOND = 14;  // steps, longer and longer, to what lies behind a crest that the mesh puts too high
#else
const int BEYOND = 0;
#endif
const int REFINEMENTS = 3, STEPS = 12, CLOSER = 8;
const float LONGER = 1.3;
const float MOST_REFINED_M = 1.5, REFINED_FROM_M = 50.0, NEAR_ENOUGH_M = 0.02, CLOSE_M = 0.005, ENOUGH_M = 0.06;
const float FOUND_M = 150.0;  // beyond, a pixel is wider than what the mesh is off
const float SEARCH_M = 120.0;  // up to here the drawn surface is the twin's within 3 cm
const float GROUP_TILE = 14.0;  // side of the noise by which the swell comes in groups, in wavelengths

// Seen from afar three fronts are a lattice; a real swell comes in groups, now from here and now from there. Uniform
// noise times √3 has a mean square of 1: the slopes keep their energy.
void group_swell(vec2 xy, float away, float pixel_m) {
    float far = smoothstep(SEARCH_M, 4.0 * SEARCH_M, away);
    if (far <= 0.0) return;
    float tile = GROUP_TILE * u_swell_length_m;
    vec3 here = vec3(noise_at(xy, tile, pixel_m).r, noise_at(turn(xy, 0.6, 0.8) + 0.31 * tile, tile, pixel_m).r,
                     noise_at(turn(xy, -0.8, 0.6) + 0.67 * tile, tile, pixel_m).r);
    swell_gain = mix(vec3(1.0), 1.732 * here, far);
    swell_turn = far * here.yzx;
}

// How far a camera-relative point is above the plane that touches the wave where `sea` is.
float above_sea(vec3 point, Sea sea) {
    vec2 off = point.xy + u_camera.xy - sea.position.xy;
    return point.z + u_camera.z - sea.position.z + dot(sea.normal.xy, off) / max(sea.normal.z, 0.1);
}

const int REFINE = 0, MARCH = 1, CLOSE = 2, FOUND = 3, MISSED = 4, KEEP = 5;

struct Search {
    int stage, steps;
    float way;             // along the ray from the mesh, metres
    float most_m, step_m;  // how far it may be off: its cells grow with the distance
    float low, high, low_above, high_above;
};

// The wave was `above` under the ray at s.way. Steep waves: look along the ray for where it goes under, then between by
// regula falsi, the end that stays at half its weight (the Illinois rule, Dowell & Jarratt 1971).
void look_along(inout Search s, float above) {
    bool same_side = above * s.low_above > 0.0;
    if (s.stage == MARCH && (same_side || s.steps == 0)) {
        s.low = s.way;
        s.low_above = above;
        if (++s.steps > STEPS) s.step_m *= LONGER;
        s.way += s.step_m;
        if (s.steps > STEPS + BEYOND) s.stage = MISSED;
        return;
    }
    s.steps = s.stage == MARCH ? 0 : s.steps + 1;
    if (same_side) s.low = s.way;
    else s.high = s.way;
    s.high_above = same_side ? 0.5 * s.high_above : above;
    s.low_above = same_side ? above : s.stage == MARCH ? s.low_above : 0.5 * s.low_above;
    s.stage = CLOSE;
    if (abs(above) < CLOSE_M || s.steps >= CLOSER) s.stage = abs(above) < NEAR_ENOUGH_M ? FOUND : MISSED;
    else s.way = mix(s.low, s.high, clamp(s.low_above / (s.low_above - s.high_above), 0.05, 0.95));
}

// One step to where the ray meets the plane that touches the wave. The last one is shorter than a pixel and needs no
// wave of its own. Where the ray only grazes or the step is too long: kept if the mesh is near enough, else searched.
void touch(inout Search s, float above, vec3 normal, vec3 start, vec3 along, bool fine) {
    float grazing = dot(along, normal), away = length(start);
    float step_m = -above * normal.z / (abs(grazing) > 0.02 ? grazing : 0.02), way = s.way + step_m;
    bool lost = abs(way) > s.most_m || abs(grazing) <= 0.02 || dot(start + along * way, u_forward) <= 0.0;
    if (lost || s.steps >= REFINEMENTS) {
        s.stage = fine ? KEEP : MARCH;
        s.way = fine ? 0.0 : -s.most_m;
        s.steps = 0;
        return;
    }
    ++s.steps;
    s.way = way;
    if (abs(step_m) < clamp(away * u_pixel_angle, 0.004, ENOUGH_M)) s.stage = FOUND;
}

bool behind_land(vec3 relative) {
    float land = texelFetch(under_eye_depth, ivec2(gl_FragCoord.xy), 0).r;
    return land > 0.0 && land < eye_depth_of(relative);
}

// The wave at a pixel: where its ray meets it, if `exact`, else where the mesh is. One loop with one evaluation: software
// OpenGL runs the code of every branch once, whether anybody takes it or not. Discarded where the ray misses the wave.
Sea sea_found(bool exact, inout vec3 relative, inout vec2 before) {
    vec3 start = relative, along = normalize(relative);
    vec2 first = before;
    float away = length(start), most_m = MOST_REFINED_M * max(away / REFINED_FROM_M, 1.0);
    Search s = Search(REFINE, 0, 0.0, most_m, 2.0 * most_m / float(STEPS), 0.0, 0.0, 0.0, 0.0);
    bool fine = away > SEARCH_M;
    Sea sea;
    for (int i = 0; i < 3 + REFINEMENTS + STEPS + BEYOND + CLOSER; ++i) {
        sea = sea_surface(before);
#ifdef PLUNGE
        // where a crest falls over, a ray meets it more than once: the mesh knows which one is in front
        if (i == 0 && dot(vec2(sea.shore.shift_x.x, sea.shore.shift_y.x), vec2(sea.shore.shift_x.x, sea.shore.shift_y.x)) > 0.0025)
            s.stage = KEEP;
#endif
        if (!exact || s.stage == KEEP) break;
        vec3 point = start + along * s.way;
        vec2 off = point.xy + u_camera.xy - sea.position.xy;
        float above = above_sea(point, sea);
        fine = fine || (i == 0 && abs(above) < NEAR_ENOUGH_M);
        bool refines = s.stage == REFINE;
        if (refines) touch(s, above, sea.normal, start, along, fine);
        else look_along(s, above);
        before = refines && s.stage == MARCH ? first + along.xy * s.way : before + off + start.xy + along.xy * s.way - point.xy;
        if (s.stage == FOUND && s.way > most_m && behind_land(start + along * s.way)) s.stage = MISSED;
#ifdef TESSELLATED
        if (s.stage == MISSED) s.stage = KEEP;  // cells are large for few pixels: better the mesh than a hole
#endif
        if (s.stage == KEEP) {
            s.way = 0.0;
            before = first;
            if (i == 0) break;
        }
        if (s.stage == FOUND || s.stage == MISSED) break;
    }
    if (s.stage == MISSED) discard;
    relative = start + along * s.way;
    return sea;
}
