// Numbers of a view, or linear light, to display colours (views.py RAMPS).
#include "lib/display.glsl"

uniform float u_exposure;
uniform vec3 u_white;   // gains of the white balance
uniform int u_display;
uniform int u_ramp;     // views.py RAMPS
uniform vec2 u_range;

const int LIGHT = 0, COLOUR = 1, DIRECT = 2, GREY = 3, SIGNED = 4, NORMAL = 5, METRES = 6;

vec3 shown(vec3 value) {
    if (u_ramp == LIGHT) return srgb_encode(display_transform(value * u_white, u_exposure, u_display)) + dither(gl_FragCoord.xy);
    if (u_ramp == COLOUR) return srgb_encode(value);
    if (u_ramp == GREY) return (value - u_range.x) / (u_range.y - u_range.x);
    if (u_ramp == NORMAL) return value * 0.5 + 0.5;
    if (u_ramp == METRES) return fract(value / 10.0);
    if (u_ramp == SIGNED) {
        float v = value.x / max(abs(u_range.x), abs(u_range.y));
        vec3 side = v < 0.0 ? vec3(0.10, 0.30, 0.85) : vec3(0.80, 0.22, 0.10);
        return mix(vec3(0.94), side, sqrt(clamp(abs(v), 0.0, 1.0)));
    }
    return value;
}
