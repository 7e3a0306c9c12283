// How much rain and snow falls at a place, in mm/h of water (Z18, Z24). The twin is level/rain.py.
#include "level/weather_map.glsl"

uniform float u_weather_rain_mm_h, u_weather_temperature_c, u_weather_snow_below_c;

const float LAPSE_C_M = 0.0065, SLEET_C = 1.0, RAINS_WHOLE = 0.7;

// What falls at world metres, as rain or snow.
float falls_at(vec2 xy) {
    vec2 coverage_rain = weather_map(xy).xy;
    return u_weather_rain_mm_h * coverage_rain.y * min(coverage_rain.x / RAINS_WHOLE, 1.0);
}

// How much of it is snow so high over the sea.
float snow_share(float over_sea_m) {
    float celsius = u_weather_temperature_c - LAPSE_C_M * max(over_sea_m, 0.0);
    return 1.0 - smoothstep(u_weather_snow_below_c - SLEET_C, u_weather_snow_below_c + SLEET_C, celsius);
}

// Rain and snow at world metres, on ground so high over the sea.
vec2 rain_at(vec2 xy, float over_sea_m) {
    float snow = snow_share(over_sea_m);
    return falls_at(xy) * vec2(1.0 - snow, snow);
}
