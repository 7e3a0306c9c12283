// What views show of rivers and their mouths (D13, D35).
#ifdef RIVERS
#include "lib/mouth.glsl"
uniform float u_chop_length_m;
#endif

// Heading as hue: east red, then on to the left as a colour wheel goes; speed as brightness, full at `full_mps`.
vec3 heading_colour(vec2 flow, float full_mps) {
    float turn = fract(atan(flow.y, flow.x) / 6.28318530718 + 1.0);
    vec3 hue = clamp(abs(fract(turn + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
    return mix(vec3(0.75), hue, 0.85) * min(length(flow) / full_mps, 1.0);
}

// The current where it is a river's or its jet's, on dim water.
vec3 river_flow_shown(vec2 before) { return vec3(0.02, 0.03, 0.05) + heading_colour(current_at(before).rg, 2.0); }

// Metres over the mean sea of water that isn't the sea, waves left out.
float river_level_shown(Sea sea) {
#ifdef RIVERS
    return sea.river.share > 0.0 ? sea.still + u_tide_m : 0.0;
#else
    return 0.0;
#endif
}

// Red swell, green chop that comes there, half as bright as white where it is as at sea; blue where the current holds it.
vec3 mouth_shown(Sea sea) {
#ifdef RIVERS
    return vec3(0.5 * sea.river.waves.x, 0.5 * sea.river.chop.x, sea.river.white);
#else
    return vec3(0.5, 0.5, 0.0);
#endif
}

// Red the share of rivers' water, green foam along the shear line, blue that of chop which the current holds up.
vec3 plume_shown(Sea sea, vec2 before, float pixel_m) {
#ifdef RIVERS
    Plume plume = plume_at(before, pixel_m);
    float held = blocked_foam(sea.river.white, before, sea.height01, u_chop_length_m, pixel_m);
    return vec3(river_tint(plume, smoothstep(0.0, 0.6, sea.river.share)), plume.seam, held);
#else
    return vec3(0.0);
#endif
}
