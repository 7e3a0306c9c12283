// The last step: exposure, tone curve, sRGB, dither; for views, numbers to colours.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/ramp.glsl"
uniform sampler2D picture;
out vec4 out_display;

void main() {
    vec3 value = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    out_display = vec4(clamp(shown(value), 0.0, 1.0), 1.0);
}
#endif
