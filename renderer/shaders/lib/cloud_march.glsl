// The march through the shell (Z12, Z14): cheap steps until cloud, one back, then full ones.
#include "lib/cloud_light.glsl"

uniform float u_cloud_reach_m;    // beyond it there are no clouds
uniform vec2 u_cloud_steps;       // overhead, at the horizon
uniform bool u_cloud_terms_cheap_steps, u_cloud_terms_cheap_light;

const float CHEAP = 2.0;          // a cheap step is so many full ones
const float FINE = 0.5;           // steps inside a cloud, where light changes quickly, against full ones
const float NEAR_M = 20.0, GROWTH = 0.03;  // within a cloud steps begin with that and grow by this share of the way
const float SLACK = 0.02;         // of the shape's range: cheap steps take what nearly is a cloud for one
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

// `start` 0 … 1: where in the first step it begins.
March cloud_march(vec3 dir, float start) {
    March m = March(vec3(0.0), 1.0, 0.0, 0);
    vec2 span = shell_span(dir);
    if (span.x >= span.y || span.x >= u_cloud_reach_m) return m;
    span.y = min(span.y, u_cloud_reach_m);
    float count = mix(u_cloud_steps.x, u_cloud_steps.y, clamp(1.0 - abs(dir.z) * 2.0, 0.0, 1.0));
    float longest = (span.y - span.x) / count, first = min(longest, max(NEAR_M, GROWTH * span.x));
    float t = span.x + first * FINE * start;
    float cosine = dot(dir, u_sun_direction), phase = cloud_phase(cosine), weight = 0.0;
    bool cheap = u_cloud_terms_cheap_steps;
    int empty = 0;
    for (int i = 0; i < MOST_STEPS && t < span.y; ++i) {
        float full = min(longest, max(NEAR_M, GROWTH * t));
        vec3 p = dir * t;
        float altitude = altitude_of(p), h = shell_height(altitude), lod = cloud_lod(t, full * FINE);
        vec2 sheared = cloud_sheared(p.xy, h);
        vec3 weather = cloud_weather(sheared).xyz;
        float base = cloud_base(sheared, altitude, h, weather, lod, cheap ? SLACK : 0.0);
        if (cheap) {
            if (base > 0.0) {
                cheap = false;
                empty = 0;
                t = max(t - full * (CHEAP - FINE), span.x + first * FINE * start);
            } else t += full * CHEAP;
            continue;
        }
        float extinction = 0.0;
        if (base > 0.0) {
            extinction = cloud_eroded(base, cloud_detail(sheared, altitude, h, lod), h);
            extinction *= 1.0 - smoothstep(0.6, 1.0, t / u_cloud_reach_m);
        }
        if (extinction > 0.0) {
            empty = 0;
            ++m.samples;
            float through = exp(-extinction * full * FINE);
            bool cheap_light = u_cloud_terms_cheap_light && m.transmittance < 1.0 - CHEAP_LIGHT;
            vec3 source = cloud_source(p, altitude, h, weather.y, cosine, phase, lod, cheap_light);
            // energy-conserving: the step's own transmittance integrated, not taken at its start
            float seen = m.transmittance * (1.0 - through);
            m.light += source * seen;
            m.depth_m += t * seen;
            weight += seen;
            m.transmittance *= through;
            if (m.transmittance < OPAQUE) break;
        } else if (u_cloud_terms_cheap_steps && ++empty >= EMPTY) cheap = true;
        t += full * FINE;
    }
    m.depth_m = weight > 0.0 ? m.depth_m / weight : span.x;
    if (m.transmittance < OPAQUE) {
        m.light /= 1.0 - m.transmittance;
        m.transmittance = 0.0;
    }
    return m;
}
