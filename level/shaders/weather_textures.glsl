// What the weather map is made of: noise, paint, skies of shots. All tile over WEATHER_TILE_M.

uniform sampler2D u_weather_noise;       // a broad pattern and its quarter turn, a fine one and its own; Gaussian
uniform sampler2D u_layer_weather;       // painted coverage, precipitation, type; weight of the coverage
uniform sampler2D u_layer_weather_more;  // weights of precipitation and type
const int MOST_SHOTS = 16;
uniform sampler2DArray u_weather_shot_skies;  // skies of shots, the lower first
uniform int u_weather_shots;
uniform vec4 u_weather_shot[MOST_SHOTS];      // metres moved, share
uniform vec2 u_weather_over_shots;       // how much of the paint and of the horizon's sky shows over them

const float WEATHER_TILE_M = 70000.0;

vec4 weather_noise(vec2 tiles) { return textureLod(u_weather_noise, tiles, 0.0); }

// Paint, whose samples stand at the corners of tiles: coverage, precipitation, type, weight of the coverage; the others'.
vec4 weather_painted(vec2 tiles, out vec2 more) {
    vec2 uv = tiles + 0.5 / vec2(textureSize(u_layer_weather, 0));
    more = textureLod(u_layer_weather_more, uv, 0.0).rg;
    return textureLod(u_layer_weather, uv, 0.0);
}

// The skies of shots over what there is, each over those before it.
vec3 weather_with_shots(vec3 sky, vec2 xy) {
    vec2 side = vec2(textureSize(u_weather_shot_skies, 0).xy);
    for (int i = 0; i < u_weather_shots; ++i) {
        vec2 uv = (xy - u_weather_shot[i].xy) / WEATHER_TILE_M + 0.5 + 0.5 / side;
        sky = mix(sky, textureLod(u_weather_shot_skies, vec3(uv, float(i)), 0.0).rgb, u_weather_shot[i].z);
    }
    return sky;
}
