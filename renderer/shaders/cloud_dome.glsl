// The clouds in all directions over the sea, as its surface mirrors them.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/fog.glsl"
#include "lib/cloud_march.glsl"
#include "lib/cloud_dome.glsl"
uniform float u_dome_side;
out vec4 out_light;  // premultiplied radiance, transmittance

void main() {
    vec3 dir = dome_direction(gl_FragCoord.xy / u_dome_side);
    March m = cloud_march(dir, 0.5);
    float alpha = 1.0 - m.transmittance;
    if (alpha > 0.0) m.light = fog(m.light / alpha, dir, u_eye_m, altitude_of(dir * m.depth_m), m.depth_m) * alpha;
    out_light = vec4(min(m.light, vec3(60000.0)), m.transmittance);
}
#endif
