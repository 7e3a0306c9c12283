// The weather map at a place and a time (Z04 to Z06, Z20). The twin is level/weather.py.

#include "level/weather_textures.glsl"

uniform vec4 u_weather_turn;             // cosine and sine of the state of the broad and of the fine pattern
uniform vec2 u_weather_moved;            // metres that the air has moved, and the map's middle
uniform vec2 u_weather_paint_moved;      // the same of the paint
uniform vec4 u_weather_bias;             // coverage, type, precipitation, variety
uniform vec4 u_weather_horizon;          // from and to, m; coverage, type
uniform bool u_weather_painted;
uniform vec4 u_storm;                    // where it goes, how far its front is along that; chance
const int MOST_AREAS = 16;
uniform int u_weather_areas;             // keys that a sky over an area is made of (D36), each over those before it
uniform vec4 u_weather_area[MOST_AREAS];      // place, radius (0: everywhere), share
uniform vec4 u_weather_area_sky[MOST_AREAS];  // coverage, type, precipitation
uniform vec2 u_storm_size;               // depth along the wind, how ragged its front is

const float RAINY = 0.7, RAIN_SOFT = 0.15, WEATHER_FINE = 0.5;
const float STORM_CLOUDS = 0.85, STORM_KIND = 0.9, STORM_LEAD_M = 4500.0, STORM_SOFT_M = 1500.0;
const int STAGE_SIMULATED = 0, STAGE_PAINTED = 1, STAGE_HORIZON = 2, STAGE_FINAL = 3;

// The noise in its present state, evenly spread over 0 … 1.
float weather_even(vec2 xy, vec2 shift) {
    vec4 noise = weather_noise((xy - u_weather_moved) / WEATHER_TILE_M + 0.5 + shift);
    float value = dot(noise, u_weather_turn * vec4(1.0, 1.0, WEATHER_FINE, WEATHER_FINE));
    return 1.0 / (1.0 + exp(-1.702 * value / length(vec2(1.0, WEATHER_FINE))));
}

float weather_spread(float mean, float even, float soft) {
    soft = max(min(soft, min(mean, 1.0 - mean)), 1e-3);
    return mean + u_weather_bias.w * (smoothstep(1.0 - mean - soft, 1.0 - mean + soft, even) - mean);
}

// How much of the storm's rain and of its clouds there is (Z23).
vec2 storm_share(vec2 xy) {
    float even = weather_even(xy, vec2(0.171, 0.871));
    float behind = u_storm.z - dot(u_storm.xy, xy) + u_storm_size.y * (2.0 * even - 1.0);
    float soft = min(STORM_SOFT_M, 0.4 * u_storm_size.x);
    vec2 begun = smoothstep(vec2(-soft), vec2(soft), behind + vec2(0.0, STORM_LEAD_M));
    return u_storm.w * begun * (1.0 - smoothstep(u_storm_size.x - soft, u_storm_size.x + soft, behind));
}

// Coverage, precipitation and type by the simulation alone; w is how much of the storm's clouds there is.
vec4 weather_simulated(vec2 xy) {
    vec3 mean = u_weather_bias.xyz;  // coverage, type, precipitation
    vec2 storm = vec2(0.0);
    for (int i = 0; i < u_weather_areas; ++i) {
        vec4 at = u_weather_area[i];
        float here = at.z > 0.0 ? 1.0 - smoothstep(0.5 * at.z, at.z, distance(xy, at.xy)) : 1.0;
        mean = mix(mean, u_weather_area_sky[i].xyz, at.w * here);
    }
    if (u_storm.w > 0.0) {
        storm = storm_share(xy);
        mean = max(mean, vec3(mix(mean.xy, vec2(STORM_CLOUDS, STORM_KIND), storm.y), storm.x));
    }
    float threshold = 1.0 - mean.z * (1.0 + RAIN_SOFT);
    float rain = smoothstep(threshold, threshold + RAIN_SOFT, weather_even(xy, vec2(0.729, 0.237)));
    return vec4(weather_spread(mean.x, weather_even(xy, vec2(0.0)), 0.45), rain,
                weather_spread(mean.y, weather_even(xy, vec2(0.371, 0.613)), 0.3), storm.y);
}

// Coverage, precipitation and gradient coordinate of coverage, precipitation and type (Z04).
vec3 weather_pulled(vec3 sky) {
    return vec3(mix(sky.x, max(sky.x, RAINY), sky.y), sky.y, mix(0.5 * sky.z, 1.0, sky.y));
}

// The map up to a stage at world metres, `camera` in world metres too; w is the weight of the paint.
vec4 weather_of(vec2 xy, vec2 camera, int stage) {
    vec4 simulated = weather_simulated(xy);
    vec3 sky = weather_with_shots(simulated.xyz, xy), weight = vec3(0.0);
    if (stage > STAGE_SIMULATED && u_weather_painted) {
        vec2 more;
        vec4 painted = weather_painted((xy - u_weather_paint_moved) / WEATHER_TILE_M + 0.5, more);
        weight = vec3(painted.w, more) * u_weather_over_shots.x;
        sky = mix(sky, painted.rgb, weight);
    }
    if (stage > STAGE_PAINTED) {
        float away = distance(xy, camera), seen = simulated.w * (1.0 - smoothstep(26000.0, 34000.0, away));
        float share = smoothstep(u_weather_horizon.x, u_weather_horizon.y, away) * (1.0 - seen);
        sky = mix(sky, vec3(u_weather_horizon.z, 0.0, u_weather_horizon.w), share * u_weather_over_shots.y * (1.0 - weight));
    }
    if (stage > STAGE_HORIZON) sky = weather_pulled(sky);
    return vec4(sky, max(weight.x, max(weight.y, weight.z)));
}
