// How dense a cloud is at a place (Z01 to Z04, Z07, Z22). `h` is the place in the shell, 0 at its base, 1 at its top;
// `weather` coverage, precipitation and gradient coordinate there. Everything is read at a given mip level.
#include "level/shell.glsl"

uniform vec2 u_cloud_camera;       // east and north of the camera in the weather map, m
#include "level/cloud_noise.glsl"
#include "level/weather_map.glsl"

uniform vec4 u_cloud_drift;        // east and north that the air has moved: within a tile of the shape, of the detail
uniform vec4 u_cloud_way;          // the wind's way at the base, at the top
uniform vec3 u_cloud_rise;         // tiles that the detail has risen, that curl has wandered, turn of the shape
uniform float u_clouds_scale_m, u_clouds_detail_m, u_clouds_curl_m, u_clouds_erosion, u_clouds_curl, u_clouds_thin;
uniform float u_clouds_anvil, u_clouds_shear_m, u_clouds_extinction;
uniform bool u_cloud_terms_height, u_cloud_terms_coverage, u_cloud_terms_thin, u_cloud_terms_erode;
uniform bool u_cloud_terms_inverted, u_cloud_terms_curl;

const vec3 FBM = vec3(0.625, 0.25, 0.125);
const float LOWEST = 0.5;  // height of the smallest cloud against its curve
const float DETAIL_LOD = 0.5;  // its texels are finer than those of the shape
const float DENSE = 1.7;  // over one: from which part of the range on a cloud is as dense as it gets

float remap(float value, float low, float high, float to_low, float to_high) {
    return to_low + (value - low) / (high - low) * (to_high - to_low);
}

float shell_height(float altitude) { return (altitude - u_clouds_base_m) / (u_clouds_top_m - u_clouds_base_m); }

// Where the air at a place has come from since the base: tops are ahead (Z07).
vec2 cloud_sheared(vec2 xy, float h) {
    return xy - mix(u_cloud_way.xy, u_cloud_way.zw, h) * (u_clouds_shear_m * h);
}

vec4 cloud_weather(vec2 sheared) { return weather_map(u_cloud_camera + sheared); }

// Density by height of the type at gradient coordinate g; where coverage is small clouds are lower, so that they are
// domes and towers and no tables.
float cloud_height(float g, float h, float cover) {
    h /= LOWEST + (1.0 - LOWEST) * cover;
    if (h > 1.0) return 0.0;
    if (!u_cloud_terms_height) return step(0.0, h) * step(h, 1.0);
    return cloud_curve(vec2((h * 63.0 + 0.5) / 64.0, (g * 2.0 + 0.5) / 3.0));
}

// The low-frequency shape before anything else: Perlin-Worley dilated by the Worley fBm, 0 … 1.
float cloud_shape(vec2 sheared, float altitude, float lod) {
    vec3 at = vec3(sheared + u_cloud_camera - u_cloud_drift.xy, altitude) / u_clouds_scale_m;
    at.z += u_cloud_rise.z;
    vec4 noise = cloud_shape_noise(at, lod);
    return remap(noise.r, dot(noise.gba, FBM) - 1.0, 1.0, 0.0, 1.0);
}

// Coverage with the anvil's spreading top (GPU Pro 7, as research has it).
float cloud_cover(vec3 weather, float h) {
    if (!u_cloud_terms_coverage) return 0.6;
    float spread = mix(1.0, 1.0 - 0.5 * u_clouds_anvil, clamp(weather.z * 2.0 - 1.0, 0.0, 1.0));
    return pow(weather.x, clamp(remap(h, 0.7, 0.8, 1.0, spread), spread, 1.0));
}

// From which shape × height on there is cloud, so that a coverage covers about that part of the sky seen from above,
// erosion taken off: a fit to counted columns (tests/test_cloud_shape.py counts them again).
float cloud_threshold(float cover) {
    float high = cover * cover * cover;
    return 1.0 - (0.155 * min(8.0 * cover, 1.0) + 0.32 * cover + 0.145 * high * high);
}

// What the cheap steps ask: shape × height × coverage, thinned at the bottom; 0 where there is surely no cloud. `slack`
// lets what nearly is one count.
float cloud_base(vec2 sheared, float altitude, float h, vec3 weather, float lod, float slack) {
    float cover = cloud_cover(weather, h), height = cloud_height(weather.z, h, weather.x);
    if (cover * height <= 0.0) return 0.0;
    float base = remap(cloud_shape(sheared, altitude, lod) * height, cloud_threshold(cover) - slack, 1.0, 0.0, 1.0);
    if (base <= 0.0) return 0.0;
    base *= sqrt(cover);  // the talk multiplies by it: few clouds, but not thin ones
    if (u_cloud_terms_thin) base *= mix(1.0, clamp(h * 5.0, 0.0, 1.0), u_clouds_thin);
    return base;
}

// The noise that edges are eroded by.
float cloud_detail(vec2 sheared, float altitude, float h, float lod) {
    vec3 at = vec3(sheared + u_cloud_camera - u_cloud_drift.zw, altitude) / u_clouds_detail_m;
    at.z -= u_cloud_rise.x;
    if (u_cloud_terms_curl) {
        vec2 place = (sheared + u_cloud_camera - u_cloud_drift.xy) / u_clouds_curl_m;
        vec3 curl = cloud_curl_noise(place + vec2(u_cloud_rise.y, 0.5 * u_cloud_rise.y)) - 0.5;
        at += curl * (u_clouds_curl * (1.0 - clamp(h, 0.0, 1.0)));
    }
    return cloud_detail_noise(at, max(lod + DETAIL_LOD, 0.0)).a;
}

// Extinction 1/m of a base density: edges eroded, the inside whole.
float cloud_eroded(float base, float detail, float h) {
    if (base <= 0.0) return 0.0;
    if (!u_cloud_terms_erode) return u_clouds_extinction * clamp(base * DENSE, 0.0, 1.0);
    float billows = 1.0 - detail;
    float cut = u_cloud_terms_inverted ? mix(detail, billows, clamp(h * 10.0, 0.0, 1.0)) : billows;
    float eroded = remap(base, cut * u_clouds_erosion, 1.0, 0.0, 1.0);
    return u_clouds_extinction * clamp(eroded * DENSE, 0.0, 1.0);
}
