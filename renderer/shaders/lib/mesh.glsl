// Vertices of the morphing quadtree; mesh.py has the rules. Cells are whole numbers: both sides of a border agree.

uniform float u_mesh_cell_m;
uniform ivec2 u_mesh_camera_cell;
uniform vec2 u_mesh_camera_rest;
uniform float u_mesh_above_m;
uniform float u_mesh_range_m[20];  // by level
uniform float u_mesh_morph;
uniform ivec4 u_mesh_area;  // first column, first row, last column, last row

in ivec2 in_cell;
in ivec3 in_chunk;

struct MeshVertex {
    ivec2 cell;    // where it stands at its own level
    ivec2 parent;  // the vertex of the coarser level that it slides to
    float morph;   // 0 … 1
};

vec2 mesh_relative(ivec2 cell) { return vec2(cell - u_mesh_camera_cell) * u_mesh_cell_m - u_mesh_camera_rest; }

ivec2 mesh_clamp(ivec2 cell) { return clamp(cell, u_mesh_area.xy, u_mesh_area.zw); }

MeshVertex mesh_vertex() {
    ivec2 cell = mesh_clamp(in_chunk.xy + (in_cell << in_chunk.z));
    ivec2 parent = mesh_clamp(in_chunk.xy + ((in_cell & ~1) << in_chunk.z));
    vec2 away = abs(mesh_relative(cell));
    float range = u_mesh_range_m[in_chunk.z] * 0.999;  // safely inside the range the CPU divides by
    float distance_m = max(max(away.x, away.y), u_mesh_above_m);
    float morph = clamp((distance_m / range - u_mesh_morph) / (1.0 - u_mesh_morph), 0.0, 1.0);
    return MeshVertex(cell, parent, morph);
}

// mix() need not give b exactly at 1; a border without cracks needs it.
vec2 slide(vec2 a, vec2 b, float morph) { return morph >= 1.0 ? b : a + (b - a) * morph; }
float slide(float a, float b, float morph) { return morph >= 1.0 ? b : a + (b - a) * morph; }
