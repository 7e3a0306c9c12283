// A picture drawn with fewer pixels brought to its full size: Catmull-Rom from five bilinear fetches (J. Jimenez,
// "Filmic SMAA", 2016: the corners, of hardly any weight, are left out and the rest is scaled up).
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
uniform sampler2D u_small;
uniform vec2 u_full_size;
out vec4 out_display;

void main() {
    vec2 size = vec2(textureSize(u_small, 0));
    vec2 at = gl_FragCoord.xy / u_full_size * size;
    vec2 low = floor(at - 0.5) + 0.5, f = at - low;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w3 = f * f * (-0.5 + 0.5 * f), w2 = 1.0 - w0 - w1 - w3, w12 = w1 + w2;
    vec2 before = (low - 1.0) / size, middle = (low + w2 / w12) / size, after = (low + 2.0) / size;
    vec4 sum = vec4(textureLod(u_small, middle, 0.0).rgb, 1.0) * (w12.x * w12.y);
    sum += vec4(textureLod(u_small, vec2(before.x, middle.y), 0.0).rgb, 1.0) * (w0.x * w12.y);
    sum += vec4(textureLod(u_small, vec2(after.x, middle.y), 0.0).rgb, 1.0) * (w3.x * w12.y);
    sum += vec4(textureLod(u_small, vec2(middle.x, before.y), 0.0).rgb, 1.0) * (w12.x * w0.y);
    sum += vec4(textureLod(u_small, vec2(middle.x, after.y), 0.0).rgb, 1.0) * (w12.x * w3.y);
    out_display = vec4(clamp(sum.rgb / sum.a, 0.0, 1.0), 1.0);
}
#endif
