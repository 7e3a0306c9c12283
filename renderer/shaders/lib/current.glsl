// The current as level/flow.py makes it: east, north in m/s, quiet 0 … 1, metres to the shoreline (D05, D06, D39).
uniform sampler2D u_current;
uniform float u_current_cell_m;

vec4 current_at(vec2 xy) {
    return textureLod(u_current, (xy / u_current_cell_m + 0.5) / vec2(textureSize(u_current, 0)), 0.0);
}
