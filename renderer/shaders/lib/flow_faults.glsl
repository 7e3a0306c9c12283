// Faults of the current as level/flow_lint.py finds them in the paint (T02): red into land, blue sources and sinks.
vec3 flow_faults(vec2 xy) {
    vec2 east = vec2(u_current_cell_m, 0.0), north = east.yx;
    vec4 here = current_at(xy), e = current_at(xy + east), w = current_at(xy - east);
    vec4 n = current_at(xy + north), s = current_at(xy - north);
    float speed = length(here.rg), apart = 0.5 * abs(e.r - w.r + n.g - s.g);
    vec2 seaward = vec2(e.a - w.a, n.a - s.a);
    seaward /= max(length(seaward), 1e-4);
    float ashore = max(dot(here.rg, -seaward), 0.0) * (1.0 - smoothstep(1.5, 4.0, here.a));
    return clamp(vec3(2.0 * ashore, 0.25 * speed, 4.0 * apart / max(speed, 0.3)), 0.0, 1.0);
}
