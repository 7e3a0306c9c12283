// The two plates of what lies under the water, halves of one atlas: A sharp, B blurred (H12). Colours are premultiplied
// by their weight in alpha: what stands out of the water weighs next to nothing, so that it never bleeds into it.
uniform sampler2D u_plates;

vec4 plate_texel(vec2 texel, float half_of) {
    vec2 size = vec2(textureSize(u_plates, 0)) * vec2(0.5, 1.0);
    vec2 kept = clamp(texel, vec2(0.5), size - 0.5);  // half a texel away from the seam
    return textureLod(u_plates, (kept + vec2(half_of * size.x, 0.0)) / (size * vec2(2.0, 1.0)), 0.0);
}

// Radiance at a place in pixels of the picture; `half_of` is 0 for A and 1 for B.
vec3 plate(vec2 pixel, float half_of) {
    vec4 v = plate_texel(0.5 * pixel, half_of);
    return v.rgb / max(v.a, 1e-4);
}
