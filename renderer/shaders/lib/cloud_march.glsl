// The march through the shell (Z12, Z14): cheap steps until cloud, one back, then full ones.
#include "lib/cloud_light.glsl"

uniform float u_cloud_reach_m;    // beyond it there are no clouds
uniform vec2 u_cloud_steps;       // overhead, at the horizon
uniform bool u_cloud_terms_cheap_steps, u_cloud_terms_cheap_light;

const float CHEAP = 2.0;          // a cheap step is so many full ones
const float FINE = 0.5;           // steps inside a cloud, where light changes quickly, against full ones
const float NEAR_M = 20.0, GROWTH = 0.03;  // within a cloud steps begin with that and grow by this share of the way
const float SLACK = 0.02;         // of the shape's range: cheap steps take what nearly is a cloud for one
const float CLEAR_M = 420.0;      // steps in clear air: three texels of the map
const int EMPTY = 8;              // after so many full samples without cloud the steps are cheap again
const float OPAQUE = 0.004;       // transmittance at which nothing behind counts
const int MOST_STEPS = 512;
const float CHEAP_LIGHT = 0.3;    // opacity from which on light is asked without the detail noise

struct March {
    vec3 light;         // premultiplied
    float transmittance;
    float depth_m;      // mean distance of what is seen
    int samples;        // full ones
};

// Mip level at which a texel of the shape is as large as a pixel of the image or half a step.
float cloud_lod(float away, float step_m) {
    float size = max(away * u_pixel_angle * 2.0, 0.5 * step_m);
    return clamp(log2(size / (u_clouds_scale_m / 128.0)), -2.0, 2.5);
}

// What a ray asks at a distance.
struct Place {
    vec3 at;
    float altitude, h, lod, base;
    vec2 sheared;
    vec3 weather;
};

Place cloud_place(vec3 dir, float t, float step_m, float slack) {
    Place place;
    place.at = dir * t;
    place.altitude = altitude_of(place.at);
    place.h = shell_height(place.altitude);
    place.lod = cloud_lod(t, step_m * FINE);
    place.sheared = cloud_sheared(place.at.xy, place.h);
    place.weather = cloud_weather(place.sheared).xyz;
    place.base = cloud_base(place.sheared, place.altitude, place.h, place.weather, place.lod, slack);
    return place;
}

// Whether the map has no clouds at a distance: in clear air nothing else is asked.
bool cloud_free(vec3 dir, float t) {
    vec3 at = dir * t;
    return cloud_weather(cloud_sheared(at.xy, shell_height(altitude_of(at)))).x <= 0.0 && u_cloud_terms_coverage;
}

// What the steps of one ray share.
struct Ray {
    vec3 dir;
    vec2 span;
    float longest, begin, cosine, phase;
    int most;  // full steps without cloud before they are cheap again
};

float step_length(Ray ray, float t) { return min(ray.longest, max(NEAR_M, GROWTH * t)); }

// Full steps, as long as there is cloud and more than `until` is seen through it; `cheap` light or dear, as written.
void full_steps(Ray ray, inout March m, inout float t, inout float weight, inout int steps, float until, bool cheap) {
    for (int empty = 0; empty < ray.most && steps < MOST_STEPS && t < ray.span.y && m.transmittance >= until; ++steps) {
        float full = step_length(ray, t), extinction = 0.0;
        Place p = cloud_place(ray.dir, t, full, 0.0);
        if (p.base > 0.0) {
            extinction = cloud_eroded(p.base, cloud_detail(p.sheared, p.altitude, p.h, p.lod), p.h);
            extinction *= 1.0 - smoothstep(0.6, 1.0, t / u_cloud_reach_m);
        }
        if (extinction > 0.0) {
            empty = 0;
            ++m.samples;
            float through = exp(-extinction * full * FINE);
            vec3 source = cloud_source(p.at, p.altitude, p.h, p.weather.y, ray.cosine, ray.phase, p.lod, cheap);
            // energy-conserving: the step's own transmittance integrated, not taken at its start
            float seen = m.transmittance * (1.0 - through);
            m.light += source * seen;
            m.depth_m += t * seen;
            weight += seen;
            m.transmittance *= through;
        } else ++empty;
        t += full * FINE;
    }
}

// `start` 0 … 1: where in the first step it begins. Clear air, cheap steps, full ones with dear and with cheap light are
// loops of their own: software OpenGL runs what stands in a branch for every pixel, a loop only while some pixel is in it.
March cloud_march(vec3 dir, float start) {
    March m = March(vec3(0.0), 1.0, 0.0, 0);
    vec2 span = shell_span(dir);
    if (span.x >= span.y || span.x >= u_cloud_reach_m) return m;
    span.y = min(span.y, u_cloud_reach_m);
    float count = mix(u_cloud_steps.x, u_cloud_steps.y, clamp(1.0 - abs(dir.z) * 2.0, 0.0, 1.0));
    float longest = (span.y - span.x) / count, first = min(longest, max(NEAR_M, GROWTH * span.x));
    float begin = span.x + first * FINE * start, t = begin, weight = 0.0, cosine = dot(dir, u_sun_direction);
    float dear_until = u_cloud_terms_cheap_light ? 1.0 - CHEAP_LIGHT : OPAQUE;
    int most = u_cloud_terms_cheap_steps ? EMPTY : MOST_STEPS, steps = 0;
    Ray ray = Ray(dir, span, longest, begin, cosine, cloud_phase(cosine), most);
    while (steps < MOST_STEPS && t < span.y && m.transmittance >= OPAQUE) {
        while (u_cloud_terms_cheap_steps && t < span.y) {
            float jump = 0.0, full = step_length(ray, t);
            while (t < span.y && cloud_free(dir, t)) {
                jump = max(full * CHEAP, CLEAR_M);
                t += jump;
            }
            t -= max(jump - full * CHEAP, 0.0);
            if (cloud_place(dir, t, full, SLACK).base > 0.0) {
                t = max(t - full * (CHEAP - FINE), begin);
                break;
            }
            t += full * CHEAP;
        }
        if (m.transmittance >= dear_until) full_steps(ray, m, t, weight, steps, dear_until, false);
        if (m.transmittance < dear_until) full_steps(ray, m, t, weight, steps, OPAQUE, true);
    }
    m.depth_m = weight > 0.0 ? m.depth_m / weight : span.x;
    if (m.transmittance < OPAQUE) {
        m.light /= 1.0 - m.transmittance;
        m.transmittance = 0.0;
    }
    return m;
}
