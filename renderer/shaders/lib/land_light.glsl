// What the land round a point does to its light: the coast in the water. The sky it hides: lib/openness.glsl.
#include "lib/height.glsl"

// Share of a mirror ray from the water that ends on land: seven heights along it.
float land_in_mirror(vec3 position, vec3 ray) {
    float hit = 0.0, way = 2.5;
    for (int i = 0; i < 7; ++i) {
        vec3 p = position + ray * way;
        float over = height_texel(ivec2(floor(p.xy / u_cell_m + 0.5))) - p.z;
        hit = max(hit, clamp(0.5 + over / (0.10 * way + 0.3), 0.0, 1.0));
        way *= 1.9;
    }
    return hit;
}
