#include "level/clouds.glsl"

// The sky's weather over world metres: coverage, precipitation, type (0 stratus, 0.5 cumulus, 1 cumulonimbus), weight of
// the paint in it.
vec4 weather_at(vec2 xy) { return weather_map(xy); }

// How dense the cloud is at a place, z in metres over the still sea: extinction in 1/m, 0 in clear air.
float cloud_density(vec3 position) {
    float h = shell_height(position.z);
    if (h <= 0.0 || h >= 1.0) return 0.0;
    vec2 sheared = cloud_sheared(position.xy - u_cloud_camera, h);
    float base = cloud_base(sheared, position.z, h, cloud_weather(sheared).xyz, 0.0, 0.0);
    if (base <= 0.0) return 0.0;
    return cloud_eroded(base, cloud_detail(sheared, position.z, h, 0.0), h);
}
