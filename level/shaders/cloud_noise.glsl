// What the noises and curves of clouds say at a place in tiles; level/cloud_noise.py and level/cloud_profile.py make them.

uniform sampler3D u_cloud_shape;   // Perlin-Worley, three octaves of inverted Worley noise
uniform sampler3D u_cloud_detail;  // three finer ones and their fBm
uniform sampler2D u_cloud_curl;    // a field without divergence, about one half
uniform sampler2D u_cloud_profile; // density by height, rows stratus, cumulus, cumulonimbus (Z03)

vec4 cloud_shape_noise(vec3 at, float lod) { return textureLod(u_cloud_shape, at, lod); }

vec4 cloud_detail_noise(vec3 at, float lod) { return textureLod(u_cloud_detail, at, lod); }

vec3 cloud_curl_noise(vec2 at) { return textureLod(u_cloud_curl, at, 0.0).rgb; }

// `at` 0 … 1 along a curve and from row to row, texels at their centres.
float cloud_curve(vec2 at) { return textureLod(u_cloud_profile, at, 0.0).r; }
