// What the land round a point does to its light: the coast in the water. The sky it hides: lib/openness.glsl.
#include "lib/height.glsl"

// Share of a mirror ray from the water that ends on land: twelve heights along it, each the softer the further off.
float land_in_mirror(vec3 position, vec3 ray) {
    float hit = 0.0, way = 2.0;
    for (int i = 0; i < 12; ++i) {
        vec3 p = position + ray * way;
        float over = height_texel(ivec2(floor(p.xy / u_cell_m + 0.5))) - p.z;
        hit = max(hit, smoothstep(-1.0, 1.0, over / (0.16 * way + 0.5)));
        way *= 1.5;
    }
    return hit;
}
