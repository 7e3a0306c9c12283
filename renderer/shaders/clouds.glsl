// Clouds into an image of half the picture's sides, or into one of every sixteen of its pixels (Z14, Z16). With CHEAP_STEPS
// the empty sky, and into the depth buffer where the rest has to be marched: a test of depth skips whole groups of pixels.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/fog.glsl"
#include "lib/cloud_march.glsl"
uniform vec2 u_cloud_size;    // of the image
uniform vec3 u_cloud_pixel;   // this pixel of every `z` × `z` block is marched
layout(location = 0) out vec4 out_light;  // premultiplied radiance, transmittance
layout(location = 1) out float out_depth; // metres

// Start of the march, different from pixel to pixel and always the same (interleaved gradient noise, Jimenez 2014).
float march_start(vec2 pixel) { return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))); }

void main() {
    vec2 pixel = floor(gl_FragCoord.xy) * u_cloud_pixel.z + u_cloud_pixel.xy + 0.5;
    vec2 clip = pixel / u_cloud_size * 2.0 - 1.0;
    vec3 dir = normalize(u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y);
#ifdef CHEAP_STEPS
    Way way = cloud_way(dir, march_start(pixel));
    out_light = vec4(0.0, 0.0, 0.0, 1.0);
    out_depth = way.span.x;
    gl_FragDepth = cloud_first(way, way.span.x, false) < way.span.y ? 0.0 : 1.0;
#else
    March m = cloud_march(dir, march_start(pixel));
    float alpha = 1.0 - m.transmittance;
    if (alpha > 0.0) {
        vec3 far = fog(m.light / alpha, dir, u_eye_m, altitude_of(dir * m.depth_m), m.depth_m);
        m.light = far * alpha;
    }
    out_light = vec4(min(m.light, vec3(60000.0)), m.transmittance);
    out_depth = m.depth_m;
#endif
}
#endif
