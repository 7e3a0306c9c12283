// Surface reflection: GGX with height-correlated Smith shadowing over Lambert, and its split-sum for ambient light.
// Sources: Walter et al. 2007; Heitz 2014; Karis, "Physically Based Shading on Mobile" (2014) for the fit.

#include "level/wind.glsl"

const float PI = 3.14159265359;

vec3 fresnel_schlick(vec3 f0, float cosine) {
    float m = 1.0 - clamp(cosine, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}

// Albedo of the mirror part under even light: (scale, bias) of f0.
vec2 specular_albedo(float roughness, float n_v) {
    const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
    const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
    vec4 r = roughness * c0 + c1;
    float a = min(r.x * r.x, exp2(-9.28 * n_v)) * r.x + r.y;
    return clamp(vec2(-1.04, 1.04) * a + r.zw, 0.0, 1.0);
}

// D · V of GGX, clamped: bright enough for glitter, small enough for a half float.
float ggx(float n_l, float n_v, float n_h, float alpha) {
    float a2 = alpha * alpha;
    float d = n_h * n_h * (a2 - 1.0) + 1.0;
    float smith = n_l * sqrt(n_v * n_v * (1.0 - a2) + a2) + n_v * sqrt(n_l * n_l * (1.0 - a2) + a2);
    return a2 / (PI * d * d) * 0.5 / max(smith, 1e-5);
}

// Radiance reflected towards v for unit illuminance from l, n·l included.
vec3 brdf_sun(vec3 albedo, vec3 n, vec3 v, vec3 l, float roughness, vec3 f0) {
    float n_l = clamp(dot(n, l), 0.0, 1.0);
    float n_v = max(dot(n, v), 1e-3);
    vec3 h = normalize(l + v + 1e-5 * n);  // n keeps it from being nothing
    float alpha = max(roughness * roughness, 0.0025) + 0.0023;  // the sun is half a degree wide
    vec3 f = fresnel_schlick(f0, dot(v, h));
    vec2 env = specular_albedo(roughness, n_v);
    vec3 diffuse = albedo * (1.0 - clamp(f0 * env.x + env.y, 0.0, 1.0)) / PI;
    return (diffuse + f * ggx(n_l, n_v, clamp(dot(n, h), 0.0, 1.0), alpha)) * n_l;
}

// Radiance reflected towards v under ambient light: irradiance for the matt part, radiance for the mirror part.
vec3 brdf_ambient(vec3 albedo, vec3 n, vec3 v, float roughness, vec3 f0, vec3 irradiance, vec3 reflected_radiance) {
    vec2 env = specular_albedo(roughness, max(dot(n, v), 1e-3));
    vec3 mirror = clamp(f0 * env.x + env.y, 0.0, 1.0);
    return albedo * (1.0 - mirror) * irradiance / PI + mirror * reflected_radiance;
}

// The half degree of the sun as a variance of slope: its disc seen in a mirror that needs half the angle.
const float SUN_SLOPE2 = 0.00465 * 0.00465 / 8.0;

// Smith's shadowing of Gaussian slopes whose root mean square along a direction is `sigma` · √½ (Walter et al. 2007).
float beckmann_lambda(float cosine, float sigma) {
    float a = cosine / max(sigma * sqrt(max(1.0 - cosine * cosine, 0.0)), 1e-6);
    return a < 1.6 ? (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a) : 0.0;
}

// The sun in water, n·l included: slopes are Gaussian, wider along the wind than across (Cox & Munk 1954), so the lobe
// is Beckmann's; GGX of the same variance would be a quarter too narrow at half height. roughness⁴ is the mean square slope
// of what the normal does not show (lib/water.glsl).
vec3 brdf_sun_water(vec3 albedo, vec3 n, vec3 v, vec3 l, float roughness, vec3 f0) {
    float n_l = clamp(dot(n, l), 0.0, 1.0), n_v = max(dot(n, v), 1e-3);
    float alpha = roughness * roughness;
    vec3 h = normalize(l + v + 1e-5 * n);  // n keeps it from being nothing
    // slopes of the facet that mirrors the sun, along and across the wind, against the normal's own plane
    vec3 along = normalize(vec3(u_wind_way, 0.0) - n * dot(n.xy, u_wind_way));
    vec3 across = cross(n, along);
    float up = max(dot(h, n), 1e-4);
    vec2 slope = vec2(dot(h, along), dot(h, across)) / up;
    vec2 variance = 2.0 * (alpha * alpha * u_wind_spread + 0.5 * SUN_SLOPE2);  // twice the axis' own, as Beckmann has it
    float d = exp(-min(dot(slope, slope / variance), 80.0)) / (PI * sqrt(variance.x * variance.y) * up * up * up * up);
    vec2 to_v = vec2(dot(v, along), dot(v, across)), to_l = vec2(dot(l, along), dot(l, across));
    float sigma_v = sqrt(dot(to_v * to_v, variance) / max(dot(to_v, to_v), 1e-8));
    float sigma_l = sqrt(dot(to_l * to_l, variance) / max(dot(to_l, to_l), 1e-8));
    float smith = 1.0 / (1.0 + beckmann_lambda(n_v, sigma_v) + beckmann_lambda(max(n_l, 1e-3), sigma_l));
    vec3 f = fresnel_schlick(f0, dot(v, h));
    vec2 env = specular_albedo(roughness, n_v);
    vec3 diffuse = albedo * (1.0 - clamp(f0 * env.x + env.y, 0.0, 1.0)) / PI;
    return diffuse * n_l + f * (d * smith / (4.0 * n_v)) * step(1e-5, n_l);
}

// Where water whose normal is n on average mirrors from: at a low angle one sees the slopes that lean to the eye. Their
// mean over Gaussian slopes weighed by how they show, σ² Φ(a) / (μ Φ(a) + σ φ(a)) with a = μ / σ and μ the tangent of the
// view's elevation; less, because the steeper ones mirror less (Fresnel; fitted to the integral, tests/test_glitter.py).
vec3 water_mirror(vec3 n, vec3 v, float roughness) {
    float up = clamp(dot(n, v), 1e-3, 1.0), sigma = max(roughness * roughness * 0.70711, 1e-4);
    float mu = up / sqrt(max(1.0 - up * up, 1e-6)), a = min(mu / sigma, 9.0);
    float below = 1.0 / (1.0 + exp(-1.702 * a)), density = 0.39894 * exp(-0.5 * a * a);
    float lean = sigma * below / (a * below + density) * max(1.0 / (1.0 + 2.1 * sigma) - 2.8 * mu, 0.0);
    vec3 level = v - n * up;
    vec3 tilted = normalize(n + level * (lean / max(length(level), 1e-4)));
    return reflect(-v, tilted);
}
