// The ground from the height texture, read with texelFetch: texture units keep too few bits of the fraction.
// Beyond the level the border's height goes on and sinks below the sea, so that no slab is seen.

uniform sampler2D u_height;
uniform float u_cell_m;
uniform float u_still_m;  // the still sea
uniform vec2 u_apron;     // how far the land goes on beyond the border, how deep it sinks on the way, metres

float height_texel(ivec2 cell) {
    ivec2 inside = clamp(cell, ivec2(0), textureSize(u_height, 0) - 1);
    float height = texelFetch(u_height, inside, 0).r;
    ivec2 off = cell - inside;
    if (off != ivec2(0)) {
        float out_m = length(vec2(off)) * u_cell_m;
        height = mix(height, min(height, u_still_m - u_apron.y), smoothstep(0.15 * u_apron.x, u_apron.x, out_m));
    }
    return height;
}

// Height and its gradient: bilinear between samples `stride` cells apart, gradients from central differences.
vec3 ground_sample(vec2 xy, int stride) {
    vec2 at = xy / (u_cell_m * float(stride));
    vec2 base = floor(at);
    vec2 f = at - base;
    ivec2 c = ivec2(base) * stride;
    ivec2 e = ivec2(stride, 0), n = ivec2(0, stride);
    float h00 = height_texel(c), h10 = height_texel(c + e), h01 = height_texel(c + n), h11 = height_texel(c + e + n);
    float w0 = height_texel(c - e), w1 = height_texel(c - e + n);
    float e0 = height_texel(c + 2 * e), e1 = height_texel(c + 2 * e + n);
    float s0 = height_texel(c - n), s1 = height_texel(c - n + e);
    float n0 = height_texel(c + 2 * n), n1 = height_texel(c + 2 * n + e);
    vec2 south = mix(vec2(h10 - w0, h01 - s0), vec2(e0 - h00, h11 - s1), f.x);
    vec2 north = mix(vec2(h11 - w1, n0 - h00), vec2(e1 - h01, n1 - h10), f.x);
    vec2 slope = mix(south, north, f.y) / (2.0 * u_cell_m * float(stride));
    return vec3(mix(mix(h00, h10, f.x), mix(h01, h11, f.x), f.y), slope);
}

vec3 ground_sample(vec2 xy) { return ground_sample(xy, 1); }

vec3 ground_normal(vec2 slope) { return normalize(vec3(-slope, 1.0)); }

// Height between the samples, through all of them (Catmull & Rom 1974), `f` of a cell beyond `cell`.
vec4 through_samples(float f) {
    return 0.5 * vec4(((2.0 - f) * f - 1.0) * f, (3.0 * f - 5.0) * f * f + 2.0, ((4.0 - 3.0 * f) * f + 1.0) * f,
                      (f - 1.0) * f * f);
}

float height_between(ivec2 cell, vec2 f) {
    vec4 across = through_samples(f.x), up = through_samples(f.y);
    float sum = 0.0;
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) sum += across[i] * up[j] * height_texel(cell + ivec2(i - 1, j - 1));
    return sum;
}

// Gradient of the cubic B-spline over the samples: smooth where a bilinear one shows the cells from close by.
vec2 gradient_smooth(vec2 xy) {
    vec2 at = xy / u_cell_m, f = fract(at), g = 1.0 - f;
    ivec2 cell = ivec2(floor(at));
    vec4 wx = vec4(g.x * g.x * g.x, (3.0 * f.x - 6.0) * f.x * f.x + 4.0, (3.0 * g.x - 6.0) * g.x * g.x + 4.0, f.x * f.x * f.x);
    vec4 wy = vec4(g.y * g.y * g.y, (3.0 * f.y - 6.0) * f.y * f.y + 4.0, (3.0 * g.y - 6.0) * g.y * g.y + 4.0, f.y * f.y * f.y);
    vec4 dx = vec4(-g.x * g.x, (3.0 * f.x - 4.0) * f.x, (4.0 - 3.0 * g.x) * g.x, f.x * f.x) * 3.0;
    vec4 dy = vec4(-g.y * g.y, (3.0 * f.y - 4.0) * f.y, (4.0 - 3.0 * g.y) * g.y, f.y * f.y) * 3.0;
    vec2 sum = vec2(0.0);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
            sum += height_texel(cell + ivec2(i - 1, j - 1)) * vec2(dx[i] * wy[j], wx[i] * dy[j]);
    return sum / (36.0 * u_cell_m);
}

// Height and gradient for a pixel of this size: from afar over as many cells as the pixel covers.
vec3 ground_filtered(vec2 xy, float pixel_m) {
    float level = log2(max(pixel_m / u_cell_m, 1.0));
    int stride = 1 << int(min(level, 10.0));
    vec3 fine = ground_sample(xy, stride);
    float part = fract(min(level, 10.0));
    if (part > 0.02) return mix(fine, ground_sample(xy, stride * 2), part);
#ifdef SMOOTH_NEAR
    float near = 1.0 - smoothstep(0.10, 0.25, pixel_m / u_cell_m);
    if (near > 0.0) fine.yz = mix(fine.yz, gradient_smooth(xy), near);
#endif
    return fine;
}
