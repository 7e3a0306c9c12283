// Where the sheet of water thins out on the sand (H10): it is drawn before what it lies on by less than its thickness,
// cut where each pixel's own ray goes under, and fades into the land over its last centimetres.

const float PULL_M = 0.12;    // towards the eye: more than cells of land and sea are off their surfaces there
const float SHALLOW_M = 0.4;  // thicker water needs none
const float THIN_M = 0.012;   // from there on the sheet is water

#ifndef FRAGMENT
// A point of the mesh as the depth test sees it; its place in the picture stays.
vec3 sheet_pulled(vec3 relative, float sheet) {
    float away = max(length(relative), 1e-3);
    float pull = u_shore_slide * PULL_M * (1.0 - smoothstep(0.5 * SHALLOW_M, SHALLOW_M, sheet));
    pull *= 2.0 * smoothstep(-0.5 * PULL_M, 0.0, sheet) - 1.0;  // where it lies on the sand nobody sees it
    return relative * (1.0 - min(pull / away, 0.3));
}
#endif

#ifdef FRAGMENT
#include "lib/gbuffer.glsl"
#ifdef PLATE
uniform sampler2D under_normal;  // of the land, and its roughness
const float LAND_SPECULAR = 0.02;  // of the film on it
#endif

// True where no water stands before the land at this pixel, whose land is `land_depth` along the view, 0 for none.
bool sheet_ends(float sheet, float eye_depth, float land_depth) {
    return u_shore_slide > 0.0 && (sheet <= 0.0 || (land_depth > 0.0 && eye_depth > land_depth));
}

// 0 where it has no thickness, 1 where it is water: `column` over the bed, `way_m` along the ray (D02, H10).
float sheet_share(float column, float way_m) {
    float way = smoothstep(0.0, 0.03, way_m);
    return u_shore_slide > 0.0 ? way * smoothstep(0.0, THIN_M, column) : way;
}

// Where it ends it is the land: lit as the plate shows it and with the land's own mirror light, which the plate leaves
// out; or (albedo) its colour for the light to come.
void sheet_over(vec3 land, float thin, float cosine, inout Surface s) {
    s.specular *= thin;
    if (thin >= 1.0 || u_shore_slide <= 0.0) return;
#ifdef PLATE
    vec4 ground = texelFetch(under_normal, ivec2(gl_FragCoord.xy), 0);
    s.emissive = mix(land * (1.0 - water_fresnel(cosine, ground.a)), s.emissive, thin);
    s.normal = normalize(mix(ground.xyz, s.normal, thin));
    s.roughness = mix(ground.a, s.roughness, thin);
    s.specular += LAND_SPECULAR * (1.0 - thin);
#else
    s.albedo += land * (1.0 - thin);
    s.emissive *= thin;
#endif
}
#endif
