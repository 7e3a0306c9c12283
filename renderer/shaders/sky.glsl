// The sky where nothing was drawn.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/sky.glsl"
#ifdef HIGH_CLOUDS
#include "lib/high_light.glsl"
#endif
uniform sampler2D g_eye_depth;
uniform bool u_show_sky, u_show_clouds;
uniform float u_cirrus;  // 0 where even light stands for a sky
out vec4 out_radiance;

void main() {
    if (texelFetch(g_eye_depth, ivec2(gl_FragCoord.xy), 0).r > 0.0) discard;
    vec3 way = normalize(pixel_ray());
    vec3 sky = sky_seen(way, u_show_clouds ? u_cirrus : 0.0) + sun_disc(way);
    sky += sky_stars(way, u_pixel_angle) * (1.0 - u_light_cloud_cover);
#ifdef HIGH_CLOUDS
    sky = high_layers(sky, way, u_camera.xy, u_camera.z - u_level_sea_level_m, u_pixel_angle);
#endif
    out_radiance = vec4(u_show_sky ? min(sky, 60000.0) : vec3(0.0), 1.0);
}
#endif
