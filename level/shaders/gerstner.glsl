// Gerstner waves by frequency groups (H05, H06, H29). The twin is level/gerstner.py.
#include "level/noise_lattice.glsl"
#include "level/arrival.glsl"
#include "level/pins.glsl"

const int FRONTS = 8;           // the high group's five, then the low group's three
const int HIGH_FRONTS = 5;
const float TURN = 6.28318530718;

uniform vec4 u_front_way[FRONTS];   // direction / wavelength (cycles per metre: x, y), phase in cycles, k in rad/m
uniform vec4 u_front_size[FRONTS];  // amplitude_m, lateral_m, unit direction (x, y)
uniform vec2 u_front_turn[FRONTS];  // how far noise bends its crests, in wavelengths, and where that begins (H07)
uniform float u_phase_noise_m, u_deep_start_m;

// What a drawing shader leaves of the high group where its cells or pixels are too coarse for it; 1 is the true sea.
float chop_share = 1.0;
// And how it breaks the rows of the low group, which from afar stand in one lattice: a gain and a phase by front.
vec3 swell_gain = vec3(1.0), swell_turn = vec3(0.0);

struct Deformed { vec3 x; vec3 y; vec3 z; };  // duals: world x, world y, height over the still sea

// A smooth rise and fall over one cycle, 0 … 1, and how it changes.
vec2 crest_bend(float cycles) {
    float f = fract(cycles), t = abs(2.0 * f - 1.0);
    return vec2(t * t * (3.0 - 2.0 * t), f < 0.5 ? -12.0 * t * (1.0 - t) : 12.0 * t * (1.0 - t));
}

// How far front i, of that size and way, is ahead at undeformed xy, in wavelengths: two lengths in the golden ratio along
// its crests, constant along its way, so that the crests bend and none changes its speed; a dual (H07).
vec3 phase_noise(int i, vec4 size, vec2 before) {
    vec2 crest = vec2(size.w, -size.z), turn = u_front_turn[i];
    float along = 0.5 * dot(before, crest) / u_phase_noise_m;
    vec2 noise = crest_bend(along + turn.y) + crest_bend(0.618034 * along - turn.y) * vec2(1.0, 0.618034);
    vec3 bend = turn.x * vec3(0.5 * noise.x - 0.5, 0.25 * noise.y / u_phase_noise_m * crest);
#ifdef TRAVEL_TIME
    if (i == HIGH_FRONTS) bend += pinned_later(before);
#endif
    return bend;
}

vec3 phase_noise(int i, vec2 before) { return phase_noise(i, u_front_size[i], before); }

// Adds what a front moves a point; `first` that of its group.
void add_front(int i, vec4 way, vec4 size, int first, Deformed point, vec2 before, inout vec3 dx, inout vec3 dy,
               inout vec3 dz) {
    if (first == HIGH_FRONTS) {
        way.z += swell_turn[i - first];
        size.xy *= swell_gain[i - first];
    }
    // Phases are kept in cycles and wrapped, so that float32 is as good at 7 days as at 0.
    vec3 noise = phase_noise(i, size, before);
    float theta = TURN * fract(dot(way.xy, vec2(point.x.x, point.y.x)) - way.z + noise.x);
    float s = sin(theta), c = cos(theta);
    vec2 slope = way.w * (size.z * point.x.yz + size.w * point.y.yz) + TURN * noise.yz;
    vec3 lateral = size.y * vec3(c, -s * slope);
    dx += lateral * size.z;
    dy += lateral * size.w;
    dz += size.x * vec3(s, c * slope);
}

#ifdef TRAVEL_TIME
// The same of swell i on its way over the bed: phases are times of arrival, crests go the way in which those grow (T06).
void add_swell(int i, vec4 size, Passing passing, Deformed point, vec2 before, inout vec3 dx, inout vec3 dy, inout vec3 dz) {
    vec4 way = u_front_way[HIGH_FRONTS + i];
    vec3 noise = phase_noise(HIGH_FRONTS + i, before), cycles = passing.swells[i], gain = passing.gains[i];
    float steep = length(cycles.yz), theta = TURN * fract(cycles.x + noise.x + 0.25 - way.z - swell_turn[i]);
    size.xy *= swell_gain[i];
    size.zw = steep > 1e-6 ? cycles.yz / steep : size.zw;
    size.y *= min(1.0, way.w / max(TURN * steep, 1e-6));  // shorter waves would fold over
    float s = sin(theta), c = cos(theta);
    vec2 slope = TURN * (cycles.y * point.x.yz + cycles.z * point.y.yz + noise.yz);
    gain.yz = gain.y * point.x.yz + gain.z * point.y.yz;
    vec3 lateral = d_mul(size.y * vec3(c, -s * slope), gain);
    dx += lateral * size.z;
    dy += lateral * size.w;
    dz += d_mul(size.x * vec3(s, c * slope), gain);
}
#endif

#ifdef WAVE_REGIONS
#include "level/wave_regions.glsl"
#endif
#ifdef WAVE_OBJECTS
#include "level/wave_objects.glsl"
#endif

Deformed gerstner_group(Deformed point, int first, int end, vec3 weight, vec2 before) {
    vec3 dx = vec3(0.0), dy = vec3(0.0), dz = vec3(0.0);
    int plain = end;
#ifdef TRAVEL_TIME
    Passing passing;
    if (first == HIGH_FRONTS) {
        passing = passing_at(vec2(point.x.x, point.y.x));
        for (int i = 0; i < end - first; ++i)
            add_swell(i, u_front_size[first + i], passing, point, before, dx, dy, dz);
        plain = first;
    }
#endif
    for (int i = first; i < plain; ++i) add_front(i, u_front_way[i], u_front_size[i], first, point, before, dx, dy, dz);
#ifdef WAVE_REGIONS
#ifdef TRAVEL_TIME
    blend_regions(first, end, passing, point, before, dx, dy, dz);
#else
    blend_regions(first, end, point, before, dx, dy, dz);
#endif
#endif
    Deformed moved = Deformed(point.x + d_mul(dx, weight), point.y + d_mul(dy, weight), point.z + d_mul(dz, weight));
#ifdef WAVE_OBJECTS
    ivec2 objects = first == 0 ? ivec2(0, u_wave_ends.x) : u_wave_ends;
    add_wave_objects(objects.x, objects.y, point.x, point.y, before, first == 0 ? chop_share : 1.0, moved);
#endif
    return moved;
}

// With weights of swell and chop.
Deformed gerstner(vec2 before, vec3 swell, vec3 chop) {
    Deformed point = Deformed(vec3(before.x, 1.0, 0.0), vec3(before.y, 0.0, 1.0), vec3(0.0));
#ifdef NO_GERSTNER
    return point;
#endif
    point = gerstner_group(point, 0, HIGH_FRONTS, chop * chop_share, before);
    return gerstner_group(point, HIGH_FRONTS, FRONTS, swell, before);
}
