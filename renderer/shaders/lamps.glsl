// Point lights, added to what sun and sky left: inverse square, brought to nothing at a radius (D01).
#include "lib/frame.glsl"

#ifdef VERTEX
in vec4 in_box;    // clip space: left, low, right, high
in vec4 in_place;  // camera-relative place, radius m
in vec4 in_power;  // kcd
flat out vec4 v_place;
flat out vec3 v_power;

void main() {
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? in_box.x : in_box.z, (gl_VertexID & 2) == 0 ? in_box.y : in_box.w);
    gl_Position = vec4(corner, 0.0, 1.0);
    v_place = in_place;
    v_power = in_power.rgb;
}
#endif

#ifdef FRAGMENT
#include "lib/gbuffer.glsl"
#include "lib/brdf.glsl"
flat in vec4 v_place;
flat in vec3 v_power;
out vec4 out_radiance;
const float LEAST_M = 0.05;  // a lamp is no point

void main() {
    Surface s = read_gbuffer(ivec2(gl_FragCoord.xy));
    if (s.material == NOTHING) discard;
    vec3 relative = pixel_ray() * s.eye_depth;
    vec3 way = v_place.xyz - relative;
    float away2 = dot(way, way), radius2 = v_place.w * v_place.w;
    if (away2 >= radius2) discard;
    // window of Karis, Real Shading in Unreal Engine 4 (2013)
    float part = away2 / radius2, window = 1.0 - part * part;
    vec3 light = v_power * (window * window / max(away2, LEAST_M * LEAST_M));
    vec3 to_lamp = way * inversesqrt(max(away2, 1e-8));
    vec3 seen = brdf_sun(s.albedo, s.normal, -normalize(relative), to_lamp, max(s.roughness, 0.08), vec3(s.specular));
    out_radiance = vec4(min(seen * light, MOST_RADIANCE), 0.0);
}
#endif
