// The shore wave clock (D03, D04, D10). The twin is level/shore_waves.py: same names, same order.
#include "level/dual.glsl"
#include "level/noise_lattice.glsl"
#include "level/gerstner.glsl"
#include "level/bed.glsl"
#include "level/beach.glsl"
#include "level/breaking.glsl"

uniform float u_shore_clock;    // fract(t / travel), in cycles
uniform int u_shore_cycle;
uniform int u_shore_turns;      // after so many waves the same ones come again; 0: never
uniform int u_shore_count;
uniform float u_shore_range_m, u_shore_width, u_shore_gap, u_shore_runup, u_shore_back, u_shore_fall;
uniform float u_shore_height_m, u_shore_draw_m, u_shore_fade_in, u_shore_fade_out;
uniform float u_shore_variety, u_shore_variety_m, u_shore_runup_variety, u_shore_runup_by_slope, u_shore_stagger, u_shore_uprush;
uniform float u_shore_on, u_shore_vertex;

const float SWASH_S = 0.55;
const float LANDING_S = 0.85;  // from here to the water line times of arrival become those of the shoreline
const float POOL_M = 0.2;  // how far below the rim before it ground counts as a pool
const vec2 POOL_S = vec2(0.97, 1.0);  // and where such a rim stands: no wave goes on behind one

struct ShoreMasks {
    float a, b, line, back, fall;
    vec3 lift;    // dual: height over the still sea
    float edge_s; // the water's edge, in s
    float s;
    float front;  // s of the nearest front
    float arrived;  // swash_arrived there
#ifdef PLUNGE
    vec3 shift_x, shift_y;  // duals: how far waves that break carry it east and north, m (D34)
    float progress, white, splash;  // of the nearest wave; how white the waves are here; what splashes up, 0 … 1
    Breaker breaker;
#endif
};

float shore_fade(float f) {
    float limit = 1.0 + u_shore_runup;
    return smoothstep(0.0, u_shore_fade_in, f) * (1.0 - smoothstep(limit - u_shore_fade_out, limit, f));
}

// The masks of one wave: a, b, line, back, crest-fall. u = s - f is 0 on the front, below 0 behind it.
void shore_wave(float u, float fade, out float a, out float b, out vec3 masks) {
    float w = u_shore_width, gap = u_shore_gap, back_s = u_shore_back;
    b = smoothstep(-w / 2.0, w / 2.0, u);
    a = smoothstep(-gap - w / 2.0, -gap + w / 2.0, u);
    float c = smoothstep(-gap - back_s, -gap, u);
    float fall = smoothstep(-w / 2.0 - u_shore_fall / 2.0, 0.0, u) - smoothstep(0.0, w / 2.0 + u_shore_fall, u);
    masks = max(vec3(a - b, c - a, fall), 0.0) * fade;
}

// Its body, a dual: lifted from the back to the front flank, drawn down behind.
vec3 shore_body(vec3 u, vec3 f) {
    float w = u_shore_width, gap = u_shore_gap, back_s = u_shore_back;
    float limit = 1.0 + u_shore_runup;
    vec3 fade = d_mul(d_step(0.0, u_shore_fade_in, f), d_const(1.0) - d_step(limit - u_shore_fade_out, limit, f));
    vec3 b = d_step(-w / 2.0, w / 2.0, u);
    vec3 c = d_step(-gap - back_s, -gap, u);
    vec3 trail = d_positive(d_step(-gap - 2.0 * back_s, -gap - back_s, u) - c);
    vec3 shape = d_positive(c - b) - trail * (u_shore_draw_m / max(u_shore_height_m, 1e-6));
    return d_mul(shape, fade);
}

vec3 shore_height_along(vec3 s) {
    return d_mul(d_step(0.0, BREAK_S, s) * 0.7 + d_const(0.3), d_const(1.0) - d_step(BREAK_S, 1.0, s));
}

// Number of a wave among those of the loop.
int looped_wave(int wave) { return u_shore_turns > 0 ? (wave + 64 * u_shore_turns) % u_shore_turns : wave; }

// 0 … 1 along the shore for the wave of this number: what it lacks in height and in reach.
vec3 wave_noise(vec2 xy, int number) {
    int wave = looped_wave(number);
    return value_noise(xy, u_shore_variety_m, ivec2(wave * 17, wave * 29));
}

// How much earlier waves arrive at a place, in intervals: noise, and the sway along the shore (H20).
vec3 shore_early(vec2 xy, vec3 sway) {
    vec3 noise = (value_noise(xy, 3.0 * u_shore_variety_m, ivec2(11, 37)) - d_const(0.5)) * (2.0 * u_shore_stagger);
    vec3 early = noise + sway * u_shore_sway;
#ifdef TRAVEL_TIME
    return early - pinned_later(xy) * (1.0 - u_arrival_share);
#else
    return early - pinned_later(xy);
#endif
}

// Cycles that a front of the depth's clock takes for the whole range, s = 0 … 1.
float s_cycles() { return float(u_shore_count) / (1.0 + u_shore_runup); }

#ifdef TRAVEL_TIME
// How much later the lead comes for the shoreline's sake: on the sand fronts go on as those of the depth's clock do.
vec3 lead_bent(Passing passing, vec3 s_body) {
    vec3 on_land = passing.shore + (s_body - d_const(1.0)) * s_cycles();
    return d_mul(on_land - passing.swells[0], d_step(LANDING_S, 1.0, s_body));
}

// When fronts come, a dual in cycles. `bend`: H07.
vec3 lead_arrival(Passing passing, vec3 bend, vec3 s_body, vec3 early) {
    vec3 by_depth = s_body * s_cycles(), lead = passing.swells[0] + lead_bent(passing, s_body);
    return by_depth + (lead + bend - by_depth) * u_arrival_share - early;
}

// Waves that have passed the still water line since the cycle began, a dual; the fraction is the phase of the last one.
vec3 swash_arrived(Passing passing, vec3 bend, vec3 early) {
    vec3 shoreline = d_const(s_cycles());
    shoreline += (passing.shore + bend - shoreline) * u_arrival_share;
    return d_const(u_shore_clock * float(u_shore_count)) + early - shoreline;
}
#endif

vec3 swash_arrived(vec2 xy, vec3 early) {
#ifdef TRAVEL_TIME
    return swash_arrived(passing_at(xy), phase_noise(HIGH_FRONTS, xy), early);
#else
    return d_const(u_shore_clock * float(u_shore_count)) + early - d_const(s_cycles());
#endif
}

#include "level/shore_swash.glsl"

// True where no wave has come yet: it is deeper than the tail of the outermost one, and every mask and the lift are 0.
bool before_waves(Bed bed) {
#ifdef NO_SHORE_WAVES
    return true;
#endif
    float tail = max(max(u_shore_gap + 2.0 * u_shore_back, u_shore_gap + u_shore_width), u_shore_width + u_shore_fall);
    return u_shore_on <= 0.0 || min(bed.clock.x, bed.smoothed.x) > (1.0 + tail) * u_shore_range_m;
}

ShoreMasks shore_masks(Bed bed, vec3 sway, vec2 xy) {
    // The edge on the sand stands on the bed's own contours; waves go over a bed without rocks, or the body would sink
    // into a hole round each of them, and foam flicker while its front races through the gaps.
    float s = 1.0 - bed.clock.x / u_shore_range_m;
    vec3 s_body = d_const(1.0) - bed.smoothed / u_shore_range_m;
#ifdef PLUNGE
    ShoreMasks m = ShoreMasks(0.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0), 1.0, s, 9.0, 0.0, vec3(0.0), vec3(0.0), -9.0, 0.0, 0.0, NO_BREAKER);
#else
    ShoreMasks m = ShoreMasks(0.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0), 1.0, s, 9.0, 0.0);
#endif
    if (before_waves(bed)) return m;
    vec3 early = shore_early(xy, sway);
    int waves = u_shore_count;
#ifdef TRAVEL_TIME
    Passing passing = passing_at(xy);
    vec3 bend = phase_noise(HIGH_FRONTS, xy);
    vec3 late = pinned_later(xy) * (1.0 - u_arrival_share);
    early = d_mul(early + late, d_step(0.0, 1.0, s_body)) - late;
    vec3 arrived = swash_arrived(passing, bend, early);
    vec3 since = d_const(u_shore_clock * float(u_shore_count)) - lead_arrival(passing, bend, s_body, early);
    float last = floor(since.x);
    ++waves;
#else
    vec3 arrived = swash_arrived(xy, early);
#endif
    m.arrived = arrived.x;
    vec3 sea = d_mul(bed.sea, bed.within);
    vec3 masks = vec3(0.0);
    float nearest = 9.0;
    vec3 along = shore_height_along(s_body);
#ifdef TRAVEL_TIME
    along += (passing.lead_height - along) * u_arrival_share;
#endif
#ifdef PLUNGE
#ifdef TRAVEL_TIME
    m.breaker = breaker_at(xy, s_body, lead_bent(passing, s_body), s_cycles(), u_shore_range_m, u_shore_width);
#else
    if ((s_body.x - BREAK_S) * u_shore_break_rate > u_shore_feels_from)
        m.breaker = breaker_at(xy, s_body, vec3(0.0), s_cycles(), u_shore_range_m, u_shore_width);
#endif
    bool feels = m.breaker.here.x > u_shore_feels_from;
    vec3 ashore = feels ? d_const(1.0) - d_step(ASHORE_S.x, ASHORE_S.y, s_body) : vec3(0.0), ahead_m = vec3(0.0);
#endif
    for (int k = 0; k < waves; ++k) {
#ifdef TRAVEL_TIME
        vec3 u_body = (d_const(last + 1.0 - float(k)) - since) / s_cycles(), f = s_body - u_body;
        float u = u_body.x;
        int wave = u_shore_cycle * u_shore_count + int(last) + 1 - k;
#else
        vec3 c = (early + d_const(float(k))) / float(u_shore_count) + d_const(u_shore_clock);
        float cycle = floor(c.x);
        vec3 f = (c - d_const(cycle)) * (1.0 + u_shore_runup), u_body = s_body - f;
        float u = u_body.x;
        int wave = (u_shore_cycle + int(cycle)) * u_shore_count - k;
#endif
        vec3 tall = d_const(1.0) - wave_noise(xy, wave) * u_shore_variety;
        float a, b;
        vec3 here;
        shore_wave(u, shore_fade(f.x), a, b, here);
        masks = max(masks, here);
        float away = abs(u);
#ifdef PLUNGE
        vec3 q = m.breaker.here - u_body * u_shore_break_rate;
        if (away < nearest) m.progress = q.x;
#endif
        if (away < nearest) {
            nearest = away;
            m.a = a;
            m.b = b;
            m.front = s - u;
        }
        vec3 body = shore_body(u_body, f);
#ifdef PLUNGE
        if (feels && may_break(u_body.x, q.x, u_shore_width, u_shore_gap + max(u_shore_back, u_shore_width), u_shore_fall)) {
            vec3 sooner = raggedness(xy, looped_wave(wave)), high = d_mul(tall, along);
            q += sooner;
            if (away <= nearest) m.progress = q.x;
            Carried moved = carried(u_body, q, m.breaker, high, sooner, u_shore_height_m, u_shore_width, u_shore_gap, u_shore_back);
            ahead_m += moved.ahead_m;
            m.splash = max(m.splash, moved.splash.x);
            m.white = max(m.white, white_water(q.x, m.breaker) * max(max(here.x, here.y), here.z));
            vec3 stands = moved.stands + d_mul(d_const(1.0) - moved.stands, d_const(1.0) - ashore);
            body = d_mul(body, stands) + d_mul(moved.splash, ashore);
        }
#endif
        m.lift += d_mul(body, tall);
    }
    vec3 drop = bed.depth - bed.clock;  // how far the bed lies below the rim that its waves came over
    float calm = 1.0 - 0.8 * smoothstep(POOL_M, 5.0 * POOL_M, drop.x) * smoothstep(POOL_S.x, POOL_S.y, s_body.x);
    masks *= calm * sea.x * u_shore_on;
    m.line = masks.x;
    m.back = masks.y;
    m.fall = masks.z;
    m.a *= u_shore_on;
    m.b *= u_shore_on;
    m.lift = d_mul(m.lift, along) * u_shore_height_m;
    vec3 run = d_mul(shore_swash(xy, arrived), slope_reach(xy));
    vec3 rise = run * (u_shore_range_m * u_shore_runup);
    // Behind a rim the swash rises only while it tops the rim; on an open beach drop is 0 and this is 1.
    vec3 over = rise + bed.clock + (d_const(1.0) - d_step(0.0, POOL_M, drop)) * POOL_M;
    vec3 level = d_mul(d_mul(rise, d_step(SWASH_S, 1.0, s_body)), d_step(0.0, POOL_M, over));
    float moving = u_shore_on * u_shore_vertex;
    m.lift = d_mul(m.lift + level, sea) * moving;
#ifdef PLUNGE
    ahead_m = d_mul(d_mul(ahead_m, ashore), sea) * moving;
    m.shift_x = d_mul(m.breaker.east, ahead_m);
    m.shift_y = d_mul(m.breaker.north, ahead_m);
    m.white *= calm * sea.x * u_shore_on;
#endif
    m.edge_s = 1.0 + u_shore_runup * run.x * moving;
    return m;
}
