// The sea, one more layer in the same G-buffer (D01). With HORIZON: the plane beyond the mesh, to infinity (H21).
// With COARSE the surface is the mesh's own, not the wave along each pixel's ray. The stages before the pixels are in
// lib/sea_mesh.glsl and lib/sea_horizon.glsl.
#include "lib/frame.glsl"
#include "level/waves.glsl"

#include "lib/sea_mesh.glsl"
#include "lib/sea_horizon.glsl"

#ifdef FRAGMENT
#define WRITE_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/shadow.glsl"
#include "level/layer.glsl"
#include "lib/sea_material.glsl"
#include "lib/sea_find.glsl"
#include "lib/sea_below.glsl"
#include "lib/sheet.glsl"
#include "lib/rings.glsl"
#include "lib/rain_rings.glsl"
#ifdef RIVERS
#include "lib/river.glsl"
#include "lib/mouth.glsl"
#endif
uniform sampler2D u_layer_foam;
uniform float u_cell_m;
uniform vec2 u_apron;  // metres the land goes on beyond the level, metres it sinks
uniform float u_water_roughness, u_water_specular;
uniform vec2 u_wave_slope;  // mean square slope of swell and chop
const float FARTHEST_M = 4e6;  // where the plane ends for float32's sake
uniform bool u_show_procedural_foam, u_show_painted_foam, u_foam_roughness;
uniform float u_foam_albedo;
#ifndef HORIZON
in vec2 v_before;
in vec3 v_relative;
#ifdef MEASURED
flat in vec2 v_area;
#endif
#endif

// Beyond the level the shore map repeats its border: surf there would run on as a stripe to the horizon.
void fade_surf(inout Sea sea) {
    vec2 outside = max(max(-sea.position.xy, sea.position.xy - u_extent_m), 0.0);
    float share = 1.0 - smoothstep(0.1 * u_apron.x, 0.6 * u_apron.x, length(outside));
    sea.shore.line *= share;
    sea.shore.back *= share;
    sea.shore.fall *= share;
    sea.bed.sea.x *= share;
    // out there it is open sea, whatever the border shows
    float open_sea = smoothstep(0.01 * u_apron.x, 0.12 * u_apron.x, length(outside));
    sea.deep = max(sea.deep, open_sea);
    sea.bed.depth.x = max(sea.bed.depth.x, u_apron.y * open_sea * open_sea);
}

// Whether what stands above the eye is seen through the air: a fall, or a river on higher ground (D13).
bool eye_over_water() {
#ifdef RIVERS
    River there = river_at(u_camera.xy);
    return u_camera.z > u_sea_now_m + (there.share >= 0.5 ? there.still : 0.0);
#else
    return false;
#endif
}

// The sea's transient and constant foam; where the level has rivers, their stagnant and turbulent foam too.
vec4 painted_foam(vec2 xy) { return u_show_painted_foam ? layer_at(u_layer_foam, xy, u_cell_m) : vec4(0.0); }

void main() {
#ifdef HORIZON
    vec3 ray = pixel_ray();
    float fall = u_sea_now_m - u_camera.z;
    if (ray.z * fall <= 0.0) discard;
    vec3 relative = ray * min(fall / ray.z, FARTHEST_M);
    vec2 before = u_camera.xy + relative.xy;
    float pixel_m = pixel_metres(relative, vec3(0.0, 0.0, 1.0));
    if (patch_removed(before) || deep_in_mesh(before, 1.0 + pixel_m)) discard;
#else
    vec3 relative = v_relative;
    vec2 before = v_before;
    float pixel_m = pixel_metres(relative, vec3(0.0, 0.0, 1.0));
    if (patch_removed(before) || !in_mesh(before)) discard;
#endif
    vec2 shares = wave_share(relative.xy);
    // Waves shorter than some pixels would only flicker: their slope becomes roughness. A pixel is long at a low angle.
    float long_m = min(length(relative) * u_pixel_angle / max(abs(normalize(relative).z), 0.02), 3.0 * pixel_m);
    vec2 sharp = shares / (1.0 + pow(2.5 * long_m / vec2(u_swell_length_m, u_chop_length_m), vec2(4.0)));
    sharp.y = mix(1.0, sharp.y, smoothstep(SEARCH_M, 1.4 * SEARCH_M, length(relative)));
    chop_share = sharp.y;
    group_swell(before, length(relative), pixel_m);
#if defined(HORIZON) || defined(COARSE)
    Sea sea = sea_surface(before);
#else
    Sea sea = sea_found(shares.x >= 1.0 && length(relative) < FOUND_M, relative, before);
#endif
    fade_surf(sea);
#ifdef RIVERS
    // ground that lies lower than a river beside it: what joins its level with the sea's is no water
    if (sea.river.share < 0.5 && sea.still > 0.05 && sea.bed.sea.x < 0.5) discard;
#endif
    float away = length(relative), eye_depth = eye_depth_of(relative);
    if (sheet_ends(sea.sheet, eye_depth, texelFetch(under_eye_depth, ivec2(gl_FragCoord.xy), 0).r)) discard;
    vec3 to_eye = -relative / max(away, 1e-4);
    vec3 position = u_camera + relative;
    float column = water_column(sea, position.z);
    float rippled = ripple_share(column);
    float gusts = water_gusts(before, length(relative), long_m);
    vec3 ripple = water_ripples(before, long_m) * vec3(vec2(sqrt(gusts)), gusts);
    vec4 painted = painted_foam(before);
    vec4 current = current_at(before), force = force_at(sea.position.xy);
#ifdef RIVERS
    Stream stream = stream_at(sea.river, before, current.rg, force.xy, pixel_m);
    Plume plume = plume_at(before, pixel_m);
    river_water = river_tint(plume, stream.share);
    rippled = mix(rippled, smoothstep(0.0, 0.2, column), stream.own);
    ripple = mix(ripple, river_ripples(stream, before, long_m), stream.own);
#endif
    float body = wave_body(sea, sharp.x), breadth = wave_breadth(sea);
    // a shore wave is lit as the steep wave it stands for: cells of half a metre carry a gentler one
    vec2 slope = -sea.normal.xy / max(sea.normal.z, 0.05) * (1.0 + 0.9 * body * breadth);
    slope = sharp.x * (slope - 0.9 * (1.0 - breadth) * sea.shore.lift.yz) + rippled * ripple.xy;
    vec3 rings = ring_slope(sea.position.xy, long_m);
#ifdef RAIN_RINGS
    rings += rain_slope(before, long_m);
#endif
    rings *= smoothstep(0.0, 0.15, column);
    slope += rings.xy;
    // slopes that neither the waves here nor the ripples show: together always what the wind makes (Cox & Munk 1954)
    vec2 shown = sea.deep * sharp.x * vec2(1.0, sharp.y);
#ifdef RIVERS
    shown = mix(shown, vec2(1.0), stream.own);  // none of the sea's waves are meant to be there
#endif
    float lost = (ripple.z + dot(u_wave_slope, 1.0 - shown * shown)) * rippled * rippled + rings.z;
    vec3 normal = normalize(vec3(-slope, 1.0));
#ifdef PLUNGE
    // a face that stands upright or hangs over is no slope (H23)
    vec3 hanging = normalize(sea.normal - vec3(rippled * ripple.xy, 0.0));
    float hangs = (1.0 - smoothstep(0.25, 0.6, sea.normal.z)) * sharp.x;
    normal = normalize(mix(normal, hanging, hangs));
#endif
    bool outside = to_eye.z >= 0.0 || eye_over_water(), higher = outside && to_eye.z < 0.0;
    if (dot(normal, to_eye) < 0.0)
        normal = outside ? normalize(normal - 1.02 * dot(normal, to_eye) * to_eye) : -normal;

    current.rg += force.xy;
    stirred = force.w;
#ifdef RIVERS
    stirred = max(stirred, max(plume.seam, blocked_foam(sea.river.white, before, sea.height01, u_chop_length_m, pixel_m)));
#endif
    // a wave's face is seen straighter than the plane: what lies on it is neither blurred nor stretched like the plane's
    float face_m = min(pixel_m, pixel_metres(relative, sea.normal));
    Foam foam = sea_foam(sea, on_face(before, sea), column, sharp.x, painted.rg, current, u_show_procedural_foam, face_m);

    vec3 white = foam_albedo(foam);
#ifdef RIVERS
    foam = with_river_foam(foam, stream, before, painted.ba, force, u_show_procedural_foam, face_m, white);
    foam = with_flotsam(foam, plume.flotsam, white);
#endif

#ifdef PLUNGE
    // white water is no sheet with a dark side: light comes through it from above
    float turned = max(hangs, (1.0 - smoothstep(0.45, 0.92, normal.z)) * min(u_shore_plunge, 1.0));
    normal = normalize(normal + vec3(0.0, 0.0, 2.2 * turned * foam.cover));
#endif
#ifdef PLUNGE
    // bent so far, a ray finds nothing
    vec4 land = below(normalize(normal + vec3(0.0, 0.0, 3.0 * hangs)), eye_depth, away, higher);
#else
    vec4 land = below(normal, eye_depth, away, higher);
#endif
    float cosine = clamp(dot(normal, to_eye), 0.02, 1.0);
    float depth = land.w * water_cosine(cosine) * abs(to_eye.z);
    float thin = sheet_share(column, land.w);  // at its edge the water blends with what lies below
    foam.cover *= thin;
    float rough = u_foam_roughness ? foam.cover : 0.0;  // D09: brightness and roughness, each by its own switch
    foam.cover *= u_foam_albedo;
    float roughness = water_roughness(u_water_roughness * mix(0.6, 1.0, rippled), lost);
    vec3 sun = sun_radiance() * sun_visibility(position), sky = sky_irradiance(vec3(0.0, 0.0, 1.0));
    vec2 bed_xy = before - to_eye.xy * land.w;
    body *= breadth;
    float face = wave_face(sea, normal, body);
#ifdef PLUNGE
    face = max(face, hangs * sea.shore.breaker.leaning.x);
#endif
    depth += 1.3 * face;
    float still_depth = sea.bed.depth.x + sea.still;
    vec3 from_below = light_from_below(land.rgb, still_depth, bed_xy, depth, cosine, sun, sky, pixel_m);
    if (sky_behind) from_below += sky_irradiance(-to_eye) / 3.14159265 * water_transmittance(CREST_M);
    vec2 shade_at = foam_shade_place(before, still_depth);
    float shade = foam_shade(shade_at, painted_foam(shade_at).rg, current_at(shade_at), pixel_m);
#ifdef RIVERS
    float amount = stagnant_amount(stream, before, painted.b, force, u_show_procedural_foam, pixel_m);
    shade = mix(shade, 1.0, stream.own) * river_shade(stream, shade_at, amount, pixel_m);
#endif
    from_below *= wave_shade(normal, body) * shade;
    from_below = bubbles(from_below, foam, sun, sky);
    // foam lets some of what comes through the crest on
    vec3 crest = water_crest_light(max(sea.height01 * sharp.x, body), normal, to_eye, u_sun_direction) * sun;
    from_below = from_below * (1.0 - foam.cover) + crest * (1.0 - 0.55 * foam.cover);
    from_below *= 1.0 - water_fresnel(cosine, roughness) * (1.0 - foam.cover);
    roughness = mix(roughness, FOAM_ROUGHNESS, rough);
    Surface surface = Surface(white * foam.cover, 1.0 - 0.5 * face, normal, roughness, u_water_specular, SEA,
                              foam.cover, 1.0, from_below, eye_depth, before);
    sheet_over(land.rgb, thin, cosine, surface);
    write_gbuffer(surface);
#if defined(MEASURED)
    out_emissive = vec4(v_area, 0.0, 1.0);
#elif defined(UNMEASURED)
    out_emissive = vec4(0.0);
#endif
}
#endif
