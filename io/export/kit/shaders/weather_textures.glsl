// What the weather map is made of: noise and paint; both tile over WEATHER_TILE_M. Skies of shots are a picture's own.
#include "kit/texels.glsl"

uniform sampler2D u_weather_noise;       // a broad pattern and its quarter turn, a fine one and its own; Gaussian
uniform sampler2D u_layer_weather;       // painted coverage, precipitation, type; weight of the coverage
uniform sampler2D u_layer_weather_more;  // weights of precipitation and type

const float WEATHER_TILE_M = 70000.0;
const vec2 u_weather_over_shots = vec2(1.0);

vec4 weather_noise(vec2 tiles) { return KIT_tiled(u_weather_noise, tiles); }

// Paint, whose samples stand at the corners of tiles: coverage, precipitation, type, weight of the coverage; the others'.
vec4 weather_painted(vec2 tiles, out vec2 more) {
    vec2 uv = tiles + 0.5 / vec2(textureSize(u_layer_weather, 0));
    more = KIT_tiled(u_layer_weather_more, uv).rg;
    return KIT_tiled(u_layer_weather, uv);
}

vec3 weather_with_shots(vec3 sky, vec2 xy) { return sky; }
