// When swells arrive (T06): ArrivalMap.packed, read with texelFetch and smoothed by a quadratic B-spline by hand. The twin is
// level/arrival_map.py.
#include "level/dual.glsl"

uniform sampler2D u_arrival;       // RGBA32F, three blocks of rows: times of three swells and of the lead at the shoreline, s;
                                   // height of the lead's shore wave, gains of the swells; how the lead breaks
uniform float u_arrival_cell_m;
uniform vec3 u_arrival_rate;       // one over the periods, 1/s
uniform vec2 u_arrival_plane[3];   // s/m, of the plane waves that come in
uniform float u_arrival_share;     // of travel time in the moment of arrival; the rest is the depth's
uniform int u_arrival_levels;      // 2 under a tide: all of it once more below, of a higher sea
uniform float u_arrival_rise;      // of the way from the lower of the two seas to the higher

const float ARRIVAL_BEYOND_M = 160.0;
const vec2 ARRIVAL_APART = vec2(0.2, 0.6);

// Duals: swells in cycles of their periods, the lead at the shoreline near by; heights against those offshore, that of the
// lead's shore wave against where it stands highest.
struct Passing {
    vec3 swells[3];
    vec3 shore;
    vec3 gains[3];
    vec3 lead_height;
};

vec3 spline_weights(float t) { return vec3(0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)); }

vec3 spline_slopes(float t) { return vec3(t - 0.5, -2.0 * t, t + 0.5); }

ivec2 arrival_size() { return textureSize(u_arrival, 0) / ivec2(1, 3 * u_arrival_levels); }

vec4 arrival_texel(ivec2 texel) {
    vec4 here = texelFetch(u_arrival, texel, 0);
    if (u_arrival_levels > 1) {
        vec4 above = texelFetch(u_arrival, texel + ivec2(0, 3 * arrival_size().y), 0);
        here += (above - here) * u_arrival_rise;
    }
    return here;
}

void arrival_block(ivec2 texel, vec2 t, out vec4 value, out vec4 dx, out vec4 dy) {
    vec3 wx = spline_weights(t.x), wy = spline_weights(t.y);
    vec3 sx = spline_slopes(t.x) / u_arrival_cell_m, sy = spline_slopes(t.y) / u_arrival_cell_m;
    value = dx = dy = vec4(0.0);
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            vec4 here = arrival_texel(texel + ivec2(c - 1, r - 1));
            value += here * (wx[c] * wy[r]);
            dx += here * (sx[c] * wy[r]);
            dy += here * (wx[c] * sy[r]);
        }
    }
}

Passing passing_at(vec2 xy) {
    ivec2 size = arrival_size();
    vec2 at = xy / u_arrival_cell_m, inside = clamp(at, vec2(0.0), vec2(size - 1));
    vec2 texel = clamp(floor(inside + 0.5), vec2(1.0), vec2(size - 2)), out_m = (at - inside) * u_arrival_cell_m;
    vec4 times, times_x, times_y, heights, heights_x, heights_y;
    arrival_block(ivec2(texel), inside - texel, times, times_x, times_y);
    arrival_block(ivec2(texel) + ivec2(0, size.y), inside - texel, heights, heights_x, heights_y);
    times += times_x * out_m.x + times_y * out_m.y;
    float away = length(out_m);
    vec3 beyond = d_step(0.0, ARRIVAL_BEYOND_M, vec3(away, out_m / max(away, 1e-6)));
    Passing p;
    for (int i = 0; i < 3; ++i) {
        float rate = u_arrival_rate[i];
        vec3 cycles = rate * vec3(times[i], times_x[i], times_y[i]);
        vec2 way = rate * u_arrival_plane[i];
        vec3 gap = vec3(dot(way, xy), way) - cycles;
        float lies = 1.0 - 4.0 * beyond.x * (1.0 - beyond.x) * smoothstep(ARRIVAL_APART.x, ARRIVAL_APART.y, abs(gap.x));
        vec3 gain = vec3(heights[i + 1], heights_x[i + 1], heights_y[i + 1]);
        p.swells[i] = cycles + d_mul(gap, beyond);
        p.gains[i] = (gain + d_mul(d_const(1.0) - gain, beyond)) * lies;
    }
    p.shore = u_arrival_rate.x * vec3(times.w, times_x.w, times_y.w);
    p.lead_height = vec3(heights.x, heights_x.x, heights_y.x);
    return p;
}

// Duals: seconds since the lead broke that passes now, below 0 before it does; 0 … 1 how far that shows; surf similarity as
// it breaks; run-up of the shore near by in metres. Beyond the border as on it.
struct Breaks { vec3 since_s, shows, similarity, runup_m; };

Breaks breaks_at(vec2 xy) {
    ivec2 size = arrival_size();
    vec2 at = xy / u_arrival_cell_m, inside = clamp(at, vec2(0.0), vec2(size - 1)), known = vec2(equal(at, inside));
    vec2 texel = clamp(floor(inside + 0.5), vec2(1.0), vec2(size - 2));
    vec4 value, dx, dy;
    arrival_block(ivec2(texel) + ivec2(0, 2 * size.y), inside - texel, value, dx, dy);
    dx *= known.x;
    dy *= known.y;
    return Breaks(vec3(value.x, dx.x, dy.x), vec3(value.y, dx.y, dy.y), vec3(value.z, dx.z, dy.z), vec3(value.w, dx.w, dy.w));
}
