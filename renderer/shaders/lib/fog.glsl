// Haze over distance (D38): density falls off with height, light scattered in is the sky's behind it, warm near the sun.
#include "lib/sky.glsl"

uniform float u_fog_density;   // extinction at sea level, 1/m; 0 is off
uniform float u_fog_height_m;  // over which it thins to 1/e

// Optical depth of the haze between heights a and b over the sea, `distance_m` apart.
float fog_depth(float a, float b, float distance_m) {
    float h = (b - a) / u_fog_height_m;
    float start = exp(-max(a, 0.0) / u_fog_height_m);
    float mean = abs(h) < 1e-3 ? 1.0 - 0.5 * h : (1.0 - exp(-max(h, -60.0))) / h;
    return u_fog_density * start * mean * distance_m;
}

// Share of light that comes through, by colour: air and haze of a clear day together, so near haze is blue.
vec3 fog_transmittance(float optical_depth) { return exp(-optical_depth * vec3(0.73, 1.0, 1.49)); }

// At full depth this is what the sky shows at the horizon, so sea and sky meet without a seam.
vec3 fog_inscatter(vec3 view_dir) {
    return sky_radiance(normalize(vec3(view_dir.xy, max(view_dir.z, 0.0) + 1e-4)));
}

// Radiance seen through the haze; `eye_height`, `height` over the sea, `view_dir` away from the eye.
vec3 fog(vec3 radiance, vec3 view_dir, float eye_height, float height, float distance_m) {
    if (u_fog_density <= 0.0) return radiance;
    vec3 through = fog_transmittance(fog_depth(eye_height, height, distance_m));
    return radiance * through + fog_inscatter(view_dir) * (1.0 - through);
}
