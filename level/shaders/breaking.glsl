// How a shore wave breaks (D34, H23): points of its body are carried ahead and let down. The twin is level/breaking.py.
#include "level/dual.glsl"
#include "level/bed.glsl"
#include "level/gerstner.glsl"
#include "level/noise_lattice.glsl"

const float BREAK_S = 0.78;  // where along the range a front stands highest and its lip leaves it; from there it falls

#ifdef PLUNGE
uniform float u_shore_plunge, u_shore_lip_m;
uniform float u_shore_break_rate;  // progress that a front makes in one range
uniform float u_shore_iribarren;   // ξ on a bed of slope 1
uniform float u_shore_ragged;      // how differently soon a crest breaks along its length
uniform float u_shore_feels_from;  // progress of a crest that passes from which on something shows of waves that break
uniform float u_shore_breaking_s;

const float STEEPENED = 0.62, SPILLED = 0.5, FACE_MOST_M = 5.0;
const vec2 SPILLS = vec2(0.3, 0.5), SURGES = vec2(1.7, 2.4);  // ξ between the types
const vec2 FLAT_SLOPE = vec2(0.004, 0.015), ASHORE_S = vec2(0.9, 1.0);
const vec2 LIP_OF_M = vec2(0.25, 0.7);  // heights between which a crest throws a lip
const vec2 RAGGED_M = vec2(13.0, 3.1);  // lengths along the crest over which it breaks sooner and later
const float STEEPENS = -2.5;  // progress from which on the landward face steepens

// Duals: the unit way that waves go, width of a front's face in metres, how far it falls over, how far it leans at all;
// progress of a crest that passes here, and how far it shows.
struct Breaker { vec3 east, north, face_m, plunging, leaning, here, shows; };

const Breaker NO_BREAKER = Breaker(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(-99.0, 0.0, 0.0), vec3(0.0));

// Duals: metres ahead, height as a share of the body's own, splash on top.
struct Carried { vec3 ahead_m, stands, splash; };

// Gradient of a channel of a map by a quadratic B-spline: east and north, duals.
// Rows of the map are from `row` on.
void second_order(sampler2D map, int channel, ivec2 size, int row, float cell_m, vec2 xy, out vec3 east, out vec3 north) {
    vec2 at = xy / cell_m, inside = clamp(at, vec2(0.0), vec2(size - 1));
    vec2 texel = clamp(floor(inside + 0.5), vec2(1.0), vec2(size - 2)), t = inside - texel;
    vec3 wx = spline_weights(t.x), wy = spline_weights(t.y), sx = spline_slopes(t.x), sy = spline_slopes(t.y);
    vec3 bend = vec3(1.0, -2.0, 1.0), second = vec3(0.0);
    vec2 first = vec2(0.0), known = vec2(equal(at, inside));
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            float here = texelFetch(map, ivec2(texel) + ivec2(c - 1, r - 1 + row), 0)[channel];
            first += here * vec2(sx[c] * wy[r], wx[c] * sy[r]);
            second += here * vec3(bend[c] * wy[r], sx[c] * sy[r], wx[c] * bend[r]);
        }
    }
    first *= known / cell_m;
    second *= vec3(known.x, known.x * known.y, known.y) / (cell_m * cell_m);
    east = vec3(first.x, second.xy);
    north = vec3(first.y, second.yz);
}

vec3 d_length(vec3 east, vec3 north) {
    float size = length(vec2(east.x, north.x));
    return vec3(size, (east.x * east.yz + north.x * north.yz) / max(size, 1e-9));
}

vec3 d_inverse(vec3 x, float least) {
    float over = 1.0 / max(x.x, least);
    return vec3(over, (x.x > least ? -over * over : 0.0) * x.yz);
}

// `s_body`: place along the range; `bent`: by how many cycles the shoreline bends times of arrival.
Breaker breaker_at(vec2 xy, vec3 s_body, vec3 bent, float cycles_a_range, float range_m, float width) {
    vec3 bed_east, bed_north, one = d_const(1.0), shows = one, here = (s_body - d_const(BREAK_S)) * u_shore_break_rate;
    second_order(u_bed, 3, bed_size(), 0, u_bed_cell_m, xy, bed_east, bed_north);
    vec3 east = bed_east * (-cycles_a_range / range_m), north = bed_north * (-cycles_a_range / range_m);
    vec3 slope = d_length(bed_east, bed_north), xi = slope * u_shore_iribarren;
    vec3 known = d_step(FLAT_SLOPE.x, FLAT_SLOPE.y, slope);
#ifdef TRAVEL_TIME
    Breaks breaks = breaks_at(xy);
    vec3 swell_east, swell_north;
    ivec2 size = arrival_size();
    second_order(u_arrival, 0, size, 0, u_arrival_cell_m, xy, swell_east, swell_north);
    if (u_arrival_levels > 1) {
        vec3 above_east, above_north;
        second_order(u_arrival, 0, size, 3 * size.y, u_arrival_cell_m, xy, above_east, above_north);
        swell_east += (above_east - swell_east) * u_arrival_rise;
        swell_north += (above_north - swell_north) * u_arrival_rise;
    }
    east += (swell_east * u_arrival_rate.x - east) * u_arrival_share;
    north += (swell_north * u_arrival_rate.x - north) * u_arrival_share;
    xi += (breaks.similarity - xi) * u_arrival_share;
    known += (one - known) * u_arrival_share;
    shows += (breaks.shows - shows) * u_arrival_share;
    vec3 since = (breaks.since_s + bent / u_arrival_rate.x) / u_shore_breaking_s;
    here += (since - here) * u_arrival_share;
#endif
    vec3 fast = d_length(east, north), over = d_inverse(fast, 1e-6);
    vec3 calm = d_mul(d_mul(one - d_step(SURGES.x, SURGES.y, xi), known), shows);
    vec3 face = d_inverse(fast / (cycles_a_range * width), 1.0 / FACE_MOST_M);
    vec3 plunging = d_step(SPILLS.x, SPILLS.y, xi), leaning = d_mul(plunging * (1.0 - SPILLED) + d_const(SPILLED), calm);
    return Breaker(d_mul(east, over), d_mul(north, over), face, d_mul(plunging, calm), leaning, here, shows);
}

// False where breaking changes nothing of a wave: too early, or not on it.
bool may_break(float u, float q, float w, float tail, float fall) {
    return q > STEEPENS - u_shore_ragged && u > -tail && u < max(2.4 * w, 0.5 * w + fall);
}

// How much sooner the wave of this number breaks at a place, in times of its fall.
vec3 raggedness(vec2 xy, int wave) {
    ivec2 at = ivec2(wave * 13, wave * 31);
    vec3 long_one = value_noise(xy, RAGGED_M.x, at) - d_const(0.5), short_one = value_noise(xy, RAGGED_M.y, at) - d_const(0.5);
    return (long_one + short_one * 0.5) * u_shore_ragged;
}

// What breaking does to a point of the body of one wave; `high`: its height there against the highest.
Carried carried(vec3 u, vec3 q, Breaker breaker, vec3 high, vec3 sooner, float height_m, float w, float gap, float back_s) {
    vec3 one = d_const(1.0);
    vec3 body = d_mul(d_step(-gap - 0.4 * back_s, -0.5 * w, u), one - d_step(-0.5 * w, 0.5 * w, u));
    vec3 onto_lip = d_step(-gap - 0.5 * w, -0.5 * w, u), underside = one - d_step(-0.3 * w, 0.45 * w, u);
    vec3 lip = d_mul(onto_lip, one - d_step(-0.5 * w, 0.15 * w, u));
    vec3 spent = one - d_step(1.0, 2.6, q);
    vec3 steep = d_mul(d_step(STEEPENS, 0.0, q), d_const(0.45) + 0.55 * spent);
    vec3 plunging = d_mul(breaker.plunging, d_step(LIP_OF_M.x, LIP_OF_M.y, high * height_m));
    vec3 thrown = d_mul(d_mul(d_step(-0.5, 1.1, q), spent), plunging);
    vec3 falls = d_step(-0.2, 1.1, q);
    falls = d_mul(d_mul(d_mul(falls, falls), spent), plunging);
    vec3 lean = d_mul(d_mul(breaker.face_m, body), d_mul(steep, breaker.leaning)) * STEEPENED;
    vec3 ahead = (lean + d_mul(d_mul(lip, thrown), high) * u_shore_lip_m) * u_shore_plunge;
    vec3 stands = one - d_mul(d_mul(d_mul(onto_lip, onto_lip), underside), falls) * min(u_shore_plunge, 1.0);
    vec3 up = d_mul(d_mul(d_step(0.8, 1.3, q), one - d_step(1.3, 2.6, q)), plunging) * (0.5 * u_shore_plunge);
    up = d_mul(up, one + sooner);
    vec3 splash = d_mul(d_mul(d_step(0.3 * w, 1.1 * w, u), one - d_step(1.1 * w, 2.4 * w, u)), up);
    return Carried(ahead, stands, splash);
}

// How white a wave is: from when its lip falls, or slowly where foam only rolls down its face; less as it is spent.
float white_water(float q, Breaker breaker) {
    float falling = smoothstep(-0.3, 0.9, q), rolling = smoothstep(-1.2, 1.2, q);
    return mix(rolling, falling, breaker.plunging.x) * breaker.shows.x * (1.0 - 0.35 * smoothstep(3.0, 6.0, q));
}
#endif
