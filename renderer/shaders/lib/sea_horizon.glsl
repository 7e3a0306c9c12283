// The plane beyond the mesh (H21), and where the one ends and the other begins.

uniform vec4 u_mesh_box;     // world west, south, east, north of the hectares that the mesh may be in
uniform vec3 u_mesh_circle;  // world middle and radius: of those, the ones that have a part in it (H01)

const float PATCH_M = 100.0;

bool in_mesh(vec2 xy) {
    vec2 west_south = floor(xy / PATCH_M) * PATCH_M;
    vec2 nearest = clamp(u_mesh_circle.xy, west_south, west_south + PATCH_M);
    return all(greaterThanEqual(xy, u_mesh_box.xy)) && all(lessThan(xy, u_mesh_box.zw)) &&
           distance(nearest, u_mesh_circle.xy) < u_mesh_circle.z;
}

// Whether the mesh is here and all round as far as `spare_m`.
bool deep_in_mesh(vec2 xy, float spare_m) {
    vec2 s = vec2(spare_m, -spare_m);
    return in_mesh(xy + s.xx) && in_mesh(xy + s.xy) && in_mesh(xy + s.yx) && in_mesh(xy + s.yy);
}

#if defined(VERTEX) && defined(HORIZON)
uniform vec4 u_horizon_hole;  // camera-relative west, south, east, north of where the plane isn't needed

// A ring of eight triangles whose outer corners lie at infinity (w = 0).
void main() {
    int side = gl_VertexID / 6, corner = gl_VertexID % 6;
    bool far = corner == 2 || corner == 4 || corner == 5;
    int at = (side + (corner == 1 || corner == 2 || corner == 4 ? 1 : 0)) % 4;
    vec2 way = vec2(at == 1 || at == 2 ? 1.0 : -1.0, at >= 2 ? 1.0 : -1.0);
    vec2 near = vec2(way.x > 0.0 ? u_horizon_hole.z : u_horizon_hole.x, way.y > 0.0 ? u_horizon_hole.w : u_horizon_hole.y);
    float fall = u_sea_now_m - u_camera.z;
    gl_Position = u_view_projection * (far ? vec4(way, 0.0, 0.0) : vec4(near, fall, 1.0));
}
#endif
