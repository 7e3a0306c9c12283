// When fronts pass a place, how fast and how high, and whether they have broken (T06). The twin is level/timing.py.
#include "level/waves.glsl"

uniform float u_front_period_s, u_timing_breaker;
uniform vec3 u_breaker_colours[3];  // spilling, plunging, surging

const float BROKEN_SHARE = 0.95;    // level/surf.py
const vec2 BREAKER_LIMITS = vec2(0.4, 2.0);
const float FLAT = 0.03;

struct Passage {
    vec3 since;       // dual: crests that have passed since the clock's cycle began
    float arrival_s;
    float speed_mps;
    float strength;   // 1 where a wave stands that one can see
    float broken;     // below 0 before the break, above it behind
    float similarity; // ξ
};

Passage passage_at(vec2 xy) {
    Bed bed = bed_at(xy);
    vec3 s = d_const(1.0) - bed.smoothed / u_shore_range_m;
    vec3 early = shore_early(xy, beach_at(xy).sway);
    float high = shore_height_along(s).x, share = 0.0;
#ifdef TRAVEL_TIME
    share = u_arrival_share;
    Passing passing = passing_at(xy);
    vec3 late = pinned_later(xy) * (1.0 - share);
    early = d_mul(early + late, d_step(0.0, 1.0, s)) - late;
    vec3 cycles = lead_arrival(passing, phase_noise(HIGH_FRONTS, xy), s, early);
    high = mix(high, passing.lead_height.x, share);
#else
    vec3 cycles = s * s_cycles() - early;
#endif
    if (share < 1.0) high *= smoothstep(0.0, max(u_shore_fade_in, 1e-3), s.x) * u_shore_on;
    Passage p;
    p.since = d_const(u_shore_clock * float(u_shore_count)) - cycles;
    p.arrival_s = cycles.x * u_front_period_s;
    p.speed_mps = 1.0 / max(length(cycles.yz) * u_front_period_s, 1e-6);
    float sea = bed.sea.x * bed.within.x * patch_shore(xy).x;
    p.strength = step(0.5, sea) * smoothstep(0.5, 1.0, bed.within.x) * smoothstep(0.0, 3.0 * FLAT, high) * float(s.x < 1.0);
    float height_m = high * u_shore_height_m;
    float most_m = u_timing_breaker * BROKEN_SHARE * max(bed.smoothed.x, 1e-3);
    p.broken = mix(s.x / BREAK_S - 1.0, clamp(height_m / most_m - 1.0, -1.0, 1.0), share);
    float length_m = 9.81 * u_front_period_s * u_front_period_s / TURN;
    p.similarity = length(bed.smoothed.yz) / sqrt(max(height_m, 1e-3) / length_m);
    return p;
}

uniform vec2 u_shaping;  // steepest slope that shaping leaves, rise over run; m over which slopes count

// What shaping a front may do to the bed (T07): green it may get steeper, red it may not, for it is as steep as the limit or on
// the level's border; dim where no wave stands that could be moved, grey on land.
vec3 passage_shaped(vec2 xy) {
    Passage here = passage_at(xy);
    float far = max(1.73 * u_shaping.y, u_bed_cell_m);  // a difference so wide smooths as a Gaussian of that sigma does
    vec2 slope = vec2(bed_at(xy + vec2(far, 0.0)).depth.x - bed_at(xy - vec2(far, 0.0)).depth.x,
                      bed_at(xy + vec2(0.0, far)).depth.x - bed_at(xy - vec2(0.0, far)).depth.x) / (2.0 * far);
    vec2 extent = vec2(textureSize(u_bed, 0) - 1) * u_bed_cell_m, inside = min(xy, extent - xy);
    float used = min(inside.x, inside.y) < 4.0 * u_bed_cell_m ? 1.0 : length(slope) / u_shaping.x;
    vec3 colour = used >= 1.0 ? vec3(0.70, 0.06, 0.05)
                              : mix(vec3(0.06, 0.42, 0.20), vec3(0.85, 0.62, 0.10), smoothstep(0.2, 0.9, used));
    if (bed_at(xy).depth.x <= 0.0) return vec3(0.10);
    return colour * (here.strength > 0.0 ? 1.0 : 0.3);
}

// Index of spilling, plunging, surging.
int breaker_kind(Passage p) { return int(p.similarity >= BREAKER_LIMITS.x) + int(p.similarity >= BREAKER_LIMITS.y); }

vec3 breaker_shown(Passage p) {
    return p.strength * (p.broken < 0.0 ? vec3(0.08) : u_breaker_colours[breaker_kind(p)] * (1.0 - 0.6 * min(p.broken * 2.0, 1.0)));
}

// Seconds of arrival (x) and speed over the ground (y) where a wave stands.
vec2 passage_shown(vec2 xy) {
    Passage p = passage_at(xy);
    return p.strength > 0.0 ? vec2(p.arrival_s, p.speed_mps) : vec2(0.0);
}
