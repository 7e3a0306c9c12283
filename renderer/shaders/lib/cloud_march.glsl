// The march through the shell (Z12, Z14): cheap steps until cloud, one back, then full ones.
// Software runs what an `if` guards for every pixel, and the inside of a loop only while some pixel of a group of eight is
// in it: so whatever may be skipped stands in a loop of its own, and pixels wait there for each other.
#include "lib/cloud_light.glsl"

uniform float u_cloud_reach_m;    // beyond it there are no clouds
uniform vec2 u_cloud_steps;       // overhead, at the horizon
uniform bool u_cloud_terms_cheap_steps, u_cloud_terms_cheap_light;

const float CHEAP = 2.5;          // a cheap step is so many full ones
const float FINE = 0.5;           // steps inside a cloud, where light changes quickly, against full ones
const float NEAR_M = 20.0, GROWTH = 0.03;  // within a cloud steps begin with that and grow by this share of the way
const float SLACK = 0.02;         // of the shape's range: cheap steps take what nearly is a cloud for one
const int EMPTY = 14;             // after so many full samples without cloud the steps are cheap again
const float FADE = 0.45;          // of the reach from which on clouds fade
const float OPAQUE = 0.004;       // transmittance at which nothing behind counts
const int MOST_STEPS = 512;
const float CHEAP_LIGHT = 0.3;    // opacity from which on light is asked without the detail noise

const float CLEAR_M = 420.0;      // steps in clear air: three texels of the map
const int ALIKE = 6;              // steps in cheap light that have the one before's

struct March {
    vec3 light;         // premultiplied
    float transmittance;
    float shown;        // of what it stops, the part that hasn't faded away in the distance
    float depth_m;      // mean distance of what is seen, of no cloud where the shell begins
    int samples;        // full ones
};

// A ray through the shell: from where to where, how long its steps get, where in a step (0 … 1) its sample lies.
struct Way {
    vec3 dir;
    vec2 span;
    float longest, start;
};

// A place on it.
struct Air {
    vec3 p, weather;
    vec2 sheared;
    float altitude, h, lod;
};

// Mip level at which a texel of the shape is as large as a pixel of the image or half a step.
float cloud_lod(float away, float step_m) {
    float size = max(away * u_pixel_angle * 2.0, 0.5 * step_m);
    return clamp(log2(size / (u_clouds_scale_m / 128.0)), -2.0, 2.5);
}

// Whether the map has no clouds at a distance: in clear air nothing else is asked.
bool cloud_free(vec3 dir, float t) {
    vec3 at = dir * t;
    return cloud_weather(cloud_sheared(at.xy, shell_height(altitude_of(at)))).x <= 0.0 && u_cloud_terms_coverage;
}

float cloud_step(Way way, float t) { return min(way.longest, max(NEAR_M, GROWTH * t)); }

// Without a shell on the way the span is nothing, far away.
Way cloud_way(vec3 dir, float start) {
    vec2 span = shell_span(dir);
    span = span.x >= span.y ? vec2(u_cloud_reach_m) : min(span, vec2(u_cloud_reach_m));
    float count = mix(u_cloud_steps.x, u_cloud_steps.y, clamp(1.0 - abs(dir.z) * 2.0, 0.0, 1.0));
    return Way(dir, span, max((span.y - span.x) / count, 1e-3), start);
}

// The sample of the full step that begins at t.
Air cloud_air(Way way, float t) {
    Air air;
    air.p = way.dir * (t + cloud_step(way, t) * FINE * way.start);
    air.altitude = altitude_of(air.p);
    air.h = shell_height(air.altitude);
    air.lod = cloud_lod(t, cloud_step(way, t) * FINE);
    air.sheared = cloud_sheared(air.p.xy, air.h);
    air.weather = cloud_weather(air.sheared).xyz;
    return air;
}

// By cheap steps to where full ones begin: one back from the first that meets cloud. At the way's end there is none.
// `met_before` when that is here.
float cloud_first(Way way, float t, bool met_before) {
    float back = t;
    bool met = met_before || !u_cloud_terms_cheap_steps;
    for (int i = 0; i < MOST_STEPS; ++i) {
        float jump = 0.0, full = cloud_step(way, t);
        for (int j = 0; j < MOST_STEPS; ++j) {
            if (met || t >= way.span.y || !cloud_free(way.dir, t)) break;
            full = cloud_step(way, t);
            jump = max(full * CHEAP, CLEAR_M);
            t += jump;
        }
        t -= max(jump - full * CHEAP, 0.0);
        for (int j = 0; j < MOST_STEPS; ++j) {
            if (met || t >= way.span.y) break;
            Air air = cloud_air(way, t);
            met = cloud_base(air.sheared, air.altitude, air.h, air.weather, air.lod, SLACK) > 0.0;
            t += met ? cloud_step(way, t) * (FINE - CHEAP) : cloud_step(way, t) * CHEAP;
            if (air.weather.x <= 0.0) break;
        }
        if (met || t >= way.span.y) break;
    }
    return max(t, back);
}

float cloud_extinction_in(Air air, float t) {
    float base = cloud_base(air.sheared, air.altitude, air.h, air.weather, air.lod, 0.0);
    if (base <= 0.0) return 0.0;
    return cloud_eroded(base, cloud_detail(air.sheared, air.altitude, air.h, air.lod), air.h);
}

// A step's own part of the march. Energy-conserving: its transmittance is integrated, not taken at its start.
void cloud_add(vec3 source, float extinction, float t, float step_m, inout March m) {
    float through = exp(-extinction * step_m), seen = m.transmittance * (1.0 - through);
    // dense cloud too ends without a line: even steps of the angle over the horizon, which goes as one over the distance
    float faded = seen * clamp((FADE * u_cloud_reach_m / max(t, 1.0) - FADE) / (1.0 - FADE), 0.0, 1.0);
    m.light += source * faded;
    m.shown += faded;
    m.depth_m += t * seen;
    m.transmittance *= through;
    m.samples += int(extinction > 0.0);
}

// Steps until a transmittance is left: cheap ones until cloud unless one was `met`, full ones there. Their light is
// detailed, or cheap: without detail noise, and some steps have that of the one before.
void cloud_until(float until, Way way, float cosine, float phase, const bool cheap, inout March m, inout float t, inout bool met) {
    for (int k = 0; k < MOST_STEPS; ++k) {
        t = cloud_first(way, t, met || m.transmittance < until);
        int empty = 0, more = int(u_cloud_terms_cheap_steps);
        for (int i = 0; i < MOST_STEPS; ++i) {
            if (t >= way.span.y || m.transmittance < until || empty >= EMPTY) break;
            Air air;
            float extinction;
            for (int j = 0; j < MOST_STEPS; ++j) {
                air = cloud_air(way, t);
                extinction = cloud_extinction_in(air, t);
                if (extinction > 0.0 || empty >= EMPTY || t >= way.span.y) break;
                empty += more;
                t += cloud_step(way, t) * FINE;
            }
            if (extinction <= 0.0 || t >= way.span.y) continue;
            float step_m = min(cloud_step(way, t) * FINE, way.span.y - t);
            vec3 source = cloud_source(air.p, air.altitude, air.h, air.weather.y, cosine, phase, air.lod, cheap);
            cloud_add(source, extinction, t, step_m, m);
            empty = 0;
            t += step_m;
            for (int j = 0; j < (cheap ? ALIKE : 0); ++j) {
                if (t >= way.span.y || m.transmittance < until) break;
                step_m = min(cloud_step(way, t) * FINE, way.span.y - t);
                extinction = cloud_extinction_in(cloud_air(way, t), t);
                cloud_add(source, extinction, t, step_m, m);
                if (extinction <= 0.0) empty += more;
                t += step_m;
            }
        }
        met = empty < EMPTY;
        if (t >= way.span.y || m.transmittance < until) break;
    }
}

// `start` 0 … 1: where in each step it looks; steps themselves leave nothing out and count nothing twice.
March cloud_march(vec3 dir, float start) {
    March m = March(vec3(0.0), 1.0, 0.0, 0.0, 0);
    Way way = cloud_way(dir, start);
    float cosine = dot(dir, u_sun_direction), phase = cloud_phase(cosine), t = way.span.x;
    bool met = false;
    cloud_until(u_cloud_terms_cheap_light ? 1.0 - CHEAP_LIGHT : OPAQUE, way, cosine, phase, false, m, t, met);
    cloud_until(OPAQUE, way, cosine, phase, true, m, t, met);
    m.depth_m = m.transmittance < 1.0 ? m.depth_m / (1.0 - m.transmittance) : way.span.x;
    if (m.transmittance < OPAQUE) {
        m.light /= 1.0 - m.transmittance;
        m.shown /= 1.0 - m.transmittance;
    }
    m.transmittance = max(1.0 - m.shown, 0.0);
    return m;
}
