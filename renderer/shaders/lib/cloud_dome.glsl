// The upper half of all directions on a square: an octahedron's upper half, turned by an eighth (Cigolle et al. 2014).

vec3 dome_direction(vec2 uv) {
    vec2 p = uv * 2.0 - 1.0;
    vec2 flat_part = vec2(p.x + p.y, p.x - p.y) * 0.5;
    return normalize(vec3(flat_part, max(1.0 - abs(flat_part.x) - abs(flat_part.y), 1e-3)));
}

vec2 dome_place(vec3 dir) {
    vec2 p = dir.xy / (abs(dir.x) + abs(dir.y) + max(dir.z, 0.0));
    return vec2(p.x + p.y, p.x - p.y) * 0.5 + 0.5;
}
