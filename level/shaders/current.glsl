// The current as level/flow.py makes it: east, north in m/s, quiet 0 … 1, metres to the shoreline (D05, D06, D39).
uniform sampler2D u_current;
uniform float u_current_cell_m;

// Beyond the level its border would go on as a stripe: there the shore moves away with every metre, the current dies out.
vec4 current_at(vec2 xy) {
    vec2 size = vec2(textureSize(u_current, 0));
    vec4 current = textureLod(u_current, (xy / u_current_cell_m + 0.5) / size, 0.0);
    float outside_m = length(xy - clamp(xy, vec2(0.0), (size - 1.0) * u_current_cell_m));
    current.rgb *= 1.0 - smoothstep(0.0, 60.0, outside_m);
    current.a += outside_m;
    return current;
}
