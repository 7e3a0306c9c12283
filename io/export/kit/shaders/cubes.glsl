// A cube that tiles, its layers one above the other in a texture `side` wide and side² high, at a place in tiles.
vec4 KIT_cube(sampler2D map, vec3 tiles) {
    int side = textureSize(map, 0).x;
    vec3 at = fract(tiles) * float(side) - 0.5, base = floor(at), f = at - base;
    ivec3 low = ivec3(base), high = low + 1;
    low = ivec3(low.x < 0 ? side - 1 : low.x, low.y < 0 ? side - 1 : low.y, low.z < 0 ? side - 1 : low.z);
    high = ivec3(high.x < side ? high.x : 0, high.y < side ? high.y : 0, high.z < side ? high.z : 0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 2; ++i) {
        int layer = (i == 0 ? low.z : high.z) * side;
        vec4 south = mix(texelFetch(map, ivec2(low.x, layer + low.y), 0), texelFetch(map, ivec2(high.x, layer + low.y), 0), f.x);
        vec4 north = mix(texelFetch(map, ivec2(low.x, layer + high.y), 0), texelFetch(map, ivec2(high.x, layer + high.y), 0), f.x);
        sum += mix(south, north, f.y) * (i == 0 ? 1.0 - f.z : f.z);
    }
    return sum;
}
