// The weather map as it was made for the frame: coverage, precipitation, gradient coordinate, weight of the paint (Z04).

uniform sampler2D u_weather;

vec4 weather_map(vec2 xy) {
    return textureLod(u_weather, xy / 70000.0 + 0.5, 0.0);
}
