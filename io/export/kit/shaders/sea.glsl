#include "level/waves.glsl"
#include "level/flow_places.glsl"
#include "level/current.glsl"
#include "level/foam_amount.glsl"
#include "level/layer.glsl"

// The surface over a world point: the waves' shift to the side is undone step by step, to 0.1 mm. Under
// a breaker's lip there are three surfaces; this is the one that the steps come to.
Sea sea_at(vec2 world) {
    Sea sea = sea_surface(world);
    vec2 before = world, off = world - sea.position.xy;
    for (int i = 0; i < 12 && dot(off, off) > 1e-8; ++i) {
        before += off;
        sea = sea_surface(before);
        off = world - sea.position.xy;
    }
    return sea;
}

// The current in m/s to the east and to the north; beyond the level that of its border.
vec2 flow_at(vec2 xy) { return current_between(xy).xy; }

uniform sampler2D u_layer_foam;  // painted foam: what comes with the waves, what is always there
uniform float u_cell_m;          // between two samples of it and of the level's ground

// Amount of the sea's foam on a point of its surface, 0 … 1, before any texture: crests, what they leave behind, the sheet
// and its rim, whitecaps, paint. Rivers over the sea have none of it.
float foam_on(Sea sea) {
    vec2 before = on_face(sea.before, sea), painted = layer_at(u_layer_foam, sea.before, u_cell_m).xy;
    float amount = foam_amount(sea, before, water_column(sea, sea.position.z), 1.0, painted, current_at(sea.before), true, 0.0, 0.0).amount;
#ifdef RIVERS
    amount *= 1.0 - sea.river.share * smoothstep(RIVER_DROWNED_M.x, RIVER_DROWNED_M.y, sea.river.still);
#endif
    return amount;
}
