// The G-buffer, packed and unpacked in one place; targets.py documents the layout (D01).

struct Surface {
    vec3 albedo;
    float open;       // share of the sky that is seen
    vec3 normal;
    float roughness;
    float specular;   // reflectance at normal incidence
    int material;
    float foam;
    float wet;
    vec3 emissive;    // finished light, kcd/m²
    float eye_depth;
    vec2 before;
};

const float MOST_RADIANCE = 60000.0;  // a half float holds 65504

#ifdef WRITE_GBUFFER
layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec4 out_normal;
layout(location = 2) out vec4 out_material;
layout(location = 3) out vec4 out_emissive;
layout(location = 4) out float out_eye_depth;
layout(location = 5) out vec2 out_before;

void write_gbuffer(Surface s) {
    out_albedo = vec4(sqrt(clamp(s.albedo, 0.0, 1.0)), s.open);
    out_normal = vec4(s.normal, s.roughness);
    out_material = vec4(sqrt(clamp(s.specular, 0.0, 1.0)), float(s.material) / 255.0, s.foam, s.wet);
    out_emissive = vec4(clamp(s.emissive, 0.0, MOST_RADIANCE), 1.0);
    out_eye_depth = s.eye_depth;
    out_before = s.before;
}
#else
uniform sampler2D g_albedo, g_normal, g_material, g_emissive, g_eye_depth, g_before;

Surface read_gbuffer(ivec2 pixel) {
    vec4 albedo = texelFetch(g_albedo, pixel, 0);
    vec4 normal = texelFetch(g_normal, pixel, 0);
    vec4 material = texelFetch(g_material, pixel, 0);
    float n2 = dot(normal.xyz, normal.xyz);
    return Surface(albedo.rgb * albedo.rgb, albedo.a, n2 > 0.0 ? normal.xyz * inversesqrt(n2) : vec3(0.0, 0.0, 1.0),
                   normal.a, material.r * material.r, int(material.g * 255.0 + 0.5), material.b, material.a,
                   texelFetch(g_emissive, pixel, 0).rgb, texelFetch(g_eye_depth, pixel, 0).r,
                   texelFetch(g_before, pixel, 0).rg);
}
#endif
