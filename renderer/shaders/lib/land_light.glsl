// What the land round a point does to its light and its wetness: open sky, the swash's film, the coast in the water.
#include "lib/height.glsl"

// Share of the sky that the land round a point leaves open, from twelve heights on three rings (a coarse horizon).
float sky_open(vec2 xy, float height, vec2 slope) {
    const vec2 TURNS[3] = vec2[3](vec2(1.0, 0.0), vec2(0.866, 0.5), vec2(0.5, 0.866));
    const float RADII[3] = float[3](2.5, 8.0, 26.0);
    float hidden = 0.0;
    for (int ring = 0; ring < 3; ++ring) {
        vec2 way = TURNS[ring];
        for (int k = 0; k < 4; ++k) {
            vec2 off = way * RADII[ring];
            float there = height_texel(ivec2(floor((xy + off) / u_cell_m + 0.5)));
            float rise = max((there - height) / RADII[ring] - dot(slope, way), 0.0);
            hidden += rise * rise / (1.0 + rise * rise);
            way = vec2(-way.y, way.x);
        }
    }
    return clamp(1.0 - 0.2 * hidden, 0.3, 1.0);
}

// Share of a mirror ray from the water that ends on land: six heights along it.
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
