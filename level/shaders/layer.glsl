// A painted layer at world metres, bilinear: samples stand at vertices; one texel stands for a layer nobody painted.

vec4 layer_at(sampler2D layer, vec2 xy, float cell_m) {
    ivec2 last = textureSize(layer, 0) - 1;
    if (last == ivec2(0)) return texelFetch(layer, ivec2(0), 0);
    vec2 at = clamp(xy / cell_m, vec2(0.0), vec2(last));
    ivec2 low = min(ivec2(at), last - 1);
    vec2 f = at - vec2(low);
    vec4 south = mix(texelFetch(layer, low, 0), texelFetch(layer, low + ivec2(1, 0), 0), f.x);
    vec4 north = mix(texelFetch(layer, low + ivec2(0, 1), 0), texelFetch(layer, low + 1, 0), f.x);
    return mix(south, north, f.y);
}
