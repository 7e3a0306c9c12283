// Point lights, added to what sun and sky left: inverse square, brought to nothing at a radius (D01). UNDER: on what lies
// under water, into the plate it is seen through (H12).
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
#ifdef UNDER
#include "lib/sky.glsl"
#include "lib/water.glsl"
#endif
flat in vec4 v_place;
flat in vec3 v_power;
out vec4 out_radiance;
const float LEAST_M = 0.05;  // a lamp is no point

#ifdef UNDER
// The water takes what daylight would lose on the way straight down when it is looked through (lib/sea_below.glsl): here
// what the lamp's own way is longer. A lamp under water shines brighter for it, within reason.
vec3 lost_in_water(float depth, vec3 way) {
    float metres = length(way) * (way.z > depth ? depth / way.z : 1.0);
    float daylight_m = depth / water_cosine(max(u_sun_direction.z, 0.25));
    return exp(-max(water_attenuation() * (metres - daylight_m), -1.5));
}
#endif

void main() {
#ifdef UNDER
    ivec2 pixel = min(2 * ivec2(gl_FragCoord.xy), ivec2(u_size) - 1);
    float eye_depth = texelFetch(g_eye_depth, pixel, 0).r;
    vec2 clip = (vec2(pixel) + 0.5) / u_size * 2.0 - 1.0;
    vec3 relative = (u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y) * eye_depth;
    float depth = u_sea_now_m - u_camera.z - relative.z;
    if (eye_depth <= 0.0 || depth <= 0.0) discard;
    Surface s = read_gbuffer(pixel);
    s.roughness = 1.0;
    s.specular = 0.0;
#else
    Surface s = read_gbuffer(ivec2(gl_FragCoord.xy));
    if (s.material == NOTHING) discard;
    vec3 relative = pixel_ray() * s.eye_depth;
#endif
    vec3 way = v_place.xyz - relative;
    if (s.material == SEA && way.z < 0.0) discard;  // a lamp under water lights the bed, not the surface from above
    float away2 = dot(way, way), radius2 = v_place.w * v_place.w;
    if (away2 >= radius2) discard;
    // window of Karis, Real Shading in Unreal Engine 4 (2013)
    float part = away2 / radius2, window = 1.0 - part * part;
    vec3 light = v_power * (window * window / max(away2, LEAST_M * LEAST_M));
#ifdef UNDER
    light *= lost_in_water(depth, way);
#endif
    vec3 to_lamp = way * inversesqrt(max(away2, 1e-8));
    vec3 seen = brdf_sun(s.albedo, s.normal, -normalize(relative), to_lamp, max(s.roughness, 0.08), vec3(s.specular));
    out_radiance = vec4(min(seen * light, MOST_RADIANCE), 0.0);
}
#endif
