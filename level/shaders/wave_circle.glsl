// The weight of a wave object or region: 1 within, falling smoothly to 0 at its edge, a dual (H08, D32).
#include "level/dual.glsl"

// `place`: x, y, radius of its full weight, radius.
vec3 circle_weight(vec4 place, vec2 before) {
    vec2 off = before - place.xy;
    float away = length(off);
    return d_const(1.0) - d_step(place.z, place.w, vec3(away, off / max(away, 1e-6)));
}
