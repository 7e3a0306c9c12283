// How much rain and snow falls at a place, in mm/h of water (Z18, Z24). The twin is level/rain.py.
#include "level/weather_map.glsl"

uniform float u_weather_rain_mm_h, u_weather_temperature_c, u_weather_snow_below_c;

const float LAPSE_C_M = 0.0065, SLEET_C = 1.0, RAINS_WHOLE = 0.7;

// Rain and snow under a sky of the weather map, on ground so high over the sea.
vec2 rain_rate(vec2 coverage_rain, float over_sea_m) {
    float falls = u_weather_rain_mm_h * coverage_rain.y * min(coverage_rain.x / RAINS_WHOLE, 1.0);
    float celsius = u_weather_temperature_c - LAPSE_C_M * max(over_sea_m, 0.0);
    float rain = smoothstep(u_weather_snow_below_c - SLEET_C, u_weather_snow_below_c + SLEET_C, celsius);
    return falls * vec2(rain, 1.0 - rain);
}

// The same at world metres.
vec2 rain_at(vec2 xy, float over_sea_m) {
    return rain_rate(weather_map(xy).xy, over_sea_m);
}
