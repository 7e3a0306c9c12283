// The beach mesh as colours, for the view of it (H03): blue small triangles, yellow the base mesh's 50 m2.

uniform sampler2D u_beach_mesh;  // level/beach_raster.py: bias, metres to an edge, v, whether it is there
uniform float u_beach_mesh_cell_m;

vec3 beach_mesh_colour(vec2 xy, float pixel_m, vec3 beside) {
    vec4 mesh = textureLod(u_beach_mesh, (xy / u_beach_mesh_cell_m + 0.5) / vec2(textureSize(u_beach_mesh, 0)), 0.0);
    bool on_level = all(greaterThanEqual(xy, vec2(0.0))) && all(lessThanEqual(xy, u_extent_m));
    if (!on_level || mesh.a < 0.5) return beside;
    float bias = clamp(mesh.r / mesh.a, 0.0, 1.0);
    vec3 value = mix(vec3(0.07, 0.10, 0.42), vec3(0.08, 0.50, 0.45), smoothstep(0.0, 0.45, bias));
    value = mix(value, vec3(0.95, 0.72, 0.12), smoothstep(0.4, 1.0, bias));
    float width_m = max(pixel_m, 0.6 * u_beach_mesh_cell_m), shown = 1.0 - smoothstep(1.0, 4.0, pixel_m);
    return mix(value, vec3(0.95), 0.7 * shown * (1.0 - smoothstep(0.5 * width_m, 1.2 * width_m, mesh.g)));
}
