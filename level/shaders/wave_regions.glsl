// Regions of swell: a second set of the sea's own fronts, displacements blended by weight (D32). The twin is
// level/wave_regions.py. Included by gerstner.glsl, whose fronts these are.
#include "level/wave_circle.glsl"

const int REGIONS_MOST = 4;

uniform int u_region_count;
uniform vec4 u_region_place[REGIONS_MOST];          // x, y, radius of its full weight, radius
uniform vec4 u_region_way[REGIONS_MOST * FRONTS];   // as u_front_way
uniform vec4 u_region_size[REGIONS_MOST * FRONTS];  // as u_front_size

void blend_regions(int first, int end, Deformed point, vec2 before, inout vec3 dx, inout vec3 dy, inout vec3 dz) {
    uint left = 0u;
    for (int n = 0; n < u_region_count; ++n) {
        vec2 off = before - u_region_place[n].xy;
        left |= dot(off, off) < u_region_place[n].w * u_region_place[n].w ? 1u << uint(n) : 0u;
    }
    for (; left != 0u; left &= left - 1u) {
        int n = findLSB(left);
        vec3 there_x = vec3(0.0), there_y = vec3(0.0), there_z = vec3(0.0);
        for (int i = first; i < end; ++i)
            add_front(i, u_region_way[n * FRONTS + i], u_region_size[n * FRONTS + i], first, point, before, there_x,
                      there_y, there_z);
        vec3 weight = circle_weight(u_region_place[n], before);
        dx += d_mul(weight, there_x - dx);
        dy += d_mul(weight, there_y - dy);
        dz += d_mul(weight, there_z - dz);
    }
}
