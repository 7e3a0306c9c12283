// Gerstner waves by frequency groups (H05, H06, H29). The twin is level/gerstner.py.
#include "level/noise_lattice.glsl"

const int FRONTS = 8;           // the high group's five, then the low group's three
const int HIGH_FRONTS = 5;
const float TURN = 6.28318530718;

uniform vec4 u_front_way[FRONTS];   // direction / wavelength (cycles per metre: x, y), phase in cycles, k in rad/m
uniform vec4 u_front_size[FRONTS];  // amplitude_m, lateral_m, unit direction (x, y)
uniform float u_front_turn[FRONTS];  // how far the broad noise moves its crests, in wavelengths (H07)
uniform float u_phase_noise_m;

// What a drawing shader leaves of the high group where its cells or pixels are too coarse for it; 1 is the true sea.
float chop_share = 1.0;
// And how it breaks the rows of the low group, which from afar stand in one lattice: a gain and a phase by front.
vec3 swell_gain = vec3(1.0), swell_turn = vec3(0.0);

struct Deformed { vec3 x; vec3 y; vec3 z; };  // duals: world x, world y, height over the still sea

// A broad noise about 0 that moves the crests; a dual of the undeformed xy (H07).
vec3 phase_noise(vec2 before) { return value_noise(before, u_phase_noise_m, ivec2(23, 5)) - vec3(0.5, 0.0, 0.0); }

Deformed gerstner_group(Deformed point, int first, int end, vec3 weight, vec3 noise) {
    vec3 dx = vec3(0.0), dy = vec3(0.0), dz = vec3(0.0);
    for (int i = first; i < end; ++i) {
        vec4 way = u_front_way[i], size = u_front_size[i];
        if (first == HIGH_FRONTS) {
            way.z += swell_turn[i - first];
            size.xy *= swell_gain[i - first];
        }
        // Phases are kept in cycles and wrapped, so that float32 is as good at 7 days as at 0.
        float theta = TURN * fract(dot(way.xy, vec2(point.x.x, point.y.x)) - way.z + u_front_turn[i] * noise.x);
        float s = sin(theta), c = cos(theta);
        vec2 slope = way.w * (size.z * point.x.yz + size.w * point.y.yz) + TURN * u_front_turn[i] * noise.yz;
        vec3 lateral = size.y * vec3(c, -s * slope);
        dx += lateral * size.z;
        dy += lateral * size.w;
        dz += size.x * vec3(s, c * slope);
    }
    return Deformed(point.x + d_mul(dx, weight), point.y + d_mul(dy, weight), point.z + d_mul(dz, weight));
}

Deformed gerstner(vec2 before, vec3 weight) {
    Deformed point = Deformed(vec3(before.x, 1.0, 0.0), vec3(before.y, 0.0, 1.0), vec3(0.0));
    vec3 noise = phase_noise(before);
    point = gerstner_group(point, 0, HIGH_FRONTS, weight * chop_share, noise);
    return gerstner_group(point, HIGH_FRONTS, FRONTS, weight, noise);
}
