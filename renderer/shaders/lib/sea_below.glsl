// What is seen through the surface (D02, L07): the land below, where the wave bends the view to, and what the way there
// does to its light.
#include "lib/water.glsl"
#include "lib/foam.glsl"
#include "lib/rings.glsl"

uniform sampler2D under_albedo, under_eye_depth;
uniform bool u_show_refraction;
uniform float u_water_bend;
#ifdef PLATE
#include "lib/plate.glsl"
uniform float u_bed_most;  // brightest bed, as an albedo under sun and sky
uniform float u_water_blur_distance_m, u_water_dispersion;

// Radiance of what lies `thickness` metres of water behind the surface, blurred with the way (H12); red is bent less
// than blue.
vec3 through_plates(vec2 here, vec2 bent, float thickness) {
    float blurred = clamp(thickness / u_water_blur_distance_m, 0.0, 1.0);
    if (u_water_dispersion <= 0.0) return mix(plate(bent, 0.0), plate(bent, 1.0), blurred);
    vec3 light;
    for (int i = 0; i < 3; ++i) {
        vec2 at = mix(here, bent, 1.0 + 0.5 * u_water_dispersion * float(i - 1));
        light[i] = mix(plate(at, 0.0)[i], plate(at, 1.0)[i], blurred);
    }
    return light;
}
#endif

const float CREST_M = 0.6;  // of water before the sky where a river stands above the eye

// Colour and thickness of the land below, looked up where the wave bends the view; never from before the water. Where
// `higher` than an eye in the air, the sky is behind no more than a river's crest, elsewhere behind a sea.
bool sky_behind = false;  // of the pixel that was asked last
vec4 below(vec3 normal, float eye_depth, float away, bool higher) {
    ivec2 size = textureSize(under_eye_depth, 0), here = ivec2(gl_FragCoord.xy);
    vec2 bent = vec2(here) + 0.5;
    if (u_show_refraction) {
        float depth = texelFetch(under_eye_depth, here, 0).r - eye_depth;
        vec2 shift = vec2(dot(normal.xy, normalize(u_ray_x.xy + 1e-6)), dot(normal.xy, normalize(u_ray_y.xy + 1e-6)));
        shift *= 0.25 * u_water_bend * clamp(depth, 0.0, 3.0) / (eye_depth * u_pixel_angle);
        bent = clamp(bent + clamp(shift, -60.0, 60.0), vec2(0.5), vec2(size) - 0.5);
    }
    float depth = texelFetch(under_eye_depth, ivec2(bent), 0).r;
    if (depth <= eye_depth) {
        bent = vec2(here) + 0.5;
        depth = texelFetch(under_eye_depth, here, 0).r;
    }
    sky_behind = higher && depth <= 0.0;
    float thickness = depth > eye_depth ? (depth - eye_depth) * away / eye_depth : (depth > 0.0 ? 0.0 : higher ? CREST_M : 1e4);
#ifdef PLATE
    return vec4(through_plates(vec2(here) + 0.5, bent, thickness), thickness);
#else
    vec3 albedo = texelFetch(under_albedo, ivec2(bent), 0).rgb;
    return vec4(albedo * albedo, thickness);
#endif
}

uniform sampler2D u_caustics;
uniform bool u_caustics_on;
uniform float u_caustics_strength, u_caustics_tile_m, u_caustics_bend, u_caustics_depth_m;
const float CAUSTICS_TEXELS = 512.0, CAUSTICS_MEAN = 48.0 / 255.0;

const float RING_LENS_M = 0.75;  // how far a metre of water throws light aside where a ring is steep (H19): three times Snell

// Bright lines that waves draw on the bed: one still image, bent by a broad panning normal map (D08, H13). Mean 1. Deeper
// down they blur, and light has come from everywhere.
float caustics(vec2 xy, float depth, float pixel_m) {
#ifdef NO_CAUSTICS
    return 1.0;
#endif
    float strength = smoothstep(0.03, 0.4, depth) * exp(-depth / u_caustics_depth_m) * u_sun_direction.z;
    float lod = log2(max(pixel_m * CAUSTICS_TEXELS / u_caustics_tile_m, 1e-4));
    strength *= u_caustics_on ? u_caustics_strength * (1.0 - smoothstep(3.0, 6.0, lod)) : 0.0;
    if (strength < 0.01) return 1.0;
    vec2 at = xy / u_caustics_tile_m;
    // they pan by whole tiles a turn of their phase, or they would jump when that wraps
    vec2 one = textureLod(u_ripple, 0.31 * at + u_ripple_way[1].z * vec2(1.0, 1.0), 2.0).xy;
    vec2 two = textureLod(u_ripple, 0.23 * at.yx - u_ripple_way[2].z * vec2(1.0, -1.0) + 0.37, 2.0).yx;
    at += 0.055 * u_caustics_bend * (one - two);
    if (u_ring_count > 0) at += u_caustics_bend * RING_LENS_M * clamp(depth, 0.2, 2.0) * ring_slope(xy, pixel_m).xy / u_caustics_tile_m;
    float light = textureLod(u_caustics, at, max(lod, 0.0) + 0.7 * depth).r / CAUSTICS_MEAN;
    return max(1.0 + strength * (light - 1.0), 0.0);
}

// Light that comes back out of the water: from the bed and from the water itself. `sun` and `sky` are illuminance and
// irradiance on the surface; the surface's own losses in and out are Mobley's (Light and Water, 1994, ch. 10).
vec3 light_from_below(
    vec3 bed_albedo, float still_depth, vec2 bed_xy, float depth, float cosine, vec3 sun, vec3 sky, float pixel_m
) {
    float sun_up = max(u_sun_direction.z, 0.0);
#ifdef PLATE
    // a plate holds the bed's radiance in air, caustics in it: what albedo that is under this light
    vec3 bed = clamp(3.14159265 * bed_albedo / max(sun * sun_up + sky, vec3(1e-6)), 0.0, u_bed_most);
#else
    vec3 bed = bed_albedo * caustics(bed_xy, depth, pixel_m);
#endif
    vec3 albedo = water_albedo(bed, depth, cosine, max(sun_up, 0.25));
    // the sand of the swash is dark already: it is wet (lib/ground.glsl)
    vec3 out_of_water = mix(vec3(1.0), 0.54 / (1.0 - 0.48 * min(albedo, 1.0)), smoothstep(0.05, 0.5, still_depth));
    return albedo * out_of_water * (sun * sun_up * (1.0 - water_fresnel(sun_up, 0.0)) + 0.93 * sky) / 3.14159265;
}

// Air beaten into the water round foam makes it pale and greenish.
vec3 bubbles(vec3 light, Foam foam, vec3 sun, vec3 sky) {
    vec3 plume = vec3(0.20, 0.29, 0.29) * (sun * max(u_sun_direction.z, 0.0) + sky) / 3.14159265;
    return mix(light, plume, 0.5 * foam.bubbles);
}
