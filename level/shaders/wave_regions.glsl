// Regions of swell: a second set of the sea's own fronts, displacements blended by weight (D32). The twins are
// level/wave_regions.py and level/outline.py. Included by gerstner.glsl, whose fronts these are.
#include "level/wave_circle.glsl"

const int REGIONS_MOST = 4;
const int OUTLINE_MOST = 16;

uniform int u_region_count;
uniform vec4 u_region_place[REGIONS_MOST];          // x, y, radius of a circle's full weight, how far it reaches
uniform vec4 u_region_band[REGIONS_MOST];           // edges of its outline, m outside and inside it, whether swells keep their time
uniform vec4 u_region_edge[REGIONS_MOST * OUTLINE_MOST];  // from, to, m from its place
uniform vec4 u_region_way[REGIONS_MOST * FRONTS];   // as u_front_way
uniform vec4 u_region_size[REGIONS_MOST * FRONTS];  // as u_front_size

vec3 d_over_length(vec3 x, vec3 y) {
    float over = 1.0 / max(length(vec2(x.x, y.x)), 1e-4);
    return vec3(over, -(x.x * x.yz + y.x * y.yz) * over * over * over);
}

// tan(α / 2) · (1 / r + 1 / r') of an edge.
vec3 edge_seen(vec4 edge, vec2 off) {
    vec3 ax = vec3(edge.x - off.x, -1.0, 0.0), ay = vec3(edge.y - off.y, 0.0, -1.0);
    vec2 along = edge.zw - edge.xy;
    vec3 bx = ax + d_const(along.x), by = ay + d_const(along.y), over_a = d_over_length(ax, ay), over_b = d_over_length(bx, by);
    vec3 overs = d_mul(over_a, over_b);
    vec3 cosine = d_mul(d_mul(ax, bx) + d_mul(ay, by), overs), sine = d_mul(ax * along.y - ay * along.x, overs);
    bool behind = cosine.x < 0.0;
    vec3 top = behind ? d_const(1.0) - cosine : sine, bottom = behind ? sine : d_const(1.0) + cosine;
    float least = abs(bottom.x) < 1e-9 ? (bottom.x < 0.0 ? -1e-9 : 1e-9) : bottom.x;
    return d_mul(d_mul(top, vec3(1.0 / least, -bottom.yz / (least * least))), over_a + over_b);
}

// How far within the outline of region n a point is, smooth but at its corners, below 0 outside; a dual.
vec3 outline_inside(int n, vec2 off) {
    vec3 total = vec3(0.0);
    int edges = int(u_region_band[n].x);
    for (int i = 0; i < edges; ++i) total += edge_seen(u_region_edge[n * OUTLINE_MOST + i], off);
    float over = (total.x < 0.0 ? -1.0 : 1.0) / max(abs(total.x), 1e-9);
    return vec3(2.0 * over, -2.0 * over * over * total.yz);
}

vec3 region_weight(int n, vec2 before) {
    vec4 place = u_region_place[n], band = u_region_band[n];
    if (band.x < 0.5) return circle_weight(place, before);
    return d_step(-band.y, band.z, outline_inside(n, before - place.xy));
}

#ifdef TRAVEL_TIME
void blend_regions(int first, int end, Passing passing, Deformed point, vec2 before, inout vec3 dx, inout vec3 dy,
                   inout vec3 dz) {
#else
void blend_regions(int first, int end, Deformed point, vec2 before, inout vec3 dx, inout vec3 dy, inout vec3 dz) {
#endif
    uint left = 0u;
    for (int n = 0; n < u_region_count; ++n) {
        vec2 off = before - u_region_place[n].xy;
        left |= dot(off, off) < u_region_place[n].w * u_region_place[n].w ? 1u << uint(n) : 0u;
    }
    for (; left != 0u; left &= left - 1u) {
        int n = findLSB(left), plain = end;
        vec3 there_x = vec3(0.0), there_y = vec3(0.0), there_z = vec3(0.0);
#ifdef TRAVEL_TIME
        if (first == HIGH_FRONTS && u_region_band[n].w > 0.5) {
            for (int i = 0; i < end - first; ++i)
                add_swell(i, u_region_size[n * FRONTS + first + i], passing, point, before, there_x, there_y, there_z);
            plain = first;
        }
#endif
        for (int i = first; i < plain; ++i)
            add_front(i, u_region_way[n * FRONTS + i], u_region_size[n * FRONTS + i], first, point, before, there_x,
                      there_y, there_z);
        vec3 weight = region_weight(n, before);
        dx += d_mul(weight, there_x - dx);
        dy += d_mul(weight, there_y - dy);
        dz += d_mul(weight, there_z - dz);
    }
}
