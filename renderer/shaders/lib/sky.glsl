// Sky and sun from the table that renderer/sky_table.py works out. Radiance in kcd/m², illuminance in klux.
#include "lib/noise.glsl"

uniform sampler2D u_sky;            // rows: sqrt(elevation / 90°), columns: azimuth from the sun, 0 … 180°
uniform vec3 u_sun_direction;       // towards the sun
uniform vec3 u_sun_illuminance;     // on a plane facing it, at sea level
uniform vec3 u_sky_sh[9];           // irradiance, x towards the sun's azimuth

const float SKY_ROWS = 96.0, SKY_COLUMNS = 64.0;
const float SUN_RADIUS = 0.00465;   // rad

// Horizontal unit vector towards the sun.
vec2 sun_heading() {
    float flat_length = length(u_sun_direction.xy);
    return flat_length > 1e-4 ? u_sun_direction.xy / flat_length : vec2(0.0, 1.0);
}

vec2 sky_uv(vec3 dir) {
    float elevation = asin(clamp(dir.z, 0.0, 1.0)) * 0.636619772;
    float flat_length = max(length(dir.xy), 1e-5);
    float away = acos(clamp(dot(dir.xy, sun_heading()) / flat_length, -1.0, 1.0)) * 0.318309886;
    vec2 size = vec2(SKY_COLUMNS, SKY_ROWS);
    return (vec2(away, sqrt(elevation)) * (size - 1.0) + 0.5) / size;
}

// Radiance of the clear sky without the disc; below the horizon that of the horizon.
vec3 sky_radiance(vec3 dir) { return textureLod(u_sky, sky_uv(dir), 0.0).rgb; }

// The same averaged over a lobe, for rough reflections.
vec3 sky_radiance_rough(vec3 dir, float roughness) {
    return textureLod(u_sky, sky_uv(dir), 5.0 * clamp(roughness, 0.0, 1.0)).rgb;
}

vec3 sun_radiance() { return u_sun_illuminance; }

// The disc with limb darkening (Hestroffer & Magnan 1998), clamped to what a half float holds.
vec3 sun_disc(vec3 dir) {
    float apart = length(dir - u_sun_direction);
    float r = apart / SUN_RADIUS;
    float edge = 1.0 - smoothstep(0.92, 1.12, r);
    vec3 limb = pow(vec3(max(1.0 - r * r, 1e-3)) , 0.5 * vec3(0.397, 0.503, 0.652));
    vec3 disc = u_sun_illuminance / (3.14159265 * SUN_RADIUS * SUN_RADIUS) * limb * edge;
    return min(disc, vec3(30000.0)) * step(0.0, dir.z + 0.02);
}

// Faint high cirrus: streaks combed along one way, thin towards the zenith, gone at night. Adds to sky_radiance.
vec3 sky_cirrus(vec3 dir) {
    if (dir.z < 0.015) return vec3(0.0);
    vec2 at = dir.xy / (dir.z + 0.10);
    vec4 broad = textureLod(u_noise, at * vec2(0.050, 0.085) + 0.13, 1.0);
    vec2 combed = vec2(at.x * 0.10 + at.y * 0.05, at.y * 0.42 - at.x * 0.17) + 0.05 * broad.gr;
    vec4 streak = textureLod(u_noise, combed, 1.5);
    vec4 wisp = textureLod(u_noise, combed * 2.7 + 0.41, 2.0);
    float cover = smoothstep(0.48, 0.95, broad.r * 0.55 + streak.g * 0.30 + wisp.g * 0.22);
    cover *= (0.35 + 0.65 * streak.r) * smoothstep(0.015, 0.16, dir.z);
    // ice scatters forward: brighter near the sun
    float cosine = dot(dir, u_sun_direction);
    float phase = 0.055 + 0.30 * pow(max(cosine, 0.0), 6.0) + 1.1 * pow(max(cosine, 0.0), 60.0);
    vec3 light = u_sun_illuminance * phase + u_sky_sh[0] * (0.282095 / 3.14159265);
    return cover * 0.36 * light;
}

// Irradiance of sky and bounced ground light on a plane (order-2 harmonics).
vec3 sky_irradiance(vec3 normal) {
    vec2 heading = sun_heading();
    vec3 n = vec3(dot(normal.xy, heading), heading.x * normal.y - heading.y * normal.x, normal.z);
    vec3 e = u_sky_sh[0] * 0.282095 + u_sky_sh[2] * (0.488603 * n.z) + u_sky_sh[3] * (0.488603 * n.x);
    e += u_sky_sh[6] * (0.315392 * (3.0 * n.z * n.z - 1.0)) + u_sky_sh[7] * (1.092548 * n.x * n.z);
    e += u_sky_sh[8] * (0.546274 * (n.x * n.x - n.y * n.y));
    return max(e, vec3(0.0));
}
