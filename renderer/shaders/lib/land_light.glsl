// What the land round a point does to its light and its wetness: open sky, the swash's film, the coast in the water.
#include "lib/height.glsl"

// Share of the sky that the land round a point leaves open, from twelve heights on three rings (a coarse horizon); and
// from the same heights how rough the ground is, as change of slope: a crease leaves one of four directions straight,
// broken rock bends them all.
float sky_open(vec2 xy, vec2 slope, out float rough) {
    const vec2 TURNS[3] = vec2[3](vec2(1.0, 0.0), vec2(0.7071, 0.7071), vec2(0.91, 0.414));
    const float RADII[3] = float[3](2.5, 8.0, 26.0);
    // rings are told from a sample to samples: rounding each would take a plain slope for a bent one
    ivec2 cell = ivec2(floor(xy / u_cell_m + 0.5));
    float middle = height_texel(cell), hidden = 0.0;
    rough = 10.0;
    for (int ring = 0; ring < 3; ++ring) {
        vec2 way = TURNS[ring], bend = vec2(0.0);
        for (int k = 0; k < 4; ++k) {
            float there = height_texel(cell + ivec2(round(way * (RADII[ring] / u_cell_m))));
            float rise = max((there - middle) / RADII[ring] - dot(slope, way), 0.0);
            hidden += rise * rise / (1.0 + rise * rise);
            bend[k & 1] += there - middle;
            way = vec2(-way.y, way.x);
        }
        // over three times the way broken rock bends a good half as much a metre
        if (ring < 2) rough = min(rough, min(abs(bend.x), abs(bend.y)) / RADII[ring] * (ring == 0 ? 1.0 : 1.6));
    }
    // beyond the border the land is made up: where it begins to sink is no crease
    vec2 within = min(xy, vec2(textureSize(u_height, 0) - 1) * u_cell_m - xy);
    rough *= smoothstep(9.0, 14.0, min(within.x, within.y));
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
