// The weather map at a place, worked out there: the editor keeps it in a texture of 137 m a texel. clouds.glsl declares u_cloud_camera.
#include "level/weather.glsl"

vec4 weather_map(vec2 xy) {
    xy -= WEATHER_TILE_M * floor((xy - u_cloud_camera) / WEATHER_TILE_M + 0.5);
    return weather_of(xy, u_cloud_camera, STAGE_FINAL);
}
