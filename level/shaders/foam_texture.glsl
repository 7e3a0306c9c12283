// Foam's own texture (level/textures.py), at places in tiles.

uniform sampler2D u_foam;        // R lace, G middle, B dense, each equalised; A bubbles

const float FOAM_TEXELS = 512.0;

vec4 foam_texture(vec2 tiles, float lod) { return textureLod(u_foam, tiles, lod); }
