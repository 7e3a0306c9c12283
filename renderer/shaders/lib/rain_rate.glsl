// What falls at a place: how much and whether as snow (Z18, Z24).

uniform sampler2D u_weather;
uniform float u_weather_rain_mm_h, u_weather_temperature_c, u_weather_snow_below_c;

const float RAIN_TILE_M = 70000.0, LAPSE_C_PER_M = 0.0065;

// Millimetres an hour at world metres.
float rain_rate(vec2 xy) {
    vec2 weather = textureLod(u_weather, xy / RAIN_TILE_M + 0.5, 0.0).rg;
    return weather.y * u_weather_rain_mm_h * smoothstep(0.2, 0.5, weather.x);
}

// Share that falls as snow at a height over the sea.
float snow_share(float height_m) {
    float degrees_c = u_weather_temperature_c - LAPSE_C_PER_M * height_m;
    return 1.0 - smoothstep(u_weather_snow_below_c - 0.5, u_weather_snow_below_c + 1.0, degrees_c);
}
