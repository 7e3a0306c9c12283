// Surface reflection: GGX with height-correlated Smith shadowing over Lambert, and its split-sum for ambient light.
// Sources: Walter et al. 2007; Heitz 2014; Karis, "Physically Based Shading on Mobile" (2014) for the fit.

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
    vec3 h = normalize(l + v);
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
