// Noise that tiles: R broad, G middle, B fine, A ridges, each spread evenly over 0 … 1.
#include "kit/texels.glsl"

uniform sampler2D u_noise;

vec4 noise_at(vec2 xy, float tile_m, float pixel_m) { return KIT_tiled(u_noise, xy / tile_m); }

// A turn by an angle that no tiling shares, so that two scales of one texture never line up.
vec2 turn(vec2 xy, float sine, float cosine) { return vec2(cosine * xy.x - sine * xy.y, sine * xy.x + cosine * xy.y); }

float saturate(float x) { return clamp(x, 0.0, 1.0); }
vec3 saturate(vec3 x) { return clamp(x, 0.0, 1.0); }
