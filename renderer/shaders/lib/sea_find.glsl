// Where a pixel's ray meets the wave: the mesh is off it by its curvature between vertices (D30, H21).
#include "level/waves.glsl"
#include "lib/noise.glsl"
#include "lib/sea_below.glsl"

uniform float u_swell_length_m, u_chop_length_m;
#ifdef TESSELLATED
const int BEYOND = 14;  // steps, longer and longer, to what lies behind a crest that the mesh puts too high
#else
const int BEYOND = 0;
#endif
const int REFINEMENTS = 3, STEPS = 12, CLOSER = 8;
const float LONGER = 1.3;
const float MOST_REFINED_M = 1.5, REFINED_FROM_M = 50.0, NEAR_ENOUGH_M = 0.02, CLOSE_M = 0.005, ENOUGH_M = 0.015;
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

// The wave where the pixel's ray is `way` metres beyond `start`; returns how far the ray is above it.
float above_wave(vec3 start, vec3 along, float way, inout vec2 before, out Sea sea) {
    vec3 point = start + along * way;
    sea = sea_surface(before);
    vec2 off = point.xy + u_camera.xy - sea.position.xy;
    before += off;
    return point.z + u_camera.z - sea.position.z + dot(sea.normal.xy, off) / max(sea.normal.z, 0.1);
}

// How far off the mesh may be, along the ray: its cells grow with the distance.
float most_refined(float away) { return MOST_REFINED_M * max(away / REFINED_FROM_M, 1.0); }

// Steep waves: look along the ray for where it goes under, then between by regula falsi, the end that stays at half its
// weight (the Illinois rule, Dowell & Jarratt 1971). False where it passes over the wave.
bool search_surface(inout vec3 relative, inout vec2 before, inout Sea sea) {
    vec3 start = relative, along = normalize(relative);
    float low_end = -most_refined(length(start)), low = low_end, high = low, low_above, high_above;
    float step_m = -2.0 * low / float(STEPS);
    vec2 at = before + along.xy * low;
    low_above = above_wave(start, along, low, at, sea);
    bool crossed = false;
    for (int i = 1; i <= STEPS + BEYOND && !crossed; ++i) {
        if (i > STEPS) step_m *= LONGER;
        at += along.xy * step_m;
        high = low + step_m;
        high_above = above_wave(start, along, high, at, sea);
        crossed = high_above * low_above <= 0.0;
        if (!crossed) {
            low = high;
            low_above = high_above;
        }
    }
    if (!crossed) return false;
    float way = high, above = high_above;
    for (int i = 0; i < CLOSER && abs(above) > CLOSE_M; ++i) {
        way = mix(low, high, clamp(low_above / (low_above - high_above), 0.05, 0.95));
        above = above_wave(start, along, way, at, sea);
        if (above * low_above > 0.0) {
            low = way;
            low_above = above;
            high_above *= 0.5;
        } else {
            high = way;
            high_above = above;
            low_above *= 0.5;
        }
    }
    relative = start + along * way;
    before = at;
    if (way > -low_end) {
        float land = texelFetch(under_eye_depth, ivec2(gl_FragCoord.xy), 0).r;
        if (land > 0.0 && land < eye_depth_of(relative)) return false;
    }
    return abs(above) < NEAR_ENOUGH_M;
}

// The mesh is off the wave by its curvature between vertices: go along the pixel's ray to where it meets the plane that
// touches the wave, take the wave there, again. Kept where the ray only grazes, or far off; discarded where it misses.
void onto_surface(inout vec3 relative, inout vec2 before, inout Sea sea) {
    vec3 start = relative, along = normalize(relative);
    vec2 first = before;
    float most_m = most_refined(length(start));
    for (int i = 0; i < REFINEMENTS; ++i) {
        float grazing = dot(along, sea.normal);
        float way = dot(sea.position - u_camera - relative, sea.normal) / (abs(grazing) > 0.02 ? grazing : 0.02);
        vec3 there = relative + along * way;
        if (length(there - start) > most_m || abs(grazing) <= 0.02 || dot(there, u_forward) <= 0.0) break;
        before += there.xy - (sea.position.xy - u_camera.xy);
        relative = there;
        if (abs(way) < ENOUGH_M) return;
        sea = sea_surface(before);
    }
    relative = start;
    before = first;
    vec2 at = first;
    bool fine = abs(above_wave(start, along, 0.0, at, sea)) < NEAR_ENOUGH_M || length(start) > SEARCH_M;
    if (fine || search_surface(relative, before, sea)) return;
#ifdef TESSELLATED
    relative = start;  // far from the wave where cells are large for few pixels: better the mesh than a hole
    before = first;
    sea = sea_surface(first);
#else
    discard;
#endif
}

