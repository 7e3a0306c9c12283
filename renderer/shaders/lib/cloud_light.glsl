// Light in clouds (Z08 to Z11, Z15, Z17): how much of the sun gets to a place, how it is scattered on.
#include "lib/sky.glsl"
#include "level/clouds.glsl"

uniform vec3 u_cloud_sun, u_cloud_above, u_cloud_below;  // sun klx; light from the sky and the ground
uniform float u_clouds_forward, u_clouds_backward, u_clouds_silver, u_clouds_spread, u_clouds_powder;
uniform float u_clouds_rain_absorption, u_clouds_ambient;
uniform bool u_cloud_terms_cone, u_cloud_terms_far, u_cloud_terms_beer, u_cloud_terms_phase, u_cloud_terms_powder;
uniform bool u_cloud_terms_rain, u_cloud_terms_ambient;

const float PI_CLOUD = 3.14159265359;
const float DIFFUSE = 7.0;  // at a spread of one half a wall of cloud in the sun is four fifths as bright as a white one
const int CONE = 5;
const float CONE_M[5] = float[5](35.0, 60.0, 100.0, 170.0, 290.0);  // lengths of the cone's pieces
const float FAR_M = 1300.0;                                         // length that the far sample stands for
// unit vectors that add up to about nothing, by which the samples of the cone stand off its axis
const vec3 CONE_OFF[5] = vec3[5](vec3(0.68, 0.35, 0.64), vec3(-0.74, 0.52, -0.43), vec3(0.12, -0.91, 0.39),
                                 vec3(-0.49, -0.31, -0.81), vec3(0.47, 0.56, -0.68));

// Henyey & Greenstein 1941; its integral over all directions is 1.
float henyey_greenstein(float cosine, float g) {
    float square = g * g;
    return (1.0 - square) / (4.0 * PI_CLOUD * pow(max(1.0 + square - 2.0 * g * cosine, 1e-4), 1.5));
}

// Two lobes by their shares, so that the integral stays 1 (the talk's maximum of two lobes has up to 1.5).
float cloud_phase(float cosine) {
    if (!u_cloud_terms_phase) return 0.25 / PI_CLOUD;
    return mix(henyey_greenstein(cosine, u_clouds_backward), henyey_greenstein(cosine, u_clouds_forward), u_clouds_silver);
}

// What of the sun's light is left after an optical depth (Z08).
float cloud_beer(float depth) { return u_cloud_terms_beer ? exp(-depth) : 1.0; }

// Light scattered many times, without a direction any more: thick cloud sends back four fifths of it, and lets through
// what two streams do (asymmetry 0.7).
float cloud_diffuse(float depth) {
    float through = u_cloud_terms_beer ? 1.0 / (1.0 + 0.22 * depth) : 1.0;
    return u_clouds_spread * DIFFUSE / (4.0 * PI_CLOUD) * through;
}

// The powder effect, only where the view goes the way of the light (Z10): 2 (1 − exp(−2 d)) there, 1 towards the sun.
float cloud_powder(float depth, float cosine) {
    if (!u_cloud_terms_powder) return 1.0;
    return mix(1.0, 2.0 * (1.0 - exp(-2.0 * depth)), u_clouds_powder * clamp(0.5 - 0.5 * cosine, 0.0, 1.0));
}

// Extinction at a place, without the detail noise where that is cheap enough.
float cloud_extinction(vec3 p, float altitude, float lod, const bool cheap) {
    float h = shell_height(altitude);
    if (h <= 0.0 || h >= 1.0) return 0.0;
    vec2 sheared = cloud_sheared(p.xy, h);
    float base = cloud_base(sheared, altitude, h, cloud_weather(sheared).xyz, lod, 0.0);
    if (base <= 0.0) return 0.0;
    return cloud_eroded(base, cheap ? 0.5 : cloud_detail(sheared, altitude, h, lod), h);
}

// Optical depth towards the sun: five samples in a cone and one far away (Z15).
float cloud_sun_depth(vec3 p, float altitude, float lod, const bool cheap) {
    float depth = 0.0, along = 0.0;
    int count = u_cloud_terms_cone ? CONE : 0;
    for (int i = 0; i < count; ++i) {
        float at = along + 0.5 * CONE_M[i];
        vec3 off = u_sun_direction * at + CONE_OFF[i] * (0.25 * at);
        depth += cloud_extinction(p + off, altitude + off.z, lod, cheap) * CONE_M[i];
        along += CONE_M[i];
    }
    if (!u_cloud_terms_far) return depth;
    // what of its length is in the shell: it would else be gone at once where it leaves at the top
    float room = u_clouds_top_m - altitude - along * u_sun_direction.z;
    float inside = FAR_M * clamp(room / max(FAR_M * u_sun_direction.z, 1.0), 0.0, 1.0);
    vec3 off = u_sun_direction * (along + 0.5 * inside);
    return depth + cloud_extinction(p + off, altitude + off.z, lod + 1.0, true) * inside;
}

// Share of light that isn't swallowed.
float cloud_albedo(float precipitation) {
    return u_cloud_terms_rain ? 1.0 - 0.15 * u_clouds_rain_absorption * precipitation : 1.0;
}

// Radiance that a place scatters into the view, per unit of its own optical depth.
vec3 cloud_source(vec3 p, float altitude, float h, float precipitation, float cosine, float phase, float lod, const bool cheap) {
    float swallowed = u_cloud_terms_rain ? 1.0 + 2.0 * u_clouds_rain_absorption * precipitation : 1.0;
    float depth = cloud_sun_depth(p, altitude, lod, cheap) * swallowed;
    vec3 light = u_cloud_sun * ((cloud_beer(depth) * phase + cloud_diffuse(depth)) * cloud_powder(depth, cosine));
    if (u_cloud_terms_ambient) {
        float above = 0.3 + 0.7 * clamp(h * 1.4 - 0.1, 0.0, 1.0);
        vec3 dark = mix(vec3(1.0), vec3(1.0 - 0.75 * u_clouds_rain_absorption), precipitation * float(u_cloud_terms_rain));
        light += mix(u_cloud_below, u_cloud_above, above) * u_clouds_ambient * dark;
    }
    return light * cloud_albedo(precipitation);
}
