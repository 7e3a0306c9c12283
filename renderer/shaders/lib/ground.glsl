// Ground material by slope, height and paint: sand, rock, grass, sea floor; borders broken by noise, blended by height.
// Everything comes from two samplers; level of detail is explicit, so that fetches may stand in branches.
#include "lib/noise.glsl"

uniform sampler2DArray u_ground;      // layers sand, rock, grass, sea floor: slope east, slope north, height, tint
uniform float u_ground_sand_top_m;
uniform float u_ground_rock_slope;    // slopes as rise over run
uniform float u_ground_grass_slope;

const float SAND = 0.0, ROCK = 1.0, GRASS = 2.0, FLOOR = 3.0;
const float GROUND_TEXELS = 512.0;
const float FLAT_LOD = 6.5;      // from there on a layer is its mean: not worth the fetch
const float DARK_DEPTH_M = 30.0;  // no light comes back from deeper beds

struct Ground {
    vec3 albedo;
    vec3 normal;
    float roughness;
    float specular;   // reflectance seen from straight above
};

// One layer at a scale: slopes −1 … 1, height and tint 0 … 1.
vec4 ground_layer(vec2 xy, float tile_m, float layer, float pixel_m) {
    float lod = log2(max(pixel_m * GROUND_TEXELS / tile_m, 1e-4));
    if (lod > FLAT_LOD) return vec4(0.0, 0.0, 0.5, 0.5);
    vec4 v = textureLod(u_ground, vec3(xy / tile_m, layer), lod);
    return vec4(v.xy * 2.0 - 1.0, v.zw);
}

vec3 tilt(vec3 normal, vec2 slope) { return normalize(normal - vec3(slope, 0.0)); }

Ground sand_ground(vec3 p, vec3 n, float pixel_m, vec4 broad) {
    vec4 near = ground_layer(turn(p.xy, 0.36, 0.933), 4.3, SAND, pixel_m);
    vec4 far = ground_layer(turn(p.xy, -0.59, 0.807), 23.0, SAND, pixel_m);
    // the wind ripples come and go
    float combed = smoothstep(0.30, 0.75, broad.b * 0.5 + broad.g * 0.5);
    vec2 slope = turn(near.xy, -0.36, 0.933) * 0.16 + turn(far.xy, 0.59, 0.807) * (0.03 + 0.12 * combed);
    vec3 tint = mix(vec3(0.43, 0.355, 0.255), vec3(0.49, 0.42, 0.315), broad.r);
    tint *= 0.86 + 0.16 * near.w + 0.12 * (far.z - 0.5) + 0.16 * (broad.g - 0.35);
    // specks of shell and dark grains
    tint *= 1.0 - 0.35 * smoothstep(0.94, 1.0, near.w) * (1.0 - smoothstep(0.01, 0.08, pixel_m));
    return Ground(tint, tilt(n, slope), 0.9, 0.03);
}

// Three planes, weighed by the normal; `lean` returns the change of the normal, z the height, w the tint.
vec4 rock_layer(vec3 p, vec3 n, float tile_m, float pixel_m, out vec3 lean) {
    vec3 w = pow(abs(n), vec3(4.0));
    w /= w.x + w.y + w.z;
    vec4 sum = vec4(0.0);
    lean = vec3(0.0);
    if (w.z > 0.04) {
        vec4 v = ground_layer(p.xy, tile_m, ROCK, pixel_m);
        sum += v * w.z;
        lean += vec3(v.xy, 0.0) * w.z;
    }
    if (w.x > 0.04) {
        vec4 v = ground_layer(p.yz * vec2(1.0, 1.35), tile_m, ROCK, pixel_m);
        sum += v * w.x;
        lean += vec3(0.0, v.xy) * w.x;
    }
    if (w.y > 0.04) {
        vec4 v = ground_layer(p.xz * vec2(1.0, 1.35) + 3.7, tile_m, ROCK, pixel_m);
        sum += v * w.y;
        lean += vec3(v.x, 0.0, v.y) * w.y;
    }
    return sum;
}

Ground rock_ground(vec3 p, vec3 n, float height, float pixel_m, vec4 broad, vec4 mid) {
    vec3 lean, lean_far, lean_fine = vec3(0.0);
    vec4 near = rock_layer(p, n, 6.5, pixel_m, lean);
    vec4 far = rock_layer(p.yxz + 11.3, n.yxz, 31.0, pixel_m, lean_far);
    float close = 1.0 - smoothstep(0.012, 0.045, pixel_m);
    vec4 fine = vec4(0.0, 0.0, 0.5, 0.5);
    if (close > 0.0) fine = rock_layer(p.zxy + 4.9, n.zxy, 1.3, pixel_m, lean_fine);
    // beds of stone at three scales: thick bands of colour, courses, and thin lines; dipping and bent
    float bed = p.z + 0.11 * p.x - 0.07 * p.y + 3.2 * (broad.r - 0.5) + 0.8 * (far.z - 0.5);
    vec4 band = textureLod(u_noise, vec2(bed * 0.021, 0.37), log2(max(pixel_m * 10.0, 1.0)));
    vec4 course = textureLod(u_noise, vec2((bed + 0.25 * near.z) * 0.11, 0.71), log2(max(pixel_m * 56.0, 1.0)));
    float cliff = smoothstep(0.15, 0.6, 1.0 - n.z);
    vec3 tint = mix(vec3(0.165, 0.150, 0.135), vec3(0.36, 0.315, 0.255), smoothstep(0.25, 0.75, band.g));
    tint = mix(tint, vec3(0.40, 0.29, 0.19), 0.55 * smoothstep(0.62, 0.95, band.r));
    tint *= 0.44 + 0.50 * near.z + 0.42 * far.z + 0.22 * (near.w - 0.5) + 0.5 * (fine.z - 0.5);
    tint *= 0.75 + 0.5 * broad.g;
    // soft courses weather back: a dark joint under each ledge, most on cliffs
    float joint = 1.0 - smoothstep(0.05, 0.30, course.g);
    tint *= 1.0 + mix(0.25, 0.7, cliff) * (0.34 * (course.g - 0.5) + 0.22 * (course.b - 0.5) - 0.45 * joint);
    tint = mix(tint, vec3(0.34, 0.33, 0.26), 0.35 * smoothstep(0.72, 0.95, mid.g * 0.6 + near.w * 0.4)
                                                 * smoothstep(3.0, 9.0, height));  // lichen
    float ledge = 0.16 * (band.b - 0.5) + 0.55 * (course.g - 0.5) + 0.25 * (course.b - 0.5);
    vec3 normal = n - 0.55 * lean - 0.5 * lean_far.yxz - 0.45 * close * lean_fine.yzx;
    normal = normalize(normal + vec3(0.0, 0.0, ledge * cliff));
    return Ground(tint, normal, 0.82, 0.04);
}

Ground grass_ground(vec3 p, vec3 n, float height, float pixel_m, vec4 broad, vec4 mid) {
    vec4 near = ground_layer(turn(p.xy, 0.71, 0.704), 5.1, GRASS, pixel_m);
    vec4 far = ground_layer(p.xy, 37.0, GRASS, pixel_m);
    vec4 wide = noise_at(turn(p.xy, -0.8, 0.6), 710.0, pixel_m);
    // dry on open, sunward and steep ground, green in the broad hollows
    float dry = 0.55 * wide.g + 0.30 * broad.g + 0.20 * mid.r + 0.20 * far.w + 0.8 * (1.0 - n.z) - 0.15;
    dry = smoothstep(0.28, 0.72, dry);
    vec4 patchy = noise_at(turn(p.xy, 0.6, 0.8), 67.0, pixel_m);
    vec3 tint = mix(vec3(0.050, 0.074, 0.020), vec3(0.165, 0.132, 0.060), dry);
    tint *= 0.50 + 0.55 * near.z + 0.45 * far.z;
    // scrub in thickets, darker in the hollows of the broad noise
    float field = 0.26 * patchy.g + 0.40 * patchy.b + 0.75 * (1.0 - wide.r) + 0.16 * (near.z - 0.5);
    float scrub = smoothstep(0.78, 0.96, field) * smoothstep(2.5, 6.0, height);
    tint = mix(tint, vec3(0.026, 0.038, 0.015) * (0.55 + 0.9 * patchy.b + 0.3 * near.z), 0.75 * scrub);
    vec2 slope = turn(near.xy, -0.71, 0.704) * 0.55 + far.xy * 0.45;
    return Ground(tint, tilt(n, slope), 0.93, 0.03);
}

Ground floor_ground(vec3 p, vec3 n, float depth, float pixel_m, vec4 broad, vec4 mid) {
    vec4 near = ground_layer(turn(p.xy, 0.28, 0.96), 7.0, FLOOR, pixel_m);
    vec4 far = ground_layer(turn(p.xy, -0.5, 0.866), 29.0, FLOOR, pixel_m);
    float shallow = exp(-max(depth, 0.0) * 0.25);
    vec2 slope = turn(near.xy, -0.28, 0.96) * (0.12 + 0.12 * shallow) + turn(far.xy, 0.5, 0.866) * 0.15;
    vec3 tint = mix(vec3(0.40, 0.345, 0.255), vec3(0.47, 0.41, 0.31), broad.r) * (0.80 + 0.2 * near.z + 0.14 * far.z);
    float weed = smoothstep(0.60, 0.86, 0.60 * broad.r + 0.24 * broad.g + 0.12 * mid.g + 0.10 * near.z);
    weed *= smoothstep(1.2, 3.0, depth) * (1.0 - smoothstep(13.0, 22.0, depth));
    tint = mix(tint, vec3(0.055, 0.070, 0.030) * (0.7 + 0.9 * near.w), 0.82 * weed);
    return Ground(tint, tilt(n, slope), 0.9, 0.03);
}

Ground mix_ground(Ground a, Ground b, float t) {
    return Ground(mix(a.albedo, b.albedo, t), normalize(mix(a.normal, b.normal, t)), mix(a.roughness, b.roughness, t),
                  mix(a.specular, b.specular, t));
}

// `rough` change of slope round the place, `wet` 0 … 1 from the swash, `painted_cover` sand, rock, grass, always wet.
Ground ground_at(
    vec3 position, vec3 normal, float height_above_sea, float rough, float wet, vec4 painted_cover, float pixel_m
) {
    if (height_above_sea < -DARK_DEPTH_M) return Ground(vec3(0.3, 0.27, 0.2), normal, 0.9, 0.03);
    vec4 broad = noise_at(turn(position.xy, 0.43, 0.903), 173.0, pixel_m);
    vec4 mid = noise_at(turn(position.xy, -0.31, 0.951), 31.0, pixel_m);
    float h = height_above_sea;
    float rise = length(normal.xy) / max(normal.z, 0.05);
    float ragged = (mid.g - 0.5) * 0.55 + (mid.b - 0.5) * 0.35 + (broad.r - 0.5) * 0.5;

    float rock = smoothstep(0.85, 1.25, rise / u_ground_rock_slope + 0.5 * ragged);
    float steep = smoothstep(0.95, 1.45, rise / u_ground_grass_slope + 0.7 * ragged);
    float dry_land = smoothstep(-1.0, 1.0, (h - u_ground_sand_top_m) / 0.9 + 2.2 * ragged);
    float grass = dry_land * (1.0 - steep);
    rock = max(rock, dry_land * steep);
    // flat but broken ground by the sea is a platform of rock, not a beach
    rock = max(rock, smoothstep(0.085, 0.17, rough + 0.02 * ragged) * (1.0 - dry_land) * smoothstep(-0.3, 0.5, h));
    rock = mix(rock, 1.0, painted_cover.g) * (1.0 - max(painted_cover.r, painted_cover.b));
    grass = mix(grass * (1.0 - painted_cover.r), 1.0, painted_cover.b);

    Ground g;
    if (h < -0.6) g = floor_ground(position, normal, -h, pixel_m, broad, mid);
    else {
        g = sand_ground(position, normal, pixel_m, broad);
        if (h < 0.0) g = mix_ground(g, floor_ground(position, normal, -h, pixel_m, broad, mid), -h / 0.6);
    }
    if (grass > 0.01) {
        Ground turf = grass_ground(position, normal, h, pixel_m, broad, mid);
        g = mix_ground(g, turf, height_blend(grass, 0.5 * mid.g, mid.b * 0.7 + 0.1, 0.25));
    }
    float splash = 0.0;
    if (rock > 0.01) {
        Ground stone = rock_ground(position, normal, h, pixel_m, broad, mid);
        // dark and slimy up to where the splash reaches
        splash = 1.0 - smoothstep(0.9, 2.6, h + 1.6 * ragged);
        stone.albedo *= mix(vec3(1.0), vec3(0.42, 0.43, 0.40), splash);
        stone.roughness = mix(stone.roughness, 0.42, splash * smoothstep(-0.3, 0.2, h));
        float t = height_blend(rock, 0.35 * mid.b, 0.55 * mid.g, 0.3);
        g = mix_ground(g, stone, t);
        wet *= 1.0 - 0.7 * t;
    }
    wet = max(wet, painted_cover.a) * smoothstep(-0.5, -0.1, h);
    // a film of water darkens what it fills and lies smoother than the grains
    g.albedo *= mix(vec3(1.0), vec3(0.50, 0.49, 0.48), wet);
    g.roughness = mix(g.roughness, 0.30, wet);
    g.specular = mix(g.specular, 0.025, wet);
    g.normal = normalize(mix(g.normal, normal, 0.75 * wet));
    return g;
}

