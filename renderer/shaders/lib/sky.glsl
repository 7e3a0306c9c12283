// Sky, sun and cloud layer from what renderer/sky_light.py works out. Radiance in kcd/m², illuminance in klx, both times
// the frame's unit. A direction below the horizon gets the horizon.
#include "level/noise.glsl"

uniform sampler2D u_sky;            // rows: sqrt(elevation / 90°), columns: azimuth from the sun, 0 … 180°
uniform vec3 u_sun_direction;       // towards the sun, or the moon
uniform vec3 u_sun_illuminance;     // on a plane facing it, at sea level, under the clouds
uniform vec3 u_sun_disc;            // the same without clouds
uniform vec3 u_sky_sh[9];           // irradiance, x towards the sun's azimuth
uniform vec3 u_deck;                // the cloud layer at the zenith
uniform vec3 u_sun_mean;            // the same on all the land together: clouds in volume shade parts of it
uniform float u_light_cloud_cover, u_light_cloud_depth;
uniform float u_sky_cover;          // share of the sky that clouds of any kind hide

const float SKY_ROWS = 96.0, SKY_COLUMNS = 64.0;
const float SUN_RADIUS = 0.00465;   // rad
const float PI_SKY = 3.14159265359;

// Horizontal unit vector towards the sun.
vec2 sun_heading() {
    float flat_length = length(u_sun_direction.xy);
    return flat_length > 1e-4 ? u_sun_direction.xy / flat_length : vec2(0.0, 1.0);
}

// Azimuth from the sun and square root of the elevation, 0 … 1 each.
vec2 sky_place(vec3 dir) {
    float elevation = asin(clamp(dir.z, 0.0, 1.0)) * 0.636619772;
    float flat_length = max(length(dir.xy), 1e-5);
    return vec2(acos(clamp(dot(dir.xy, sun_heading()) / flat_length, -1.0, 1.0)) * 0.318309886, sqrt(elevation));
}

vec3 sky_clear(vec3 dir) {
    vec2 size = vec2(SKY_COLUMNS, SKY_ROWS);
    return textureLod(u_sky, (sky_place(dir) * (size - 1.0) + 0.5) / size, 0.0).rgb;
}

// The cloud layer without its structure: CIE overcast sky, a third as bright at the horizon as at the zenith.
vec3 deck_radiance(vec3 dir) { return u_deck * ((1.0 + 2.0 * max(dir.z, 0.0)) / 3.0); }

// Mean radiance of the sky without the disc.
vec3 sky_radiance(vec3 dir) {
    vec3 clear = sky_clear(dir);
    return u_sky_cover > 0.0 ? mix(clear, deck_radiance(dir), u_sky_cover) : clear;
}

vec3 sun_radiance() { return u_sun_illuminance; }

// The layer's structure: x how much of it stands in the way, y its brightness against the mean. Billows hang from it:
// thick parts are dark below, and their rims, where more light comes through, are bright.
vec2 deck_structure(vec3 dir) {
    float low = max(dir.z, 0.0);
    vec2 at = dir.xy / (low + 0.10);
    float blur = clamp(1.2 - 7.0 * low, 0.0, 1.2);  // far off the billows stand too close to be told apart
    vec4 broad = textureLod(u_noise, at * 0.017 + 0.31, 0.0);
    vec2 bent = turn(at, 0.42, 0.907) * 0.052 + 0.02 * (broad.gr - 0.5);
    vec4 cell = textureLod(u_noise, bent, 0.5 + blur);
    vec4 puff = textureLod(u_noise, turn(bent, 0.6, 0.8) * 2.3 + 0.012 * (cell.rg - 0.5), 0.5 + blur);
    vec4 fine = textureLod(u_noise, bent * 5.7 + 0.01 * (puff.rg - 0.5), 0.5 + blur);
    float field = 0.50 * broad.r + 0.27 * cell.r + 0.15 * puff.r + 0.08 * fine.r;
    float thick = smoothstep(0.24, 0.76, field);  // spread again: the mean of even fields crowds in the middle
    float clear = 1.0 - u_light_cloud_cover, closed = smoothstep(0.85, 1.0, u_light_cloud_cover);
    // rims are torn by the finer billows, and the further in from them the deeper is the cloud
    float torn = thick + (0.22 * (puff.r - 0.5) + 0.16 * (0.5 - puff.a) + 0.14 * (fine.g - 0.5)) * (1.0 - closed);
    float cover = mix(smoothstep(clear - 0.10, clear + 0.12, torn), 1.0, closed);
    float inner = clamp((torn - clear) / max(u_light_cloud_cover, 0.2), 0.0, 1.0);
    float depth = smoothstep(3.0, 70.0, u_light_cloud_depth);
    float billow = 0.55 * (0.5 - puff.a) + 0.30 * (0.5 - fine.a) + 0.35 * (puff.g - 0.5);
    float contrast = mix(0.8, 3.4, depth) * mix(0.45, 1.0, closed);  // from all sides light comes into a lone cloud
    float bright = exp2(contrast * (0.45 - inner)) * (1.0 + mix(0.20, 0.75, depth) * billow);
    float seen = smoothstep(0.0, 0.10, low);
    return vec2(mix(u_light_cloud_cover, cover, smoothstep(0.0, 0.08, low)), mix(1.0, clamp(bright, 0.2, 2.2), seen));
}

// Faint high cirrus: streaks combed along one way, thin towards the zenith, gone at night. Adds to the clear sky.
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
    vec3 light = u_sun_illuminance * phase + u_sky_sh[0] * (0.282095 / PI_SKY);
    return cover * 0.36 * light;
}

uniform float u_star_light;  // radiance of the brightest, 0 by day

// Hash of a cell to three numbers 0 … 1 (Jarzynski & Olano 2020, pcg3d).
vec3 cell_hash(ivec2 cell) {
    uvec3 v = uvec3(uint(cell.x), uint(cell.y), 77u) * 1664525u + 1013904223u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    return vec3(v >> 8u) / 16777216.0;
}

// A star somewhere in each cell of a map of the upper half of the sky, dim ones far more often than bright ones.
vec3 sky_stars(vec3 dir, float pixel_angle) {
    if (u_star_light <= 0.0 || dir.z < 0.02) return vec3(0.0);
    const float CELLS = 90.0, MARGIN = 0.12;
    vec2 at = dir.xy / (1.0 + dir.z) * CELLS;
    ivec2 cell = ivec2(floor(at));
    vec3 place = cell_hash(cell), kind = cell_hash(cell + 4096);
    vec2 off = (at - vec2(cell) - MARGIN - (1.0 - 2.0 * MARGIN) * place.xy) * ((1.0 + dir.z) / CELLS);
    float size = max(0.6 * pixel_angle, 0.0004);
    float spot = exp(-dot(off, off) / (size * size)) * (0.0004 * 0.0004) / (size * size);
    float bright = pow(kind.x, 14.0) * step(0.35, kind.z);
    return mix(vec3(1.25, 1.0, 0.75), vec3(0.8, 0.95, 1.3), kind.y) * (u_star_light * spot * bright)
           * smoothstep(0.02, 0.35, dir.z);
}

// The sky as it is seen and mirrored, disc excepted; `cirrus` 0 or 1.
vec3 sky_seen(vec3 dir, float cirrus) {
    vec3 sky = sky_clear(dir);
    if (cirrus > 0.0) sky += sky_cirrus(dir) * cirrus;
    if (u_light_cloud_cover <= 0.0) return sky;
    vec2 deck = deck_structure(dir);
    // a thin layer glows round the sun
    float glow = pow(max(dot(dir, u_sun_direction), 0.0), 12.0) * exp(-0.05 * u_light_cloud_depth);
    return mix(sky, deck_radiance(dir) * deck.y * (1.0 + 1.2 * glow), deck.x);
}

// The disc with limb darkening (Hestroffer & Magnan 1998), clamped to what a half float holds, behind the clouds.
vec3 sun_disc(vec3 dir) {
    float r = length(dir - u_sun_direction) / SUN_RADIUS;
    if (r > 1.2) return vec3(0.0);
    float edge = 1.0 - smoothstep(0.92, 1.12, r);
    vec3 limb = pow(vec3(max(1.0 - r * r, 1e-3)), 0.5 * vec3(0.397, 0.503, 0.652));
    vec3 disc = u_sun_disc / (PI_SKY * SUN_RADIUS * SUN_RADIUS) * limb * edge;
    float through = u_light_cloud_cover > 0.0 ? 1.0 - deck_structure(dir).x : 1.0;
    through += (1.0 - through) * exp(-u_light_cloud_depth / max(u_sun_direction.z, 0.05));
    return min(disc * through, vec3(30000.0)) * step(0.0, dir.z + 0.02);
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
