// Pins: how much later waves come than without them, a dual in cycles (T07). The twin is level/pins.py.
const int MOST_PINS = 8;

#ifdef PINS
uniform vec4 u_pins[MOST_PINS];  // world xy, weight
uniform float u_pin_shift, u_pin_reach_m;

vec3 pinned_later(vec2 xy) {
    vec3 total = vec3(u_pin_shift, 0.0, 0.0);
    for (int i = 0; i < MOST_PINS; ++i) {
        vec2 off = (xy - u_pins[i].xy) / u_pin_reach_m;
        float bump = u_pins[i].z * exp(-dot(off, off));
        total += vec3(bump, -2.0 * bump / u_pin_reach_m * off);
    }
    return total;
}
#else
vec3 pinned_later(vec2 xy) { return vec3(0.0); }
#endif
