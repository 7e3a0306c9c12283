// Foam's own texture, at places in tiles: R lace, G middle, B dense, each equalised; A bubbles.
#include "kit/texels.glsl"

uniform sampler2D u_foam;

const float FOAM_TEXELS = 512.0;

vec4 foam_texture(vec2 tiles, float lod) { return KIT_tiled(u_foam, tiles); }
