// Tiling noise (level/textures.py) instead of noise worked out per pixel, which costs more than all geometry in software.
// One sampler: R broad, G middle, B fine, A ridges, each spread evenly over 0 … 1.

uniform sampler2D u_noise;

const float NOISE_TEXELS = 512.0;

vec4 noise_at(vec2 uv) { return texture(u_noise, uv); }

// With the size of a pixel in world metres, safe inside branches; `tile_m` is the side of a tile.
vec4 noise_at(vec2 xy, float tile_m, float pixel_m) {
    return textureLod(u_noise, xy / tile_m, log2(max(pixel_m * NOISE_TEXELS / tile_m, 1e-4)));
}

// A turn by an angle that no tiling shares, so that two scales of one texture never line up.
vec2 turn(vec2 xy, float sine, float cosine) { return vec2(cosine * xy.x - sine * xy.y, sine * xy.x + cosine * xy.y); }

float saturate(float x) { return clamp(x, 0.0, 1.0); }
vec3 saturate(vec3 x) { return clamp(x, 0.0, 1.0); }

// Two materials meet by height: the one that stands higher at a pixel covers the other there.
float height_blend(float weight, float height_a, float height_b, float sharpness) {
    float a = height_a + 1.0 - weight, b = height_b + weight;
    float edge = max(a, b) - sharpness;
    a = max(a - edge, 0.0);
    b = max(b - edge, 0.0);
    return b / max(a + b, 1e-5);
}

// Side of a pixel on a surface whose position is given, in metres; call outside branches.
#ifdef FRAGMENT
float pixel_size(vec3 position) {
    vec3 dx = dFdx(position), dy = dFdy(position);
    return sqrt(max(sqrt(dot(dx, dx) * dot(dy, dy)), 1e-8));
}
#endif
