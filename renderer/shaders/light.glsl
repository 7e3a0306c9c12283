// Light on everything in the G-buffer, once, land and water alike (D01): sun with shadow, sky, finished light added.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/gbuffer.glsl"
#include "lib/sky.glsl"
#include "lib/lobes.glsl"
#include "lib/brdf.glsl"
#include "lib/glare.glsl"
#include "lib/shadow.glsl"
#include "lib/land_light.glsl"
#ifdef QUIET
#include "level/current.glsl"
#endif
#ifdef REFLECTIONS
#include "lib/reflections.glsl"
uniform float u_water_reflections;
#endif
out vec4 out_radiance;
uniform float u_light_bounce;
uniform float u_low_m;  // how high over the sea water may stand
#ifdef WHITE
const vec3 LAND_BOUNCE = vec3(1.0);  // the furnace: everything gives back all light
vec3 coast_radiance() { return vec3(1.0); }
#else
const vec3 LAND_BOUNCE = vec3(0.17, 0.155, 0.13);  // albedo of land, half of it in the sun
vec3 coast_radiance() { return (sky_irradiance(vec3(0.0, 0.0, 1.0)) + 0.35 * u_sun_mean) * (0.3 * LAND_BOUNCE); }
#endif

// What water mirrors: the sky, the land that is seen, else a coast as bright as land of a middling albedo (H17).
vec3 in_the_water(vec3 mirrored, Surface s, vec3 relative, vec3 mirror) {
    vec4 land = vec4(0.0);
    float known = 0.0;
#ifdef REFLECTIONS
    land = land_mirrored(relative, mirror, s.roughness, known) * u_water_reflections;
    known *= u_water_reflections;
#ifdef RIVERS
    // what stands higher than waves reach mirrors in a plane of its own
    float same = 1.0 - smoothstep(0.5, 1.0, (relative.z + u_camera.z - u_sea_now_m) / max(u_low_m, 0.5));
    land *= same;
    known *= same;
#endif
#endif
    if (known < 1.0) {
        float coast = land_in_mirror(u_camera + relative, normalize(vec3(mirror.xy, max(mirror.z, 0.02))));
        mirrored = mix(mirrored, coast_radiance(), coast * (1.0 - known));
    }
    return mirrored * (1.0 - land.a) + land.rgb;
}

vec3 radiance(Surface s, vec3 relative) {
#ifdef LAND_FIRST
    const bool on_sea = false;
#else
    bool on_sea = s.material == SEA;
#endif
    vec3 to_eye = -normalize(relative);
    vec3 mirror = on_sea ? water_mirror(s.normal, to_eye, s.roughness) : reflect(-to_eye, s.normal);
    vec3 f0 = vec3(s.specular);
    vec3 sun = sun_radiance() * sun_visibility(u_camera + relative);
    float quiet = 0.0;
#ifdef QUIET
    if (on_sea) quiet = current_at(s.before).b;
#endif
    vec3 light = on_sea
        ? sun_on_water(s.albedo, s.normal, to_eye, u_sun_direction, s.roughness, f0, quiet) * sun
        : brdf_sun(s.albedo, s.normal, to_eye, u_sun_direction, s.roughness, f0) * sun;
    // what hides the sky is itself lit land or water, and gives part of its light back
    vec3 up = sky_irradiance(vec3(0.0, 0.0, 1.0)) + u_sun_mean * max(u_sun_direction.z, 0.0);
    vec3 bounce = up * LAND_BOUNCE * u_light_bounce * (1.0 - s.open);
    vec3 ambient = sky_irradiance(s.normal) * s.open + bounce;
    vec3 mirrored = sky_lobe(mirror, s.roughness) * s.open + bounce / PI;
    if (on_sea && s.roughness < 0.6) mirrored = in_the_water(mirrored, s, relative, mirror);
    return light + brdf_ambient(s.albedo, s.normal, to_eye, s.roughness, f0, ambient, mirrored);
}

void main() {
    Surface s = read_gbuffer(ivec2(gl_FragCoord.xy));
    vec3 relative = pixel_ray() * s.eye_depth;
    bool lit = s.material != NOTHING;
    // H12: what may lie under water is lit without a mirror for the plates, and again, with it, where it stays bare
    bool low = relative.z + u_camera.z < u_sea_now_m + u_low_m;
#ifdef WHITE
    s.albedo = vec3(1.0);
    s.emissive = vec3(0.0);
#endif
#ifdef LAND_FIRST
    if (low) {
        s.specular = 0.0;
        s.roughness = 1.0;
    }
#endif
#ifdef SEA_ALONE
    lit = lit && (s.material == SEA || low);
#endif
    if (!lit) discard;
    out_radiance = vec4(min(radiance(s, relative) + s.emissive, MOST_RADIANCE), 1.0);
}
#endif
