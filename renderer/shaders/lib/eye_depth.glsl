// Eye depth for what is laid over the finished picture.

// Where fewer pixels were drawn than are shown, between four of them: over a plane, one over the depth is linear on the
// screen.
float smooth_eye_depth(sampler2D depth) {
    ivec2 size = textureSize(depth, 0);
    vec2 at = gl_FragCoord.xy * vec2(size) / u_size;
    float nearest = texelFetch(depth, ivec2(at), 0).r;
    if (size == ivec2(u_size) || nearest <= 0.0) return nearest;
    ivec2 low = clamp(ivec2(floor(at - 0.5)), ivec2(0), size - 1), high = min(low + 1, size - 1);
    vec2 f = clamp(at - 0.5 - vec2(low), 0.0, 1.0);
    vec4 depths = vec4(texelFetch(depth, low, 0).r, texelFetch(depth, ivec2(high.x, low.y), 0).r,
                       texelFetch(depth, ivec2(low.x, high.y), 0).r, texelFetch(depth, high, 0).r);
    float least = min(min(depths.x, depths.y), min(depths.z, depths.w));
    float most = max(max(depths.x, depths.y), max(depths.z, depths.w));
    if (least < 0.8 * most) return nearest;  // an edge
    vec4 inverse = 1.0 / depths;
    return 1.0 / mix(mix(inverse.x, inverse.y, f.x), mix(inverse.z, inverse.w, f.x), f.y);
}
