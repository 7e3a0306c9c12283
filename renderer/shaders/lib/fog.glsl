// Air and haze between eye and thing. Air (L02): what the sky's own integral adds up to a distance, so that land, sea and
// sky agree. Haze (D38): a layer that thins with height, lit as fog is lit.
#include "lib/sky.glsl"

uniform sampler2D u_aerial;       // light that the air adds: 32 azimuths wide, 16 elevations for each of 16 distances
uniform vec3 u_air, u_air_haze;   // extinction at sea level, 1/m: of the air, and of the haze that the sky has too
uniform bool u_show_air;
uniform float u_fog_density;      // extinction at sea level, 1/m; 0 is off
uniform float u_fog_height_m;     // over which it thins to 1/e
uniform vec3 u_fog_radiance;      // light inside the fog
uniform float u_fog_share;        // how far it takes the place of the sky's

const float AERIAL_FIRST_M = 100.0, AERIAL_STEP = 0.75;  // log2 of the ratio of two distances; sky_table.py
const float AIR_HEIGHT_M = 8000.0, HAZE_HEIGHT_M = 1200.0;

// Metres of sea-level air between heights a and b, `distance_m` apart, where it thins to 1/e over `scale_m`.
float air_metres(float a, float b, float distance_m, float scale_m) {
    float low = max(a, 0.0) / scale_m, high = max(b, 0.0) / scale_m, h = high - low;
    float mean = abs(h) < 1e-3 ? exp(-low) * (1.0 - 0.5 * h) : (exp(-low) - exp(-high)) / h;
    return mean * distance_m;
}

float fog_depth(float a, float b, float distance_m) {
    return u_fog_density * air_metres(a, b, distance_m, u_fog_height_m);
}

vec3 aerial_slice(vec2 place, float slice) {
    vec2 at = vec2(place.x * 31.0 + 0.5, slice * 16.0 + place.y * 15.0 + 0.5);
    return textureLod(u_aerial, at / vec2(32.0, 256.0), 0.0).rgb;
}

// The horizon that stands for a direction below it: where the sun is as far off. Looking straight down at a low sun one
// sees none of the bright air under it.
vec3 over_horizon(vec3 dir) {
    if (dir.z >= 0.0) return dir;
    float c = clamp(dot(dir, u_sun_direction) / max(length(u_sun_direction.xy), 1e-3), -1.0, 1.0);
    vec2 heading = sun_heading();
    return vec3(c * heading + sqrt(1.0 - c * c) * vec2(-heading.y, heading.x), 1e-4);
}

// Light that the air adds over that many metres of it; past the last distance that of the whole sky.
vec3 aerial_light(vec3 dir, float metres) {
    vec2 place = sky_place(over_horizon(dir));
    float slice = log2(max(metres, 1.0) / AERIAL_FIRST_M) / AERIAL_STEP;
    if (slice <= 0.0) return aerial_slice(place, 0.0) * (metres / AERIAL_FIRST_M);
    slice = min(slice, 15.0);
    float low = min(floor(slice), 14.0);
    return mix(aerial_slice(place, low), aerial_slice(place, low + 1.0), slice - low);
}

// At full depth this is what the sky shows at the horizon, in fog the light inside the fog.
vec3 fog_inscatter(vec3 view_dir) {
    vec3 sky = sky_radiance(over_horizon(view_dir));
    float forward = max(dot(view_dir, u_sun_direction), 0.0);
    vec3 sun_glow = u_sun_mean * (0.5 * pow(forward, 5.0) + 0.8 * pow(forward, 30.0)) * 0.045;
    return mix(sky, u_fog_radiance + sun_glow, u_fog_share);
}

// Radiance seen through air and haze; `eye_height`, `height` over the sea, `view_dir` away from the eye.
vec3 fog(vec3 radiance, vec3 view_dir, float eye_height, float height, float distance_m) {
    vec3 air = u_air * air_metres(eye_height, height, distance_m, AIR_HEIGHT_M);
    air += u_air_haze * air_metres(eye_height, height, distance_m, HAZE_HEIGHT_M);
    float metres = distance_m * air.g / max((u_air.g + u_air_haze.g) * distance_m, 1e-9);
    if (u_show_air) radiance = radiance * exp(-air) + aerial_light(view_dir, metres);
    if (u_fog_density <= 0.0) return radiance;
    float through = exp(-fog_depth(eye_height, height, distance_m));
    return mix(fog_inscatter(view_dir), radiance, through);
}

// The sky seen through the layer of haze.
vec3 fog_over_sky(vec3 radiance, vec3 view_dir, float eye_height) {
    if (u_fog_density <= 0.0) return radiance;
    float depth = u_fog_density * u_fog_height_m * exp(-max(eye_height, 0.0) / u_fog_height_m);
    float through = exp(-depth / max(view_dir.z, 1e-3));
    return mix(fog_inscatter(view_dir), radiance, through);
}
