// The current: east, north in m/s, quiet 0 … 1, metres to the shoreline (D05, D06, D39).
uniform sampler2D u_current;       // east, north in m/s, quiet 0 … 1, metres to the shoreline
uniform float u_current_cell_m;    // between two of its samples

// What its samples say; beyond the level that of its border.
vec4 current_between(vec2 xy) {
    vec2 size = vec2(textureSize(u_current, 0));
    vec2 at = clamp(xy / u_current_cell_m, vec2(0.0), size - 1.0), base = min(floor(at), size - 2.0), f = at - base;
    ivec2 cell = ivec2(base);
    vec4 south = mix(texelFetch(u_current, cell, 0), texelFetch(u_current, cell + ivec2(1, 0), 0), f.x);
    vec4 north = mix(texelFetch(u_current, cell + ivec2(0, 1), 0), texelFetch(u_current, cell + ivec2(1, 1), 0), f.x);
    return mix(south, north, f.y);
}

// Beyond the level its border would go on as a stripe: there the shore moves away with every metre, the current dies out.
vec4 current_at(vec2 xy) {
    vec4 current = current_between(xy);
    vec2 last = (vec2(textureSize(u_current, 0)) - 1.0) * u_current_cell_m;
    float outside_m = length(xy - clamp(xy, vec2(0.0), last));
    current.rgb *= 1.0 - smoothstep(0.0, 60.0, outside_m);
    current.a += outside_m;
    return current;
}
