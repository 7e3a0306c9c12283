// The ground from the height texture, read with texelFetch: texture units keep too few bits of the fraction.
// Beyond the level the land goes on as its mirror image and sinks below the sea: no slab, no furrows. Where the border is
// sea no mirrored land rises from it.

uniform sampler2D u_height;
uniform float u_cell_m;
uniform float u_still_m;  // the still sea
uniform vec2 u_apron;     // how far the land goes on beyond the border, how deep it sinks on the way, metres

// A sample's mirror image in the level.
ivec2 mirrored_cell(ivec2 cell, ivec2 last) { return clamp(abs(last - abs(last - cell)), ivec2(0), last); }

float height_texel(ivec2 cell) {
    ivec2 last = textureSize(u_height, 0) - 1;
    ivec2 inside = clamp(cell, ivec2(0), last);
    float height = texelFetch(u_height, inside, 0).r;
    ivec2 off = cell - inside;
    if (off != ivec2(0)) {
        float out_m = length(vec2(off)) * u_cell_m;
        float mirrored = texelFetch(u_height, mirrored_cell(cell, last), 0).r;
        float most = height + out_m * smoothstep(0.0, 2.5, height - u_still_m);
        height = min(mirrored, most);
        height = mix(height, min(height, u_still_m - u_apron.y), smoothstep(0.15 * u_apron.x, u_apron.x, out_m));
    }
    return height;
}

// Height and its gradient: bilinear between samples, gradients from central differences.
vec3 ground_sample(vec2 xy) {
    vec2 at = xy / u_cell_m, base = floor(at), f = at - base;
    ivec2 c = ivec2(base), e = ivec2(1, 0), n = ivec2(0, 1);
    float h00 = height_texel(c), h10 = height_texel(c + e), h01 = height_texel(c + n), h11 = height_texel(c + e + n);
    vec2 south = mix(vec2(h10 - height_texel(c - e), h01 - height_texel(c - n)),
                     vec2(height_texel(c + 2 * e) - h00, h11 - height_texel(c - n + e)), f.x);
    vec2 north = mix(vec2(h11 - height_texel(c - e + n), height_texel(c + 2 * n) - h00),
                     vec2(height_texel(c + 2 * e + n) - h01, height_texel(c + 2 * n + e) - h10), f.x);
    return vec3(mix(mix(h00, h10, f.x), mix(h01, h11, f.x), f.y), mix(south, north, f.y) / (2.0 * u_cell_m));
}

vec3 ground_normal(vec2 slope) { return normalize(vec3(-slope, 1.0)); }

// Sixteen heights round a cell, `stride` cells apart, [column][row], its own at [1][1]; mirror images beyond the border.
mat4 heights_round(ivec2 cell, int stride) {
    ivec2 last = textureSize(u_height, 0) - 1;
    mat4 h;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            h[i][j] = texelFetch(u_height, mirrored_cell(cell + ivec2(i - 1, j - 1) * stride, last), 0).r;
    return h;
}

// Height between the samples, through all of them (Catmull & Rom 1974), `f` of a cell beyond `cell`.
vec4 through_samples(float f) {
    return 0.5 * vec4(((2.0 - f) * f - 1.0) * f, (3.0 * f - 5.0) * f * f + 2.0, ((4.0 - 3.0 * f) * f + 1.0) * f,
                      (f - 1.0) * f * f);
}

float height_between(ivec2 cell, vec2 f) {
    mat4 h;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) h[i][j] = height_texel(cell + ivec2(i - 1, j - 1));
    return dot(through_samples(f.x), through_samples(f.y) * h);
}

// Gradient between samples `step_m` apart: bilinear between central differences.
vec2 slope_bilinear(mat4 h, vec2 f, float step_m) {
    vec2 south = mix(vec2(h[2][1] - h[0][1], h[1][2] - h[1][0]), vec2(h[3][1] - h[1][1], h[2][2] - h[2][0]), f.x);
    vec2 north = mix(vec2(h[2][2] - h[0][2], h[1][3] - h[1][1]), vec2(h[3][2] - h[1][2], h[2][3] - h[2][1]), f.x);
    return mix(south, north, f.y) / (2.0 * step_m);
}

// Weights of the cubic B-spline over four samples, and of its slope.
vec4 spline(float f) {
    float g = 1.0 - f;
    return vec4(g * g * g, (3.0 * f - 6.0) * f * f + 4.0, (3.0 * g - 6.0) * g * g + 4.0, f * f * f) / 6.0;
}

vec4 spline_slope(float f) {
    float g = 1.0 - f;
    return vec4(-g * g, (3.0 * f - 4.0) * f, (4.0 - 3.0 * g) * g, f * f) * 0.5;
}

// Gradient for a pixel of this size: from afar over as many cells as the pixel covers; from close by that of a
// B-spline, where a bilinear one would show the cells (SMOOTH_NEAR). Beyond the border it levels out.
vec2 slope_filtered(vec2 xy, float pixel_m) {
    float level = min(log2(max(pixel_m / u_cell_m, 1.0)), 10.0);
    int stride = 1 << int(level);
    float step_m = u_cell_m * float(stride);
    vec2 at = xy / step_m, base = floor(at), f = at - base;
    vec2 wide_at = 0.5 * at, wide_base = floor(wide_at);
    mat4 h = heights_round(ivec2(base) * stride, stride);
    vec2 slope = slope_bilinear(h, f, step_m);
#ifdef SMOOTH_NEAR
    vec2 smooth_slope = vec2(dot(spline_slope(f.x), spline(f.y) * h), dot(spline(f.x), spline_slope(f.y) * h)) / step_m;
    slope = mix(smooth_slope, slope, smoothstep(0.10, 0.25, pixel_m / u_cell_m));
#endif
    mat4 wide = heights_round(ivec2(wide_base) * stride * 2, stride * 2);
    slope = mix(slope, slope_bilinear(wide, wide_at - wide_base, 2.0 * step_m), fract(level));
    vec2 last = vec2(textureSize(u_height, 0) - 1) * u_cell_m;
    return slope * (1.0 - smoothstep(0.15 * u_apron.x, u_apron.x, length(xy - clamp(xy, vec2(0.0), last))));
}
