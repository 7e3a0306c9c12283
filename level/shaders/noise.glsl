// Tiling noise (level/textures.py) instead of noise worked out per pixel, which costs more than all geometry in software.
// One sampler: R broad, G middle, B fine, A ridges, each spread evenly over 0 … 1.

uniform sampler2D u_noise;

const float NOISE_TEXELS = 512.0;

// With the size of a pixel in world metres, safe inside branches; `tile_m` is the side of a tile.
vec4 noise_at(vec2 xy, float tile_m, float pixel_m) {
    return textureLod(u_noise, xy / tile_m, log2(max(pixel_m * NOISE_TEXELS / tile_m, 1e-4)));
}

// A turn by an angle that no tiling shares, so that two scales of one texture never line up.
vec2 turn(vec2 xy, float sine, float cosine) { return vec2(cosine * xy.x - sine * xy.y, sine * xy.x + cosine * xy.y); }

float saturate(float x) { return clamp(x, 0.0, 1.0); }
vec3 saturate(vec3 x) { return clamp(x, 0.0, 1.0); }
