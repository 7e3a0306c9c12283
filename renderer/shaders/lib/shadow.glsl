// Sun visibility from the shadow maps. Land: up to which height a place lies in its shadow, and how far off the edge is
// that throws it. Scattered things (L03): heights of what stands between a place and the sun, in the world slid along the
// rays onto a level plane. A fetch or two serve land, water, its bed and haze.

uniform sampler2D u_shadow;  // RG32F over the level: height of the shadow m, way to what throws it m
uniform vec2 u_extent_m;
uniform float u_shadow_cell_m;
uniform float u_shadow_spread;  // metres of penumbra a metre of way
uniform bool u_light_shadows;
uniform sampler2D u_prop_shadow;  // depth: height over a square's middle, from its highest (0) to its lowest (1)
uniform vec4 u_prop_squares[2];   // near and far: middle in the slid world, half the side m; 0 where there is none
uniform vec2 u_prop_slant;        // metres towards the sun a metre up
uniform float u_prop_range;       // height that 0 and 1 stand for, m
uniform bool u_prop_soft;         // nine texels are weighed and not four

// Which of four texels leave a height in the sun, as textureGather orders them.
vec4 prop_lit(vec2 uv, float height) {
    return step((1.0 - 2.0 * textureGather(u_prop_shadow, uv)) * u_prop_range, vec4(height));
}

// Place in a square, −1 … 1 each way.
vec2 prop_place(vec3 position, vec4 square) {
    vec3 p = position - square.xyz;
    return (p.xy - u_prop_slant * p.z) / square.w;
}

// 1 in the sun, 0 in the shadow of a scattered thing; softened over a texel or three, faded out at the far border.
float prop_visibility(vec3 position) {
    if (u_prop_squares[0].w <= 0.0) return 1.0;
    vec2 at = prop_place(position, u_prop_squares[0]);
    bool near = max(abs(at.x), abs(at.y)) < 0.97;
    if (!near) at = prop_place(position, u_prop_squares[1]);
    float border = near ? 0.0 : max(abs(at.x), abs(at.y));
    if (border >= 1.0) return 1.0;
    vec2 size = vec2(textureSize(u_prop_shadow, 0));
    vec2 texel = (at * 0.5 + 0.5) * size.y - 0.5 + vec2(near ? 0.0 : size.y, 0.0);
    vec2 low = floor(texel), f = texel - low;
    vec4 square = u_prop_squares[near ? 0 : 1];
    // the map holds the far sides of things: light doesn't pass between one and the ground that it touches
    float height = position.z - square.z - 0.004 - 0.3 * square.w / size.y, lit;
    if (u_prop_soft) {
        vec4 sw = prop_lit(low / size, height), se = prop_lit((low + vec2(2.0, 0.0)) / size, height);
        vec4 nw = prop_lit((low + vec2(0.0, 2.0)) / size, height), ne = prop_lit((low + 2.0) / size, height);
        // rows from south to north, weights 1 − f, 1, 1, f each way
        vec4 rows[4] = vec4[4](vec4(sw.wz, se.wz), vec4(sw.xy, se.xy), vec4(nw.wz, ne.wz), vec4(nw.xy, ne.xy));
        vec4 across = vec4(1.0 - f.x, 1.0, 1.0, f.x);
        lit = (dot(rows[0], across) * (1.0 - f.y) + dot(rows[1] + rows[2], across) + dot(rows[3], across) * f.y) / 9.0;
    } else {
        vec4 four = prop_lit((low + 1.0) / size, height);
        vec2 across = vec2(1.0 - f.x, f.x);
        lit = mix(dot(four.wz, across), dot(four.xy, across), f.y);
    }
    return mix(lit, 1.0, smoothstep(0.85, 1.0, border));
}

#ifdef CLOUD_SHADOW
uniform sampler2D u_cloud_shadow;
uniform vec4 u_cloud_shadow_place;  // its middle east and north, half its side m, how dark shadows are
uniform vec2 u_cloud_shadow_slant;  // metres towards the sun a metre up
uniform float u_cloud_shadow_far;     // their mean
#endif

// What the clouds let through of the sun to a place (Z19); past the map's border their mean.
float cloud_visibility(vec3 position) {
#ifdef CLOUD_SHADOW
    vec2 foot = position.xy - u_cloud_shadow_slant * (position.z - u_level_sea_level_m) - u_cloud_shadow_place.xy;
    vec2 at = foot / u_cloud_shadow_place.z;
    float through = textureLod(u_cloud_shadow, at * 0.5 + 0.5, 0.0).r;
    through = mix(through, u_cloud_shadow_far, smoothstep(0.8, 1.0, max(abs(at.x), abs(at.y))));
    return mix(1.0, through, u_cloud_shadow_place.w);
#else
    return 1.0;
#endif
}

// 1 in the sun, 0 in the shadow; `position` in world metres.
float sun_visibility(vec3 position) {
    vec2 outside = max(-position.xy, position.xy - u_extent_m);
    float clouds = cloud_visibility(position);
    if (!u_light_shadows || max(outside.x, outside.y) > 0.0) return clouds;
    vec2 size = vec2(textureSize(u_shadow, 0));
    vec2 at = clamp(position.xy / u_extent_m, 0.0, 1.0) * (size - 1.0) + 0.5;
    vec2 shadow = textureLod(u_shadow, at / size, 0.0).rg;
    float soft = 0.02 + 0.12 * u_shadow_cell_m + u_shadow_spread * shadow.y;
    // the map ends with the level: its shadows fade out before, so that the border isn't drawn by them
    float within = smoothstep(0.0, min(12.0, 0.05 * min(u_extent_m.x, u_extent_m.y)), -max(outside.x, outside.y));
    return mix(1.0, smoothstep(-soft, soft, position.z - shadow.x), within) * prop_visibility(position) * clouds;
}
