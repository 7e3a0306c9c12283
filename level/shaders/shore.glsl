// The shore wave clock (D03, D04, D10). The twin is level/shore_waves.py: same names, same order.
#include "level/dual.glsl"
#include "level/noise_lattice.glsl"
#include "level/bed.glsl"

uniform float u_shore_clock;    // fract(t / travel), in cycles
uniform int u_shore_cycle;
uniform int u_shore_count;
uniform float u_shore_range_m, u_shore_width, u_shore_gap, u_shore_runup, u_shore_back, u_shore_fall;
uniform float u_shore_height_m, u_shore_draw_m, u_shore_fade_in, u_shore_fade_out;
uniform float u_shore_variety, u_shore_variety_m, u_shore_stagger, u_shore_uprush;
uniform float u_shore_on, u_shore_vertex;

const float BREAK_S = 0.78;
const float SWASH_S = 0.55;

struct ShoreMasks {
    float a, b, line, back, fall;
    vec3 lift;    // dual: height over the still sea
    float edge_s; // the water's edge, in s
    float s;
    float front;  // s of the nearest front
};

struct Wave { float a, b; vec3 line, back, fall, trail; };

// u = s - f is 0 on the front, below 0 behind it.
Wave shore_wave(vec3 u, vec3 f) {
    float w = u_shore_width, gap = u_shore_gap, back_s = u_shore_back;
    float limit = 1.0 + u_shore_runup;
    vec3 fade = d_mul(d_step(0.0, u_shore_fade_in, f), d_const(1.0) - d_step(limit - u_shore_fade_out, limit, f));
    vec3 b = d_step(-w / 2.0, w / 2.0, u);
    vec3 a = d_step(-gap - w / 2.0, -gap + w / 2.0, u);
    vec3 c = d_step(-gap - back_s, -gap, u);
    vec3 trail = d_positive(d_step(-gap - 2.0 * back_s, -gap - back_s, u) - c);
    vec3 fall = d_positive(d_step(-w / 2.0 - u_shore_fall / 2.0, 0.0, u) - d_step(0.0, w / 2.0 + u_shore_fall, u));
    return Wave(a.x, b.x, d_mul(d_positive(a - b), fade), d_mul(d_positive(c - a), fade), d_mul(fall, fade),
                d_mul(trail, fade));
}

vec3 shore_height_along(vec3 s) {
    return d_mul(d_step(0.0, BREAK_S, s) * 0.7 + d_const(0.3), d_const(1.0) - d_step(BREAK_S, 1.0, s));
}

// How far the swash has run, 0 at the still water line, 1 at the run-up limit.
vec3 shore_swash(vec3 early) {
    float arrived = u_shore_clock * float(u_shore_count) + early.x - float(u_shore_count) / (1.0 + u_shore_runup);
    vec3 q = vec3(fract(arrived), early.yz);
    return q.x < u_shore_uprush ? q / u_shore_uprush : d_const(1.0) - d_step(u_shore_uprush, 1.0, q);
}

ShoreMasks shore_masks(Bed bed, vec2 xy) {
    vec3 s = d_const(1.0) - bed.clock / u_shore_range_m;
    vec3 early = (value_noise(xy, 3.0 * u_shore_variety_m, ivec2(11, 37)) - d_const(0.5)) * (2.0 * u_shore_stagger);
    ShoreMasks m = ShoreMasks(0.0, 0.0, 0.0, 0.0, 0.0, vec3(0.0), 1.0, s.x, 9.0);
    vec3 sea = d_mul(bed.sea, bed.within);
    float nearest = 9.0;
    for (int k = 0; k < u_shore_count; ++k) {
        vec3 c = (early + d_const(float(k))) / float(u_shore_count) + d_const(u_shore_clock);
        float cycle = floor(c.x);
        vec3 f = (c - d_const(cycle)) * (1.0 + u_shore_runup);
        int wave = (u_shore_cycle + int(cycle)) * u_shore_count - k;
        Wave here = shore_wave(s - f, f);
        vec3 noise = value_noise(xy, u_shore_variety_m, ivec2(wave * 17, wave * 29));
        vec3 tall = d_const(1.0) - noise * u_shore_variety;
        float away = abs(s.x - f.x);
        if (away < nearest) {
            nearest = away;
            m.a = here.a;
            m.b = here.b;
            m.front = f.x;
        }
        m.line = max(m.line, here.line.x * sea.x);
        m.back = max(m.back, here.back.x * sea.x);
        m.fall = max(m.fall, here.fall.x * sea.x);
        vec3 shape = here.line + here.back - here.trail * (u_shore_draw_m / max(u_shore_height_m, 1e-6));
        m.lift += d_mul(shape, tall);
    }
    m.lift = d_mul(m.lift, shore_height_along(s)) * u_shore_height_m;
    vec3 run = shore_swash(early);
    m.lift = d_mul(m.lift + d_mul(run * (u_shore_range_m * u_shore_runup), d_step(SWASH_S, 1.0, s)), sea);
    float moving = u_shore_on * u_shore_vertex;
    m.lift *= moving;
    m.edge_s = 1.0 + u_shore_runup * run.x * moving;
    m.a *= u_shore_on;
    m.b *= u_shore_on;
    m.line *= u_shore_on;
    m.back *= u_shore_on;
    m.fall *= u_shore_on;
    return m;
}
