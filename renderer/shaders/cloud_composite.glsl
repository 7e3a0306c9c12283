// The image of the clouds over the picture, where nothing stands before them.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
uniform sampler2D u_clouds;
uniform sampler2D u_clouds_depth;
uniform sampler2D g_eye_depth;
const float SMOOTH = 0.65;
out vec4 out_radiance;  // blended: light + transmittance × what is there

// Catmull-Rom from five bilinear fetches (Jimenez 2016), held to what light can be.
vec4 clouds_at(vec2 uv) {
    vec2 size = vec2(textureSize(u_clouds, 0));
    vec2 at = uv * size, low = floor(at - 0.5) + 0.5, f = at - low;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w3 = f * f * (-0.5 + 0.5 * f), w2 = 1.0 - w0 - w1 - w3, w12 = w1 + w2;
    vec2 before = (low - 1.0) / size, middle = (low + w2 / w12) / size, after = (low + 2.0) / size;
    vec4 sum = textureLod(u_clouds, middle, 0.0) * (w12.x * w12.y);
    float total = w12.x * w12.y;
    sum += textureLod(u_clouds, vec2(before.x, middle.y), 0.0) * (w0.x * w12.y);
    sum += textureLod(u_clouds, vec2(after.x, middle.y), 0.0) * (w3.x * w12.y);
    sum += textureLod(u_clouds, vec2(middle.x, before.y), 0.0) * (w12.x * w0.y);
    sum += textureLod(u_clouds, vec2(middle.x, after.y), 0.0) * (w12.x * w3.y);
    total += (w0.x + w3.x) * w12.y + (w0.y + w3.y) * w12.x;
    // where it overshoots, light goes with what it hides: white under white light stays white
    float through = sum.a / total;
    return vec4(max(sum.rgb / total, 0.0) / max(1.0 - through, 1.0), clamp(through, 0.0, 1.0));
}

// Four fetches that weigh about three by three texels alike: over those the start of the march takes all its values, so
// that its pattern is gone; half of it, for outlines stay sharper than that.
vec4 clouds_smooth(vec2 uv) {
    vec2 off = 0.8 / vec2(textureSize(u_clouds, 0));
    vec4 sum = textureLod(u_clouds, uv + off, 0.0) + textureLod(u_clouds, uv - off, 0.0);
    sum += textureLod(u_clouds, uv + vec2(off.x, -off.y), 0.0) + textureLod(u_clouds, uv + vec2(-off.x, off.y), 0.0);
    return 0.25 * sum;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 uv = gl_FragCoord.xy / u_size;
    float away = texelFetch(g_eye_depth, pixel, 0).r * length(pixel_ray());
    if (away > 0.0 && away < textureLod(u_clouds_depth, uv, 0.0).r) discard;
    out_radiance = mix(clouds_at(uv), clouds_smooth(uv), SMOOTH);
}
#endif
