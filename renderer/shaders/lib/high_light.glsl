// The high layers as they are seen (Z13): thin ice that scatters forward, and small white heaps.
#include "lib/fog.glsl"
#include "level/shell.glsl"
#include "lib/high_clouds.glsl"
uniform float u_clouds_high_m;

// Over a sky: its light behind them and their own.
vec3 high_layers(vec3 sky, vec3 dir, vec2 eye, float eye_height, float pixel_angle) {
    if (eye_height > u_clouds_high_m - 10.0 || dir.z < -0.02) return sky;
    float away = sphere_hits(dir, u_clouds_high_m).y;
    if (away <= 0.0) return sky;
    vec2 at = eye + dir.xy * away;
    float slant = max(abs(altitude_of(dir * (away + 100.0)) - u_clouds_high_m) / 100.0, 0.05);
    float lod = log2(max(away * pixel_angle / sqrt(slant) / (RIPPLES_M / 512.0), 1.0));
    float ice = 1.0 - exp(-cirrus_at(at, max(lod - 1.0, 0.0)) / sqrt(slant));
    float heaps = 1.0 - exp(-alto_at(at, lod) / sqrt(slant));
    float cosine = dot(dir, u_sun_direction), forward = max(cosine, 0.0);
    vec3 above = u_sky_sh[0] * (0.282095 / PI_SKY);
    vec3 ice_light = u_sun_disc * (0.085 + 0.16 * pow(forward, 4.0) + 0.9 * pow(forward, 48.0)) + 0.8 * above;
    vec3 heap_light = u_sun_disc * (0.14 + 0.10 * pow(forward, 6.0) + 0.4 * pow(forward, 60.0)) + above;
    // seen through the air below them
    sky = mix(sky, fog(ice_light, dir, eye_height, u_clouds_high_m, away), min(ice, 0.85));
    return mix(sky, fog(heap_light, dir, eye_height, u_clouds_high_m, away), min(heaps, 0.92));
}
