// Heights of vertices that stand between the level's samples: a smooth surface through them and, nearer still, the
// relief of the materials. Both sides of a border ask for the same whole cell and get the same number.
uniform int u_relief_fine;        // cells of the level are 2^this mesh cells
uniform vec2 u_relief_fade_m;     // distance over which relief sinks into the ground
uniform float u_relief_cell_m;    // distance between vertices, a metre from the camera
uniform float u_ground_relief;

// Mean-free height that the materials add; less on sand by the water, whose edge it would move.
float material_relief(vec3 p, float away, float fade) {
    float height = p.z - u_still_m, pixel_m = max(u_mesh_cell_m, u_relief_cell_m * away);
    vec3 normal = ground_normal(ground_sample(p.xy).yz);
    Site site = terrain_site(p.xy, normal, height, torn_at(p.xy, pixel_m), pixel_m);
    ivec3 layers;
    vec3 shares;
    heaviest(site, layers, shares);
    Patch tile = small_patch(p.xy, site.broad, site.mid, pixel_m);
    float wave = smoothstep(u_swash_top_m, u_swash_top_m + 0.5, height) + 1.0 - smoothstep(-1.2, -0.5, height);
    float sum = 0.0;
    for (int k = 0; k < 2; ++k) {
        int layer = layers[k];
        if (shares[k] < LEAST) continue;
        float kept = layer == STRATA || layer == REEF ? 0.35 + 0.65 * wave : wave;
        sum += shares[k] * kept * u_ground_layers[layer].w
            * (ground_sampled(layer, p, normal, pixel_m, tile, bent_at(p.xy)).height - 0.5);
    }
    return u_ground_relief * fade * sum;
}

float relief_height(ivec2 cell) {
    ivec2 whole = cell >> u_relief_fine, rest = cell & ((1 << u_relief_fine) - 1);
    vec2 f = vec2(rest) / float(1 << u_relief_fine);
    float height = rest == ivec2(0) ? height_texel(whole) : height_between(whole, f);
    vec2 off = abs(mesh_relative(cell));
    float away = max(max(off.x, off.y), u_mesh_above_m);
    float fade = 1.0 - smoothstep(u_relief_fade_m.x, u_relief_fade_m.y, away);
    if (fade > 0.0 && u_ground_relief > 0.0)
        height += material_relief(vec3((vec2(whole) + f) * u_cell_m, height), away, fade);
    return height;
}
