// The current as engines get it: the exporters' own bytes, decoded as level/flow_bytes.py has it (T02).
uniform sampler2D u_flow_bytes;
uniform float u_flow_bytes_cell_m, u_flow_range_mps;

const float FLOW_NEUTRAL = 128.0, FLOW_MOST = 127.0, FLOW_STILL_STEPS = 0.5;

// East and north in steps of the map, 0 where water is still; clamped at the border.
vec2 flow_steps(vec2 xy) {
    vec2 at = (xy / u_flow_bytes_cell_m + 0.5) / vec2(textureSize(u_flow_bytes, 0));
    vec2 steps = textureLod(u_flow_bytes, at, 0.0).rg * 255.0 - FLOW_NEUTRAL;
    return max(abs(steps.x), abs(steps.y)) < FLOW_STILL_STEPS ? vec2(0.0) : steps;
}

// Foam `wide` times as large as it is, moved in two phases.
float flow_foam(vec2 xy, vec2 flow, float wide, float lod) {
    vec2 first, second;
    float weight, lee;
    foam_places(xy / wide, flow / wide, first, second, weight);
    return foam_pair(first, second, weight, vec2(0.0), max(lod - log2(wide), 0.0), lee).g + 0.5;
}

// Foam on dark water, moved by the bytes alone, larger from afar so that its way is seen; orange where they are at
// their end.
vec3 flow_exported(vec2 xy, float pixel_m) {
    vec2 steps = flow_steps(xy), flow = steps * (u_flow_range_mps / FLOW_MOST);
    float lod = log2(max(pixel_m * FOAM_TEXELS / u_foam_tile_m, 1e-4)), octave = max(lod - 2.0, 0.0);
    float wide = exp2(floor(octave)), part = smoothstep(0.3, 0.7, fract(octave));
    float field = mix(flow_foam(xy, flow, wide, lod), flow_foam(xy, flow, 2.0 * wide, lod), part);
    float clipped = step(FLOW_MOST - 0.5, max(abs(steps.x), abs(steps.y)));
    vec3 water = mix(vec3(0.03, 0.10, 0.18), vec3(0.80, 0.86, 0.88), smoothstep(0.45, 0.85, field));
    return mix(water, vec3(1.0, 0.42, 0.05), 0.65 * clipped);
}

// How far the bytes are off the current, in steps of the map.
float flow_lost(vec2 xy) {
    return length(current_at(xy).rg * (FLOW_MOST / u_flow_range_mps) - flow_steps(xy));
}
