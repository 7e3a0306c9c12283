// Wave objects: three fronts each in a circle, straight or curved (H08, H09). The twin is level/wave_objects.py.
#include "level/wave_circle.glsl"

const int WAVE_OBJECTS_MOST = 32;
const int OBJECT_FRONTS = 3;

uniform ivec2 u_wave_ends;                                    // how many end the high pass, how many there are
uniform vec4 u_wave_place[WAVE_OBJECTS_MOST];                 // x, y, radius of its full weight, radius
uniform vec3 u_wave_bend[WAVE_OBJECTS_MOST];                  // curvature, distance of its centre, depth for all its weight
uniform vec4 u_wave_way[OBJECT_FRONTS * WAVE_OBJECTS_MOST];   // unit direction, cycles a metre, phase in cycles
uniform vec2 u_wave_size[OBJECT_FRONTS * WAVE_OBJECTS_MOST];  // amplitude_m, lateral_m

// The bed under the undeformed point, set by sea_surface: smoothed depth and share of the sea, duals.
vec3 objects_depth, objects_sea;

// The objects from first to before end whose circle a point is in, one bit each: at most four on any hectare.
uint waves_here(vec2 before, int first, int end) {
    uint found = 0u;
    for (int i = first; i < end; ++i) {
        vec2 off = before - u_wave_place[i].xy;
        found |= dot(off, off) < u_wave_place[i].w * u_wave_place[i].w ? 1u << uint(i) : 0u;
    }
    return found;
}

// Metres along a front's way, bent by the curvature, as a dual; `way_x`, `way_y` its gradient as duals.
vec3 front_coordinate(vec2 bend, vec2 heading, vec3 px, vec3 py, out vec3 way_x, out vec3 way_y) {
    float centre_m = bend.x < 0.0 ? -bend.y : bend.y, straight = 1.0 - abs(bend.x);
    vec3 cx = px + d_const(centre_m * heading.x), cy = py + d_const(centre_m * heading.y);
    float away = max(length(vec2(cx.x, cy.x)), 1e-3);
    vec3 r = vec3(away, (cx.x * cx.yz + cy.x * cy.yz) / away);
    vec3 over = vec3(1.0 / away, -r.yz / (away * away));
    way_x = d_mul(cx, over) * bend.x + d_const(straight * heading.x);
    way_y = d_mul(cy, over) * bend.x + d_const(straight * heading.y);
    return straight * (px * heading.x + py * heading.y) + bend.x * (r - d_const(bend.y));
}

const float RING_HOLE = 0.25;

// Where rings begin there is a kink: the water stays flat.
vec3 ring_weight(vec4 place, vec2 before) {
    vec2 off = before - place.xy;
    float away = length(off);
    return d_step(0.0, RING_HOLE * place.w, vec3(away, off / max(away, 1e-6)));
}

// Moves a point by the objects of a pass, whose base is that of the pass. Unlike the open sea's waves theirs come in to
// where they are a few times as deep as high.
void add_wave_objects(int first, int end, vec3 x, vec3 y, vec2 before, float share, inout Deformed point) {
    for (uint left = waves_here(before, first, end); left != 0u; left &= left - 1u) {
        int n = findLSB(left);
        vec4 place = u_wave_place[n];
        vec3 depth = d_mul(d_step(u_deep_start_m, u_wave_bend[n].z, objects_depth), objects_sea);
        vec3 weight = share * d_mul(circle_weight(place, before), depth);
        if (u_wave_bend[n].y == 0.0) weight = d_mul(weight, ring_weight(place, before));
        vec3 px = x - d_const(place.x), py = y - d_const(place.y);
        for (int i = OBJECT_FRONTS * n; i < OBJECT_FRONTS * n + OBJECT_FRONTS; ++i) {
            vec4 way = u_wave_way[i];
            vec3 way_x, way_y, q = front_coordinate(u_wave_bend[n].xy, way.xy, px, py, way_x, way_y);
            float theta = 6.28318530718 * fract(q.x * way.z - way.w), s = sin(theta), c = cos(theta);
            vec2 slope = 6.28318530718 * way.z * q.yz;
            vec3 lateral = d_mul(weight, u_wave_size[i].y * vec3(c, -s * slope));
            point.x += d_mul(lateral, way_x);
            point.y += d_mul(lateral, way_y);
            point.z += d_mul(weight, u_wave_size[i].x * vec3(s, c * slope));
        }
    }
}
