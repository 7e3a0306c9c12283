// Height of the land's shadow over the whole level, by doubling: after k rounds a texel knows the highest of the rays
// that left 1 … 2^k texels towards the sun. Ten rounds of two fetches in place of a thousand steps.
#ifdef VERTEX
uniform vec2 u_corners[4];  // all of the map, or the strip that a change of the ground can shade

void main() { gl_Position = vec4(u_corners[gl_VertexID], 0.0, 1.0); }
#endif

#ifdef FRAGMENT
uniform vec2 u_step_uv;    // towards the sun, in texture coordinates
uniform float u_step_m;    // its length over the ground
uniform float u_rise_m;    // how much the sun's ray rises on the way
out vec2 out_shadow;

#ifdef START
uniform sampler2D u_height;
uniform vec2 u_target;     // size of the map

float ground(vec2 uv) {
    vec2 at = clamp(uv, 0.0, 1.0) * vec2(textureSize(u_height, 0) - 1);
    ivec2 cell = ivec2(at), last = textureSize(u_height, 0) - 1;
    vec2 f = at - vec2(cell);
    ivec2 next = min(cell + 1, last);
    float south = mix(texelFetch(u_height, cell, 0).r, texelFetch(u_height, ivec2(next.x, cell.y), 0).r, f.x);
    float north = mix(texelFetch(u_height, ivec2(cell.x, next.y), 0).r, texelFetch(u_height, next, 0).r, f.x);
    return mix(south, north, f.y);
}

void main() {
    vec2 uv = (gl_FragCoord.xy - 0.5) / max(u_target - 1.0, 1.0);
    out_shadow = vec2(ground(uv + u_step_uv) - u_rise_m, u_step_m);
}
#else
uniform sampler2D u_shadow;

void main() {
    vec2 size = vec2(textureSize(u_shadow, 0));
    vec2 here = texelFetch(u_shadow, ivec2(gl_FragCoord.xy), 0).rg;
    vec2 uv = (gl_FragCoord.xy - 0.5) / max(size - 1.0, 1.0) + u_step_uv;
    out_shadow = here;
    if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return;
    vec2 there = textureLod(u_shadow, (uv * (size - 1.0) + 0.5) / size, 0.0).rg;
    if (there.x - u_rise_m > here.x) out_shadow = vec2(there.x - u_rise_m, there.y + u_step_m);
}
#endif
#endif
