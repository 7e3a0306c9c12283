// What the views show of rivers (D14 to D17); black where the level has none.
#ifdef RIVERS
#include "lib/river.glsl"

Stream stream_shown(Sea sea, vec2 before, float pixel_m) {
    return stream_at(sea.river, before, current_at(before).rg, force_at(sea.position.xy).xy, pixel_m);
}

// A way of the water, 2 m/s to full: red east, green north; grey is none.
vec3 way_shown(vec2 way, Stream s) { return s.share * vec3(way * 0.25 + 0.5, 0.5); }

vec3 raw_flow(Sea sea, vec2 before, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    return way_shown(s.raw, s);
}

vec3 curl_shown(Sea sea, vec2 before, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    return way_shown(s.eddies, s);
}

vec3 flow_sum(Sea sea, vec2 before, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    return way_shown(s.raw + s.eddies, s);
}

// The layers without their masks.
const float WHOLE = 0.7;

float stagnant_shown(Sea sea, vec2 before, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    return s.share * stagnant_foam(before, s.flow, WHOLE, pixel_m).cover;
}

float turbulent_shown(Sea sea, vec2 before, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    return s.share * turbulent_foam(before, s.flow, WHOLE, pixel_m).cover;
}

// Both under their masks: stagnant foam green, turbulent white.
vec3 masked_shown(Sea sea, vec2 before, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    vec2 painted = layer_at(u_layer_foam, before, u_cell_m).ba;
    vec4 force = force_at(sea.position.xy);
    float slow = stagnant_foam(before, s.flow, stagnant_amount(s, before, painted.x, force, true, pixel_m), pixel_m).cover;
    float fast = turbulent_foam(before, s.flow, turbulent_amount(s, painted.y, true), pixel_m).cover;
    return mix(vec3(0.1, 0.55, 0.15) * slow, vec3(1.0), fast);
}

// White where the foam of fast water is full (D15); beyond rivers the current's speed, 1 m/s to white.
float flow_speed_shown(Sea sea, vec2 before) {
    vec2 current = current_at(before).rg;
    return mix(length(current), speed_foam(current), smoothstep(0.0, 0.6, sea.river.share));
}

float fall_shown(Sea sea, vec2 before, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    return s.share * fall_foam(s.lean);
}

float river_shade_shown(Sea sea, vec2 before, vec2 at, float shade, float pixel_m) {
    Stream s = stream_shown(sea, before, pixel_m);
    float painted = layer_at(u_layer_foam, before, u_cell_m).b;
    float amount = stagnant_amount(s, before, painted, force_at(sea.position.xy), true, pixel_m);
    return mix(shade, 1.0, s.own) * river_shade(s, at, amount, pixel_m);
}
#else
vec3 raw_flow(Sea sea, vec2 before, float pixel_m) { return vec3(0.0); }
vec3 curl_shown(Sea sea, vec2 before, float pixel_m) { return vec3(0.0); }
vec3 flow_sum(Sea sea, vec2 before, float pixel_m) { return vec3(0.0); }
float stagnant_shown(Sea sea, vec2 before, float pixel_m) { return 0.0; }
float turbulent_shown(Sea sea, vec2 before, float pixel_m) { return 0.0; }
vec3 masked_shown(Sea sea, vec2 before, float pixel_m) { return vec3(0.0); }
float flow_speed_shown(Sea sea, vec2 before) { return length(current_at(before).rg); }
float fall_shown(Sea sea, vec2 before, float pixel_m) { return 0.0; }
float river_shade_shown(Sea sea, vec2 before, vec2 at, float shade, float pixel_m) { return shade; }
#endif
