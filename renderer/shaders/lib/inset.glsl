// A view as an inset (T12): a buffer as it is on the screen, smaller; or (INSET_MAP) what the world is, from above.
#include "lib/ramp.glsl"

uniform vec4 u_inset;  // left, bottom, width, height in pixels of the finished picture

const float FRAME_PX = 1.5;

// Place in the inset, 0 … 1.
vec2 inset_part() { return (gl_FragCoord.xy - u_inset.xy) / u_inset.zw; }

#ifdef INSET_MAP
uniform vec4 u_inset_map;   // east, north of its middle; metres from there to its edge; metres a pixel
uniform vec4 u_inset_turn;  // the world's directions to the right and up in it
uniform vec2 u_inset_ahead; // the way the camera looks, in it

vec2 inset_world() {
    vec2 off = 2.0 * inset_part() - 1.0;
    return u_inset_map.xy + u_inset_map.z * (off.x * u_inset_turn.xy + off.y * u_inset_turn.zw);
}

// A pixel of a map: the surface there, seen from straight above by a camera whose pixels are as large.
Surface inset_surface(vec2 xy, bool sea, float pixel_m) {
    return Surface(vec3(0.0), 1.0, vec3(0.0, 0.0, 1.0), 1.0, 0.0, sea ? SEA : LAND, 0.0, 0.0, vec3(0.0),
                   pixel_m / u_pixel_angle, xy);
}

// Where the camera stands and which way it looks, so many pixels wider than it is drawn.
float inset_needle(float wider) {
    vec2 world = u_camera.xy - u_inset_map.xy;
    vec2 at = vec2(dot(world, u_inset_turn.xy), dot(world, u_inset_turn.zw)) / u_inset_map.z;
    vec2 off = (2.0 * inset_part() - 1.0 - at) * 0.5 * u_inset.z;
    float along = dot(off, u_inset_ahead), beside = length(off - u_inset_ahead * clamp(along, 0.0, 12.0));
    return max(1.0 - smoothstep(2.0, 3.0, length(off) - wider), 1.0 - smoothstep(0.6, 1.6, beside - wider));
}
#endif

vec4 inset_colour(vec3 value) {
    vec3 colour = clamp(shown(value), 0.0, 1.0);
#ifdef INSET_MAP
    colour = mix(colour * (1.0 - 0.75 * inset_needle(1.0)), vec3(1.0, 0.85, 0.3), inset_needle(0.0));
#endif
    vec2 in_px = min(gl_FragCoord.xy - u_inset.xy, u_inset.xy + u_inset.zw - gl_FragCoord.xy);
    return vec4(mix(vec3(0.92), colour, step(FRAME_PX, min(in_px.x, in_px.y))), 1.0);
}
