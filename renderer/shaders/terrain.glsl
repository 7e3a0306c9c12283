// The land into the G-buffer: the height texture on the morphing mesh, ground materials by rule and paint (L05).
// RELIEF: the chunks near the camera, whose cells are finer than the level's: a smooth surface through the samples and the
// materials' relief fill them.
#ifdef VERTEX
invariant gl_Position;  // chunks of either kind meet in the same points
#endif
#include "lib/frame.glsl"
#include "lib/openness.glsl"
#include "lib/ground.glsl"
#include "level/layer.glsl"
uniform sampler2D u_layer_cover;

// Painted borders follow the ground, not the cells.
vec2 torn_at(vec2 xy, float pixel_m) { return (noise_at(xy, 9.0, pixel_m).gb - 0.5) * 1.4; }

// Beyond the level maps are mirrored as the heights are (lib/height.glsl).
vec2 mirrored(vec2 xy) {
    vec2 extent = vec2(textureSize(u_height, 0) - 1) * u_cell_m;
    return extent - abs(extent - abs(xy));
}

Site terrain_site(vec2 xy, vec3 normal, float height, vec2 torn, float pixel_m) {
    Openness sky = openness_at(mirrored(xy + 0.8 * torn));
    vec4 cover = layer_at(u_layer_cover, mirrored(xy + torn), u_cell_m);
    return site_at(xy, normal, height, sky.rough, sky.open, cover, pixel_m);
}

#ifdef VERTEX
#include "lib/mesh.glsl"
#ifdef RELIEF
#include "lib/relief.glsl"
float vertex_height(ivec2 cell) { return relief_height(cell); }
#else
uniform int u_relief_fine;
float vertex_height(ivec2 cell) { return height_texel(cell >> u_relief_fine); }
#endif
out vec3 v_relative;

void main() {
    MeshVertex v = mesh_vertex();
    vec2 relative = slide(mesh_relative(v.cell), mesh_relative(v.parent), v.morph);
    float height = vertex_height(v.cell);
    if (v.morph > 0.0) height = slide(height, vertex_height(v.parent), v.morph);
    v_relative = vec3(relative, height - u_camera.z);
    gl_Position = u_view_projection * vec4(v_relative, 1.0);
}
#endif

#ifdef FRAGMENT
#define WRITE_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/wet.glsl"
#ifdef RIVERS
#include "lib/river_bank.glsl"
#endif
in vec3 v_relative;
#ifdef SHOW_GROUND
uniform vec3 u_ground_colours[LAYERS];  // of the view
#endif

void main() {
    vec3 position = u_camera + v_relative;
    vec3 flat_normal = normalize(cross(dFdx(v_relative), dFdy(v_relative)));
    float pixel_m = pixel_metres(v_relative, flat_normal);
    vec3 normal = ground_normal(slope_filtered(position.xy, pixel_m));
    pixel_m = pixel_metres(v_relative, normal);  // of the smooth ground: by triangle it would show them
    vec2 torn = torn_at(position.xy, pixel_m);
    Site site = terrain_site(position.xy, normal, position.z - u_still_m, torn, pixel_m);
    Wet wet = shore_wet(position.xy, site.height - u_tide_m, pixel_m);
#ifdef RIVERS
    wet.damp = max(wet.damp, river_damp(position.xy, site.height - u_tide_m, pixel_m));
#endif
    int layer;
    Ground g = ground_at(position, site, wet.damp, pixel_m, layer);
    float film = wet.film * smoothstep(0.9, 0.97, normal.z);
    g.normal = normalize(mix(g.normal, normal, 0.85 * film));
    g.roughness = mix(g.roughness, 0.07, film);
    g.specular = mix(g.specular, 0.02, film);
    Foam lace = shore_lace(wet, position.xy, pixel_m);
    g.albedo = mix(g.albedo, foam_albedo(lace), lace.cover);
    g.roughness = mix(g.roughness, FOAM_ROUGHNESS, lace.cover);
    vec3 shown = vec3(0.0);
#ifdef SHOW_GROUND
    shown = u_ground_colours[layer];
#endif
    write_gbuffer(Surface(g.albedo, site.open, g.normal, g.roughness, g.specular, LAND, lace.cover, wet.damp,
                          shown, eye_depth_of(v_relative), position.xy));
}
#endif
