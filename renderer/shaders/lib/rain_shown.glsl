// What the view shows of the rings of drops (D17).
#include "lib/rain_rings.glsl"

#ifdef RAIN_RINGS
vec3 rain_shown(vec2 xy, float pixel_m) {
    vec3 rings = rain_slope(xy, pixel_m);
    return vec3(rings.xy + 0.5, 20.0 * rings.z);
}
#else
vec3 rain_shown(vec2 xy, float pixel_m) { return vec3(0.0); }
#endif
