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
uniform sampler2D u_layer_cover;
uniform float u_swash_top_m;  // how high over the still sea the run-up reaches
in vec3 v_relative;

void main() {
    vec3 position = u_camera + v_relative;
    vec3 flat_normal = normalize(cross(dFdx(v_relative), dFdy(v_relative)));
    float pixel_m = pixel_metres(v_relative, flat_normal);
    vec3 ground = ground_filtered(position.xy, pixel_m);
    vec3 normal = ground_normal(ground.yz);
    float height = position.z - u_still_m;
    vec4 cover = texture(u_layer_cover, (position.xy / u_cell_m + 0.5) / vec2(textureSize(u_layer_cover, 0)));
    float wet = 1.0 - smoothstep(0.75 * u_swash_top_m, 1.15 * u_swash_top_m + 0.05, height);
    Ground g = ground_at(position, normal, height, wet, cover, pixel_m);
    write_gbuffer(Surface(g.albedo, 1.0, g.normal, g.roughness, g.specular, LAND, 0.0, wet, vec3(0.0),
                          eye_depth_of(v_relative), position.xy));
}
#endif
