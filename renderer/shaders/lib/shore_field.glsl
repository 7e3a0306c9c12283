// The packed shore field (H10, H11): read as level/shore_field.py does, by the same names. Channels are 0 … 1 here.
uniform sampler2D u_shore_field;
uniform float u_shore_distance_range_m, u_shore_field_cell_m;

// The texel values between vertices, at a world point; beyond the level its edge.
vec4 shore_field_at(vec2 xy) {
    return textureLod(u_shore_field, (xy / u_shore_field_cell_m + 0.5) / vec2(textureSize(u_shore_field, 0)), 0.0);
}

// Metres to the shoreline: positive in the sea, negative on land.
float decode_distance_m(float red) { return (red * 255.0 - 127.5) * (u_shore_distance_range_m / 128.0); }

// East and north: to the shore in the sea, on inland; short where directions meet, zero beyond the range.
vec2 decode_direction(vec2 green_blue) { return (green_blue * 255.0 - 128.0) / 127.0; }

// Metres of bare beach over the still sea, −2 … 2.
float decode_beach_m(float alpha) { return (alpha * 255.0 + 0.5) * (4.0 / 256.0) - 2.0; }
