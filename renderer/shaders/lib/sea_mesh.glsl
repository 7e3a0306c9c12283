// The sea's mesh: from grids, or tessellated from cells of 10 m (H01, H02). With MEASURED a geometry stage measures triangles.
// One weight by distance drives how fine it is and how high its waves stand (H31).

#ifndef FRAGMENT
#include "lib/sheet.glsl"
#endif

uniform float u_sea_near_m, u_sea_falloff;
uniform vec2 u_sea_length_m;  // of swell and chop
uniform vec4 u_sea_edge;      // camera-relative middle of the mesh, radius at which its waves lie flat, width of the way there

// what near waves are drawn with, whatever the tier; the chop as if with less, for from afar its fronts stand in a lattice
const vec2 NEAR_CELL_M = vec2(0.5, 1.0);
const float FLAT_CELLS = 2.0, WHOLE_CELLS = 6.0;  // cells a wavelength at which a wave lies flat, is whole

// 1 up to near_m, from there falling faster than linear.
float sea_weight(vec2 away) {
    float d = length(away);
    return d <= u_sea_near_m ? 1.0 : pow(u_sea_near_m / d, u_sea_falloff);
}

// Share of the waves' height left at this distance (swell, chop): far cells are too wide to carry them, and the mesh's
// edge meets the horizon's plane flat.
vec2 wave_share(vec2 away) {
    vec2 cells = sea_weight(away) * max(u_sea_length_m / NEAR_CELL_M, WHOLE_CELLS);
    float edge = 1.0 - smoothstep(u_sea_edge.z - u_sea_edge.w, u_sea_edge.z, length(away - u_sea_edge.xy));
    return edge * smoothstep(FLAT_CELLS, WHOLE_CELLS, cells);
}

// Where a vertex of the undeformed plane goes, camera-relative, and how thick the sheet is there.
vec3 sea_vertex(vec2 before, vec2 relative, out float sheet) {
    vec2 shares = wave_share(relative);
    chop_share = shares.y;
    Sea sea = sea_surface(before);
    sheet = sea.sheet;
    float share = shares.x;
    vec2 shift = (sea.position.xy - before) * share;
    float rise = sea.still + (sea.position.z - u_sea_level_m - sea.still) * share;
    return vec3(relative + shift, u_sea_level_m - u_camera.z + rise);
}

#ifdef MEASURED
#define MADE_BEFORE m_before
#define MADE_RELATIVE m_relative
#define MADE_FACTOR m_factor
#else
#define MADE_BEFORE v_before
#define MADE_RELATIVE v_relative
#define MADE_FACTOR v_factor
#endif

#if defined(VERTEX) && !defined(HORIZON)
#include "lib/mesh.glsl"
#ifdef TESSELLATED
out vec2 c_before, c_relative;
#else
out vec2 MADE_BEFORE;
out vec3 MADE_RELATIVE;
#endif

void main() {
    MeshVertex v = mesh_vertex();
    vec2 relative = slide(mesh_relative(v.cell), mesh_relative(v.parent), v.morph);
    vec2 before = slide(vec2(v.cell) * u_mesh_cell_m, vec2(v.parent) * u_mesh_cell_m, v.morph);
#ifdef TESSELLATED
    c_before = before;
    c_relative = relative;
#else
    MADE_BEFORE = before;
    float sheet;
    MADE_RELATIVE = sea_vertex(before, relative, sheet);
    gl_Position = u_view_projection * vec4(sheet_pulled(MADE_RELATIVE, sheet), 1.0);
#endif
}
#endif

#ifdef TESS_CONTROL
layout(vertices = 4) out;
in vec2 c_before[], c_relative[];
out vec2 e_before[], e_relative[];
patch out float e_factor;
uniform vec4 u_planes[5];  // a camera-relative point p is inside where dot(p, n) + d is not negative
uniform vec2 u_tess;       // parts a metre near by, most parts an edge
uniform float u_sea_top_m;  // how far waves leave the plane, up, down and sideways

const float LEAST_PX = 24.0;  // area of the smallest triangle that is made, with some reserve over 16

// Parts a metre that a vertex asks for: by distance, and no triangle under LEAST_PX. A square metre of the plane is
// cos / (d · pixel angle)² pixels large.
float parts_at(vec2 relative) {
    float fall = max(abs(u_sea_level_m - u_camera.z), 1.0), d = length(vec3(relative, fall));
    float square_px = fall / (d * d * d * u_pixel_angle * u_pixel_angle);
    return min(u_tess.x * sea_weight(relative), sqrt(square_px / (2.0 * LEAST_PX)));
}

// From both ends alone and the same whichever comes first: both sides of an edge divide it alike.
float edge_factor(int a, int b) {
    float parts = min(parts_at(c_relative[a]), parts_at(c_relative[b]));
    return floor(clamp(parts * distance(c_relative[a], c_relative[b]), 1.0, u_tess.y));
}

bool outside() {
    vec2 low = min(min(c_relative[0], c_relative[1]), min(c_relative[2], c_relative[3])) - u_sea_top_m;
    vec2 high = max(max(c_relative[0], c_relative[1]), max(c_relative[2], c_relative[3])) + u_sea_top_m;
    float still = u_sea_level_m - u_camera.z;
    for (int i = 0; i < 5; ++i) {
        vec3 n = u_planes[i].xyz;
        vec3 farthest = vec3(n.x > 0.0 ? high.x : low.x, n.y > 0.0 ? high.y : low.y, still + sign(n.z) * u_sea_top_m);
        if (dot(n, farthest) + u_planes[i].w < 0.0) return true;
    }
    return false;
}

void main() {
    e_before[gl_InvocationID] = c_before[gl_InvocationID];
    e_relative[gl_InvocationID] = c_relative[gl_InvocationID];
    if (gl_InvocationID != 0) return;
    // corners come south-west, south-east, north-east, north-west
    vec4 edges = outside() ? vec4(0.0) : vec4(edge_factor(0, 3), edge_factor(0, 1), edge_factor(1, 2), edge_factor(3, 2));
    for (int i = 0; i < 4; ++i) gl_TessLevelOuter[i] = edges[i];
    e_factor = floor(0.25 * dot(edges, vec4(1.0)) + 0.5);
    gl_TessLevelInner[0] = e_factor;
    gl_TessLevelInner[1] = e_factor;
}
#endif

#ifdef TESS_EVALUATION
layout(quads, equal_spacing, ccw) in;
in vec2 e_before[], e_relative[];
patch in float e_factor;
out vec2 MADE_BEFORE;
out vec3 MADE_RELATIVE;
#ifdef MEASURED
out float MADE_FACTOR;
#endif

// Exact at 0 and 1: neighbours get the same points on their common edge.
vec2 within(vec2 a, vec2 b, vec2 c, vec2 d) {
    vec2 t = gl_TessCoord.xy;
    return (a * (1.0 - t.x) + b * t.x) * (1.0 - t.y) + (d * (1.0 - t.x) + c * t.x) * t.y;
}

void main() {
    MADE_BEFORE = within(e_before[0], e_before[1], e_before[2], e_before[3]);
    float sheet;
    MADE_RELATIVE = sea_vertex(MADE_BEFORE, within(e_relative[0], e_relative[1], e_relative[2], e_relative[3]), sheet);
    gl_Position = u_view_projection * vec4(sheet_pulled(MADE_RELATIVE, sheet), 1.0);
#ifdef MEASURED
    MADE_FACTOR = e_factor;
#endif
}
#endif

#ifdef GEOMETRY
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;
in vec2 m_before[];
in vec3 m_relative[];
#ifdef TESSELLATED
in float m_factor[];
#endif
out vec2 v_before;
out vec3 v_relative;
flat out vec2 v_area;  // pixels, parts an edge of its cell was divided into

void main() {
    vec2 corner[3];
    bool near = false;
    for (int i = 0; i < 3; ++i) {
        near = near || gl_in[i].gl_Position.w < 0.05;
        corner[i] = gl_in[i].gl_Position.xy / gl_in[i].gl_Position.w * 0.5 * u_size;
    }
    vec2 a = corner[1] - corner[0], b = corner[2] - corner[0];
    float area = near ? 1e4 : min(0.5 * abs(a.x * b.y - a.y * b.x), 1e4);
    for (int i = 0; i < 3; ++i) {
        gl_Position = gl_in[i].gl_Position;
        v_before = m_before[i];
        v_relative = m_relative[i];
#ifdef TESSELLATED
        v_area = vec2(area, m_factor[i]);
#else
        v_area = vec2(area, 1.0);
#endif
        EmitVertex();
    }
    EndPrimitive();
}
#endif
