// Textures by hand, between the middles of texels, finest mip alone: no filter, no mips, no wrap mode is asked of anybody.

// At a place in tiles of a texture that goes on for ever.
vec4 KIT_tiled(sampler2D map, vec2 tiles) {
    vec2 size = vec2(textureSize(map, 0)), at = fract(tiles) * size - 0.5, base = floor(at), f = at - base;
    ivec2 side = textureSize(map, 0), low = ivec2(base), high = low + 1;
    low = ivec2(low.x < 0 ? side.x - 1 : low.x, low.y < 0 ? side.y - 1 : low.y);
    high = ivec2(high.x < side.x ? high.x : 0, high.y < side.y ? high.y : 0);
    vec4 south = mix(texelFetch(map, low, 0), texelFetch(map, ivec2(high.x, low.y), 0), f.x);
    return mix(south, mix(texelFetch(map, ivec2(low.x, high.y), 0), texelFetch(map, high, 0), f.x), f.y);
}

// At 0 … 1 of a texture that ends with its border.
vec4 KIT_clamped(sampler2D map, vec2 uv) {
    vec2 size = vec2(textureSize(map, 0)), at = clamp(uv * size - 0.5, vec2(0.0), size - 1.0), base = floor(at), f = at - base;
    ivec2 low = ivec2(base), high = ivec2(min(base + 1.0, size - 1.0));
    vec4 south = mix(texelFetch(map, low, 0), texelFetch(map, ivec2(high.x, low.y), 0), f.x);
    return mix(south, mix(texelFetch(map, ivec2(low.x, high.y), 0), texelFetch(map, high, 0), f.x), f.y);
}
