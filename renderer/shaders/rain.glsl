// Rain and snow over the picture: curtains under the clouds far off, drops and flakes near the camera (Z18, Z24).
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/fog.glsl"
#include "level/rain.glsl"
#include "lib/rain_near.glsl"
uniform sampler2D g_eye_depth;
uniform sampler2D u_clouds;
uniform float u_clouds_base_m, u_rain_shafts;
uniform vec2 u_rain_drift;     // metres that the curtains' folds have moved
uniform vec2 u_rain_trail;     // metres that rain is behind its cloud, a metre below the base
uniform int u_shaft_steps;
out vec4 out_radiance;         // blended: light + transmittance × what is there

const float SHAFT_REACH_M = 34000.0, FOLD_M = 7800.0, SNOW_THICK = 3.0;

// Extinction 1/m about a place, over a step: 0.21 km⁻¹ R^0.68 (Atlas 1953), folded by what the cloud sheds more and less of.
float shaft_extinction(vec2 xy, float height, float step_m) {
    vec2 source = xy - u_rain_trail * (u_clouds_base_m - height);
    float rate = falls_at(source);
    if (rate <= 0.0) return 0.0;
    vec2 at = (source - u_rain_drift) / FOLD_M;
    float lod = clamp(log2(step_m / 240.0), 0.0, 3.0);  // folds finer than the steps would only be noise
    float fold = textureLod(u_noise, at, 1.0 + lod).r + 0.6 * textureLod(u_noise, at * 3.7, 1.5 + 1.5 * lod).g;
    fold = smoothstep(0.6, 1.0, fold);
    float under = 1.0 - smoothstep(0.92, 1.08, height / u_clouds_base_m);
    return 0.00021 * pow(rate, 0.68) * mix(0.12, 2.0, fold) * under * mix(1.0, SNOW_THICK, snow_share(height));
}

// Light of the curtains up to a distance: premultiplied, transmittance.
vec4 shafts(vec3 dir, float eye, float away_m) {
    float top = 1.06 * u_clouds_base_m, from = 0.0, to = min(away_m, SHAFT_REACH_M);
    if (eye > top) {
        if (dir.z >= 0.0) return vec4(0.0, 0.0, 0.0, 1.0);
        from = (top - eye) / dir.z;
    } else if (dir.z > 0.0) to = min(to, (top - eye) / dir.z);
    if (dir.z < 0.0) to = min(to, eye / -dir.z);
    if (to <= from) return vec4(0.0, 0.0, 0.0, 1.0);
    float through = 1.0, weight = 0.0, mean_m = 0.0, length_m = to - from;
    for (int i = 0; i < u_shaft_steps; ++i) {
        // steps grow with the distance
        float a = float(i) / float(u_shaft_steps), b = float(i + 1) / float(u_shaft_steps), mid = 0.5 * (a + b);
        float t = from + length_m * mid * mid;
        float step_m = length_m * (b * b - a * a);
        float depth = shaft_extinction(u_camera.xy + dir.xy * t, eye + dir.z * t, step_m) * step_m;
        float part = exp(-u_rain_shafts * depth);
        weight += through * (1.0 - part);
        mean_m += through * (1.0 - part) * t;
        through *= part;
    }
    if (weight <= 0.0) return vec4(0.0, 0.0, 0.0, 1.0);
    mean_m /= weight;
    float cosine = dot(dir, u_sun_direction);
    vec3 light = 0.30 * (sky_irradiance(vec3(0.0, 0.0, 1.0)) + sky_irradiance(vec3(0.0, 0.0, -1.0))) / PI_SKY;
    light += u_sun_mean * (0.03 + 0.30 * pow(max(cosine, 0.0), 12.0));
    light = fog(light, dir, eye, eye + dir.z * mean_m, mean_m);
    return vec4(light * weight, through);
}

void main() {
    vec3 ray = pixel_ray(), dir = normalize(ray);
    float eye = u_camera.z - u_level_sea_level_m, depth = texelFetch(g_eye_depth, ivec2(gl_FragCoord.xy), 0).r;
    float away = depth > 0.0 ? depth * length(ray) : 1e9;
    vec4 sum = shafts(dir, eye, away);
    if (eye > u_clouds_base_m) {
        vec4 over = textureLod(u_clouds, gl_FragCoord.xy / u_size, 0.0);
        sum = vec4(sum.rgb * over.a, mix(1.0, sum.a, over.a));
    }
    float rate = eye < u_clouds_base_m ? falls_at(u_camera.xy) : 0.0;
    if (rate > 0.0) {
        float hidden = rain_near(dir, rate, snow_share(eye), away, u_pixel_angle);
        vec3 light = sky_irradiance(vec3(0.0, 0.0, 1.0)) / PI_SKY * mix(0.85, 1.0, snow_share(eye));
        sum = vec4(sum.rgb * (1.0 - hidden) + light * hidden, sum.a * (1.0 - hidden));
    }
    if (sum.a >= 1.0) discard;
    out_radiance = sum;
}
#endif
