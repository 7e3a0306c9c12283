// The field that things in the water stir (D18) is the running game's own: a kit has none.
vec3 force_lift(vec2 xy) { return vec3(0.0); }
