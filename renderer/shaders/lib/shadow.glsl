// Sun visibility from the shadow map: up to which height a place lies in the shadow of the land, and how far off the
// edge that throws it is. One fetch serves land, water, its bed and haze.

uniform sampler2D u_shadow;  // RG32F over the level: height of the shadow m, way to what throws it m
uniform vec2 u_extent_m;
uniform float u_shadow_cell_m;
uniform float u_shadow_spread;  // metres of penumbra a metre of way
uniform bool u_light_shadows;

// 1 in the sun, 0 in the shadow; `position` in world metres.
float sun_visibility(vec3 position) {
    vec2 outside = max(-position.xy, position.xy - u_extent_m);
    if (!u_light_shadows || max(outside.x, outside.y) > 0.0) return 1.0;
    vec2 size = vec2(textureSize(u_shadow, 0));
    vec2 at = clamp(position.xy / u_extent_m, 0.0, 1.0) * (size - 1.0) + 0.5;
    vec2 shadow = textureLod(u_shadow, at / size, 0.0).rg;
    float soft = 0.02 + 0.12 * u_shadow_cell_m + u_shadow_spread * shadow.y;
    return smoothstep(-soft, soft, position.z - shadow.x);
}
