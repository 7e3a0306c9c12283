// The land into the G-buffer: the height texture on the morphing mesh, ground material by slope, height and paint.
#include "lib/frame.glsl"
#include "lib/height.glsl"

#ifdef VERTEX
#include "lib/mesh.glsl"
out vec3 v_relative;

void main() {
    MeshVertex v = mesh_vertex();
    vec2 relative = slide(mesh_relative(v.cell), mesh_relative(v.parent), v.morph);
    float height = slide(height_texel(v.cell), height_texel(v.parent), v.morph);
    v_relative = vec3(relative, height - u_camera.z);
    gl_Position = u_view_projection * vec4(v_relative, 1.0);
}
#endif

#ifdef FRAGMENT
#define WRITE_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/ground.glsl"
#include "lib/land_light.glsl"
#include "lib/layer.glsl"
#include "lib/wet.glsl"
uniform sampler2D u_layer_cover;
in vec3 v_relative;

void main() {
    vec3 position = u_camera + v_relative;
    vec3 flat_normal = normalize(cross(dFdx(v_relative), dFdy(v_relative)));
    float pixel_m = pixel_metres(v_relative, flat_normal);
    vec3 ground = ground_filtered(position.xy, pixel_m);
    vec3 normal = ground_normal(ground.yz);
    float height = position.z - u_still_m;
    vec2 torn = (noise_at(position.xy, 9.0, pixel_m).gb - 0.5) * 1.4;  // painted borders follow the ground, not the cells
    vec4 cover = layer_at(u_layer_cover, position.xy + torn, u_cell_m);
    Wet wet = shore_wet(position.xy, height, pixel_m);
    float rough, open = sky_open(position.xy + 0.8 * torn, ground.yz, rough);
    Ground g = ground_at(position, normal, height, rough, wet.damp, cover, pixel_m);
    float film = wet.film * smoothstep(0.9, 0.97, normal.z);
    g.normal = normalize(mix(g.normal, normal, 0.85 * film));
    g.roughness = mix(g.roughness, 0.07, film);
    g.specular = mix(g.specular, 0.02, film);
    Foam lace = shore_lace(wet, position.xy, pixel_m);
    g.albedo = mix(g.albedo, foam_albedo(lace), lace.cover);
    g.roughness = mix(g.roughness, FOAM_ROUGHNESS, lace.cover);
    write_gbuffer(Surface(g.albedo, open, g.normal, g.roughness, g.specular, LAND, lace.cover, wet.damp, vec3(0.0),
                          eye_depth_of(v_relative), position.xy));
}
#endif
