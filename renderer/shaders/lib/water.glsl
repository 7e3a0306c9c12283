// Light in water: ripples, the colour of depth, the mirror of a rough sea, light through crests (L07).
#include "level/noise.glsl"
#include "level/wind.glsl"

uniform sampler2D u_ripple;      // slope east, slope north, slope², height; total variance of the slope is 1
uniform vec4 u_ripple_way[3];    // cosine, sine of the way it goes; offset in tiles, wrapped on the CPU
uniform vec2 u_ripple_size[3];   // tile_m, share of the slope (root of the mean square)
uniform vec3 u_ripple_gain;      // slope along and across the wind for a texture's 1; mean square of both
uniform vec3 u_absorb;           // 1/m, level/water_optics.py
uniform vec3 u_backscatter;      // 1/m, the light that turns back
uniform float u_water_crest_light;

const float RIPPLE_TEXELS = 256.0;
const float WATER_INDEX = 1.333;
const float WATER_F0 = 0.0204;

const vec2 GUSTS_FROM_M = vec2(150.0, 800.0);
const float GUST_TILE_M = 1500.0, GUSTINESS = 1.7;
const vec2 TILE_PIXELS = vec2(10.0, 30.0);  // a tile is gone below, whole above: smaller ones would show as a lattice

// Small waves: xy slope, z the variance of the slope that a pixel of this size can't show. What fades of a scale counts
// to the variance: the mean of slope² over a tile is its share.
vec3 water_ripples(vec2 xy, float pixel_m) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 3; ++i) {
        vec4 way = u_ripple_way[i];
        vec2 size = u_ripple_size[i];
        vec2 uv = vec2(way.x * xy.x + way.y * xy.y, way.x * xy.y - way.y * xy.x) / size.x + way.zw;
        vec4 v = textureLod(u_ripple, uv, log2(max(pixel_m * RIPPLE_TEXELS / size.x, 1e-4)));
        float whole = smoothstep(TILE_PIXELS.x, TILE_PIXELS.y, size.x / max(pixel_m, 1e-4));
        vec2 slope = v.xy * size.y * whole;
        sum.xy += vec2(way.x * slope.x - way.y * slope.y, way.y * slope.x + way.x * slope.y);
        sum.z += mix(1.0, max(v.z - dot(v.xy, v.xy), 0.0), whole * whole) * size.y * size.y;
    }
    vec2 across = vec2(-u_wind_way.y, u_wind_way.x);
    vec2 slope = dot(sum.xy, u_wind_way) * u_ripple_gain.x * u_wind_way + dot(sum.xy, across) * u_ripple_gain.y * across;
    return vec3(slope, sum.z * u_ripple_gain.z);
}

// Gusts and slicks: how much of the ripples' slope² stands at a place, 1 on the whole. They lie along the wind and show
// as bright and dark patches in the glitter from afar.
float water_gusts(vec2 xy, float away, float pixel_m) {
    float far = smoothstep(GUSTS_FROM_M.x, GUSTS_FROM_M.y, away);
    if (far <= 0.0) return 1.0;
    vec2 way = vec2(dot(xy, u_wind_way) * 0.45, u_wind_way.x * xy.y - u_wind_way.y * xy.x);
    vec4 noise = noise_at(way, GUST_TILE_M, 2.0 * pixel_m);
    return max(1.0 + far * GUSTINESS * (dot(noise.rga, vec3(0.4, 0.25, 0.35)) - 0.5), 0.3);
}

// Roughness of a surface whose unseen slopes have this variance: alpha² = mean square slope (Cox & Munk 1954).
float water_roughness(float roughness, float variance) {
    float alpha = roughness * roughness;
    return clamp(sqrt(sqrt(alpha * alpha + variance)), 0.02, 1.0);
}

// Mean Fresnel reflectance of a rough sea (Bruneton, Neyret & Holzschuch 2010, eq. 8), sigma² the slope's variance.
float water_fresnel(float cosine, float roughness) {
    float sigma = min(roughness * roughness * 0.7071, 0.6);
    float m = 1.0 - clamp(cosine, 0.0, 1.0);
    return WATER_F0 + (1.0 - WATER_F0) * pow(m, 5.0 * exp(-2.69 * sigma)) / (1.0 + 22.7 * pow(sigma, 1.5));
}

// Cosine of the refracted ray below the surface.
float water_cosine(float cosine) {
    float sine2 = (1.0 - cosine * cosine) / (WATER_INDEX * WATER_INDEX);
    return sqrt(max(1.0 - sine2, 0.0));
}

#ifdef RIVERS
uniform vec3 u_river_absorb, u_river_back;  // what a river's water adds, 1/m
float river_water = 0.0;                    // share of it at this pixel
vec3 water_backscatter() { return u_backscatter + river_water * u_river_back; }
vec3 water_attenuation() { return u_absorb + u_backscatter + river_water * (u_river_absorb + u_river_back); }
#else
vec3 water_backscatter() { return u_backscatter; }
vec3 water_attenuation() { return u_absorb + u_backscatter; }
#endif

// Light that survives `path_m` of water.
vec3 water_transmittance(float path_m) { return exp(-water_attenuation() * max(path_m, 0.0)); }

// What the water column reflects by itself when bottomless (Gordon 1975: about 0.33 b / (a + b)).
vec3 water_deep_albedo() { return 0.33 * water_backscatter() / water_attenuation(); }

// The artist's table (level/water_table.py): row 0 what is left, row 1 what is added, after that many metres.
#include "level/tables.glsl"
uniform bool u_table_on;

vec3 water_table(float metres, int row) {
    vec2 size = vec2(textureSize(u_tables, 0));
    float at = clamp(metres / 200.0, 0.0, 1.0) * (size.x - 1.0) + 0.5;
    return textureLod(u_tables, vec2(at / size.x, (float(row) + 0.5) / size.y), 0.0).rgb;
}

// Albedo of water `depth_m` deep over a bed, seen and lit at these cosines (above the surface): Lee et al. 1998, eq. 9.
// Multiply by the irradiance on the surface; Fresnel is not in it.
vec3 water_albedo(vec3 bed_albedo, float depth_m, float view_cosine, float light_cosine) {
    float path = depth_m * (1.0 / water_cosine(light_cosine) + 1.0 / water_cosine(view_cosine));
    if (u_table_on) return bed_albedo * water_table(0.5 * path, 0) + water_table(0.5 * path, 1);
    vec3 through = water_transmittance(path);
    return water_deep_albedo() * (1.0 - through) + bed_albedo * through;
}

// Light that enters the far side of a wave and leaves it towards the eye, per unit of sun: strongest looking into the
// sun at a raised, steep, thin face; none with the sun behind. `lift01` is the height over the still sea against the
// largest. Never more than half of what enters.
vec3 water_crest_light(float lift01, vec3 normal, vec3 to_eye, vec3 to_sun) {
    vec2 sun = to_sun.xy / max(length(to_sun.xy), 1e-4), eye = to_eye.xy / max(length(to_eye.xy), 1e-4);
    float into_sun = saturate(-0.1 - 1.1 * dot(sun, eye));
    // the face that looks at the eye; its back looks at the sun
    float face = smoothstep(0.02, 0.40, dot(normal.xy, eye));
    float grazing = saturate(1.15 - 1.3 * max(to_eye.z, 0.0));  // little of it turns up
    float low_sun = saturate(1.25 - to_sun.z) * smoothstep(-0.02, 0.06, to_sun.z);
    float thin = smoothstep(0.05, 0.9, lift01);
    float amount = into_sun * face * grazing * low_sun * thin;
    // from the crest to the foot the way through the wave grows from less than a metre to a few
    vec3 through = exp(-water_attenuation() * mix(5.5, 1.8, thin));
    // forward scattering is nearly white: plankton and silt throw most light on, bubbles the rest
    return min(through * (0.10 * u_water_crest_light * amount), vec3(0.5));
}
