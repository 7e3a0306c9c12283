// What wades and bursts in the water (D18). The twin is level/force.py: the same array, bilinear by hand.

uniform sampler2D u_force;     // push east, north m/s, lift m, foam
uniform vec4 u_force_place;    // world place of its first cell, metres a cell, 1 where something stirs

bool force_cell(vec2 xy, out ivec2 cell, out vec2 f) {
#ifdef NO_FORCE
    return false;
#endif
    if (u_force_place.w <= 0.0) return false;
    vec2 at = (xy - u_force_place.xy) / u_force_place.z;
    ivec2 last = textureSize(u_force, 0) - 1;
    if (any(lessThan(at, vec2(0.0))) || any(greaterThan(at, vec2(last)))) return false;
    cell = min(ivec2(floor(at)), last - 1);
    f = at - vec2(cell);
    return true;
}

vec4 force_at(vec2 xy) {
    ivec2 c;
    vec2 f;
    if (!force_cell(xy, c, f)) return vec4(0.0);
    vec4 south = mix(texelFetch(u_force, c, 0), texelFetch(u_force, c + ivec2(1, 0), 0), f.x);
    return mix(south, mix(texelFetch(u_force, c + ivec2(0, 1), 0), texelFetch(u_force, c + 1, 0), f.x), f.y);
}

// Height added, a dual.
vec3 force_lift(vec2 xy) {
    ivec2 c;
    vec2 f;
    if (!force_cell(xy, c, f)) return vec3(0.0);
    float v00 = texelFetch(u_force, c, 0).b, v10 = texelFetch(u_force, c + ivec2(1, 0), 0).b;
    float v01 = texelFetch(u_force, c + ivec2(0, 1), 0).b, v11 = texelFetch(u_force, c + 1, 0).b;
    float south = mix(v00, v10, f.x), north = mix(v01, v11, f.x);
    return vec3(mix(south, north, f.y), mix(v10 - v00, v11 - v01, f.y) / u_force_place.z, (north - south) / u_force_place.z);
}
