// What the noises and curves of clouds say at a place in tiles.
#include "kit/texels.glsl"
#include "kit/cubes.glsl"

uniform sampler2D u_cloud_shape;        // Perlin-Worley, three octaves of inverted Worley noise; a cube
uniform sampler2D u_cloud_detail;       // three finer ones and their fBm; a cube
uniform sampler2D u_cloud_detail_half;  // the same at half the side
uniform sampler2D u_cloud_curl;         // a field without divergence, about one half
uniform sampler2D u_cloud_profile;      // density by height, rows stratus, cumulus, cumulonimbus

const int SHAPE_SIDE = 128, SHAPE_COLUMNS = 16, DETAIL_SIDE = 32, DETAIL_COLUMNS = 8;  // as sky_data.py folds them

vec4 cloud_shape_noise(vec3 at, float lod) { return KIT_cube(u_cloud_shape, SHAPE_SIDE, SHAPE_COLUMNS, at); }

vec4 cloud_detail_noise(vec3 at, float lod) {
    vec4 half_as_fine = KIT_cube(u_cloud_detail_half, DETAIL_SIDE / 2, DETAIL_COLUMNS, at);
    return mix(KIT_cube(u_cloud_detail, DETAIL_SIDE, DETAIL_COLUMNS, at), half_as_fine, min(lod, 1.0));
}

vec3 cloud_curl_noise(vec2 at) { return KIT_tiled(u_cloud_curl, at).rgb; }

// `at` 0 … 1 along a curve and from row to row, texels at their centres.
float cloud_curve(vec2 at) { return KIT_clamped(u_cloud_profile, at).r; }
