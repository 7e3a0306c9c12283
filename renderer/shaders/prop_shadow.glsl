// Things slid along the sun's rays onto a level plane (L03): the highest wins a texel. Depth only. Scattered ones, or with
// PROP meshes from files (D12).

#ifdef VERTEX
#ifdef PROP
#include "lib/prop.glsl"
vec3 relative() { return prop_relative(); }
#else
#include "lib/scatter.glsl"
vec3 relative() { return in_place.xyz + instance_axes() * in_position * in_place.w; }
#endif
uniform vec2 u_slant;     // metres towards the sun a metre up
uniform float u_half_m;   // half the side of the square
uniform float u_lower_m;  // by which what has no inside is lowered, so that it doesn't shade itself
uniform float u_range_m;  // greatest height over or under its middle

void main() {
    vec3 p = relative();
    p.z -= u_lower_m;
    gl_Position = vec4((p.xy - u_slant * p.z) / u_half_m, -p.z / u_range_m, 1.0);
}
#endif

#ifdef FRAGMENT
void main() {}
#endif
