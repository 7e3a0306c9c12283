// A cube that tiles, at a place in tiles: its layers of `side` by `side` texels stand in a texture, `columns` beside each
// other from the south-west on, rows of them above, for few graphics cards take a texture as high as all layers.
vec4 KIT_cube(sampler2D map, int side, int columns, vec3 tiles) {
    vec3 at = fract(tiles) * float(side) - 0.5, base = floor(at), f = at - base;
    ivec3 low = ivec3(base), high = low + 1;
    low = ivec3(low.x < 0 ? side - 1 : low.x, low.y < 0 ? side - 1 : low.y, low.z < 0 ? side - 1 : low.z);
    high = ivec3(high.x < side ? high.x : 0, high.y < side ? high.y : 0, high.z < side ? high.z : 0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 2; ++i) {
        int layer = i == 0 ? low.z : high.z;
        ivec2 corner = ivec2(layer % columns, layer / columns) * side;
        vec4 south = mix(texelFetch(map, corner + low.xy, 0), texelFetch(map, corner + ivec2(high.x, low.y), 0), f.x);
        vec4 north = mix(texelFetch(map, corner + ivec2(low.x, high.y), 0), texelFetch(map, corner + high.xy, 0), f.x);
        sum += mix(south, north, f.y) * (i == 0 ? 1.0 - f.z : f.z);
    }
    return sum;
}
