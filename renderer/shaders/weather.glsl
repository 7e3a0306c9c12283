// The weather map round the camera, made for the march: a torus of 70 km, each texel the place nearest to the camera.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "level/weather.glsl"
uniform int u_stage;
uniform float u_map_side;
out vec4 out_sky;

void main() {
    vec2 at = (gl_FragCoord.xy / u_map_side - 0.5) * WEATHER_TILE_M;
    at -= WEATHER_TILE_M * round((at - u_camera.xy) / WEATHER_TILE_M);
    out_sky = weather_of(at, u_camera.xy, u_stage);
}
#endif
