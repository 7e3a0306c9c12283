// Ground by rule (L05): weights of eight materials from slope, height, roughness, open sky, water and paint; the two or
// three heaviest are sampled and meet by height.
#include "lib/ground_layers.glsl"

uniform float u_ground_sand_top_m;
uniform float u_ground_rock_slope;    // slopes as rise over run
uniform float u_ground_grass_slope;
uniform float u_ground_shingle, u_ground_weed, u_ground_macro, u_ground_detail;
uniform float u_swash_top_m;          // how high the shore waves run up
uniform float u_wet_splash_m;         // and over it the splash on rock

#ifndef MOST_LAYERS
#define MOST_LAYERS 2  // sampled at a pixel
#endif
const float DARK_DEPTH_M = 30.0;  // no light comes back from deeper beds
const float LEAST = 0.04;         // a lighter layer isn't worth its fetches

struct Ground {
    vec3 albedo;
    vec3 normal;
    float roughness;
    float specular;   // reflectance seen from straight above
};

// What is known of a place before its materials are chosen.
struct Site {
    vec3 normal;
    float height;     // over the still sea
    float rough;      // change of slope round it
    float open;       // share of the sky it sees
    vec4 cover;       // painted: sand, rock, grass, always wet
    vec4 broad, mid;  // noise
    Patch wide;       // its shifts
    float ragged;     // about −0.5 … 0.5
};

Site site_at(vec2 xy, vec3 normal, float height, float rough, float open, vec4 cover, float pixel_m) {
    Patch wide = wide_patch(xy, pixel_m);
    vec4 broad = free_noise(turn(xy, 0.43, 0.903), 173.0, pixel_m, wide);
    vec4 mid = free_noise(turn(xy, -0.31, 0.951), 31.0, pixel_m, wide);
    float ragged = (mid.g - 0.5) * 0.55 + (mid.b - 0.5) * 0.35 + (broad.r - 0.5) * 0.5;
    return Site(normal, height, rough, open, cover, broad, mid, wide, ragged);
}

// How far the larger scale of the materials is moved here.
// Worked out and not looked up: a texture's 256 steps, made metres, would show.
vec2 bent_at(vec2 xy) {
    return 4.4 * vec2(sin(0.031 * xy.x + 1.7 * sin(0.017 * xy.y)) + 0.6 * sin(0.083 * xy.y + 1.1 * sin(0.041 * xy.x)),
                      sin(0.029 * xy.y + 1.9 * sin(0.019 * xy.x + 2.0)) + 0.6 * sin(0.077 * xy.x + sin(0.053 * xy.y)));
}

void lay_over(inout float weights[LAYERS], int layer, float share) {
    for (int i = 0; i < LAYERS; ++i) weights[i] *= 1.0 - share;
    weights[layer] += share;
}

// Where a patchy thing lies: noise spread evenly over 0 … 1 above what leaves `amount` of it.
float patches(float field, float amount, float edge) {
    return smoothstep(-edge, edge, field - mix(0.86, 0.14, amount)) * step(1e-4, amount);
}

// Pebbles where the swash ends and at the feet of cliffs.
float shingle_share(Site s, float rise) {
    float top = max(u_swash_top_m, 0.2), h = s.height + 0.4 * s.ragged;
    float swash = smoothstep(0.30 * top, 0.80 * top, h) * (1.0 - smoothstep(1.15 * top, 1.8 * top + 0.2, h));
    swash *= patches(0.55 * s.broad.r + 0.30 * s.broad.g + 0.15 * s.mid.r, u_ground_shingle, 0.10);
    float foot = (1.0 - smoothstep(0.84, 0.94, s.open + 0.14 * s.ragged)) * smoothstep(-0.9, 0.2, s.height)
        * (1.0 - smoothstep(u_ground_sand_top_m, u_ground_sand_top_m + 3.0, h)) * min(2.0 * u_ground_shingle, 1.0);
    return max(swash, foot) * (1.0 - smoothstep(0.45, 0.8, rise));
}

void ground_weights(Site s, out float weights[LAYERS]) {
    float h = s.height, ragged = s.ragged, rise = length(s.normal.xy) / max(s.normal.z, 0.05);
    float rock = smoothstep(0.85, 1.25, rise / u_ground_rock_slope + 0.5 * ragged);
    float steep = smoothstep(0.95, 1.45, rise / u_ground_grass_slope + 0.7 * ragged);
    float dry_land = smoothstep(-1.0, 1.0, (h - u_ground_sand_top_m) / 0.9 + 2.2 * ragged);
    float grass = dry_land * (1.0 - steep);
    rock = max(rock, dry_land * steep);
    // flat but broken ground by the sea is a reef, not a beach
    rock = max(rock, smoothstep(0.085, 0.17, s.rough + 0.02 * ragged) * (1.0 - dry_land));
    rock = mix(rock, 1.0, s.cover.g) * (1.0 - max(s.cover.r, s.cover.b));
    grass = mix(grass * (1.0 - s.cover.r), 1.0, s.cover.b);
    float cliff = smoothstep(0.34, 0.58, rise + 0.25 * ragged);
    float seaward = 1.0 - smoothstep(0.6, 3.4, h - u_ground_sand_top_m + 3.5 * ragged);
    seaward *= 1.0 - smoothstep(0.5, 0.9, rise);
    float bed = -h + 0.3 * ragged;

    for (int i = 0; i < LAYERS; ++i) weights[i] = 0.0;
    weights[SAND] = 1.0;
    lay_over(weights, FLOOR, smoothstep(0.1, 0.7, bed) * (1.0 - s.cover.r));
    if (h > -1.0) lay_over(weights, SHINGLE, shingle_share(s, rise) * (1.0 - s.cover.r));
    lay_over(weights, GRASS, grass * (1.0 - seaward));
    lay_over(weights, DUNE, grass * seaward);
    lay_over(weights, STRATA, rock * cliff);
    lay_over(weights, REEF, rock * (1.0 - cliff));
    if (bed > 0.2) {
        float field = 0.60 * s.broad.r + 0.24 * s.broad.g + 0.16 * s.mid.g;
        float meadow = patches(field, 0.62 * u_ground_weed, 0.14) * smoothstep(1.6, 3.2, bed) * (1.0 - smoothstep(12.0, 18.0, bed));
        float on_rock = patches(0.5 * s.mid.r + 0.5 * s.mid.g, u_ground_weed, 0.14) * smoothstep(0.2, 0.8, bed)
            * (1.0 - smoothstep(12.0, 18.0, bed));
        lay_over(weights, WEED, mix(meadow, on_rock, rock) * (1.0 - s.cover.r));
    }
}

// The heaviest layers of a place, heaviest first.
void heaviest(Site s, out ivec3 layers, out vec3 shares) {
    float weights[LAYERS];
    ground_weights(s, weights);
    layers = ivec3(0);
    shares = vec3(-1.0);
    for (int i = 0; i < LAYERS; ++i) {
        float w = weights[i];
        if (w > shares.x) {
            shares = vec3(w, shares.xy);
            layers = ivec3(i, layers.xy);
        } else if (w > shares.y) {
            shares.yz = vec2(w, shares.y);
            layers.yz = ivec2(i, layers.y);
        } else if (w > shares.z) {
            shares.z = w;
            layers.z = i;
        }
    }
}

// Broad change of colour over many tiles, by kind of material; the mean of each is about one.
struct Macro { vec3 sand, grass, rock; };

Macro macro_at(vec3 p, Site s, float pixel_m) {
    vec4 broad = s.broad, mid = s.mid;
    vec3 sand = mix(vec3(0.93, 0.91, 0.88), vec3(1.07, 1.08, 1.11), broad.r);
    sand *= 1.0 + 0.18 * (broad.g - 0.5) + 0.12 * (mid.r - 0.5);

    vec4 wide = noise_at(turn(p.xy, -0.8, 0.6), 710.0, pixel_m), patchy = free_noise(turn(p.xy, 0.6, 0.8), 67.0, pixel_m, s.wide);
    // dry on steep ground, green in the broad hollows
    float dry = 0.55 * wide.g + 0.30 * broad.g + 0.22 * mid.r + 0.8 * (1.0 - s.normal.z) + 0.16 * (patchy.b - 0.5) - 0.05;
    vec3 grass = mix(vec3(0.88, 0.95, 1.00), vec3(1.52, 1.15, 1.12), smoothstep(0.20, 0.86, dry));
    // scrub in thickets
    float scrub = smoothstep(0.74, 0.98, 0.45 * patchy.r + 0.25 * patchy.b + 0.55 * (1.0 - wide.r) + 0.25 * (mid.b - 0.5));
    grass = mix(grass, vec3(0.50, 0.56, 0.58), 0.85 * scrub * smoothstep(2.5, 6.0, s.height));

    // beds of stone: thick bands of colour and courses, dipping and bent; the textures have the thin lines
    vec2 bent = bent_at(p.xy);
    float bed = p.z + 0.11 * p.x - 0.07 * p.y + 0.45 * (bent.x + bent.y) + 1.6 * (broad.r - 0.5)
        + 0.7 * sin(0.21 * p.x + 1.9 * sin(0.13 * p.y)) + 0.7 * sin(0.17 * p.y + 1.7 * sin(0.15 * p.x));
    vec4 band = textureLod(u_noise, vec2(bed * 0.021, 0.37), log2(max(pixel_m * 10.0, 1.0)));
    vec3 rock = mix(vec3(0.72, 0.72, 0.74), vec3(1.22, 1.20, 1.16), smoothstep(0.25, 0.75, band.g));
    rock = mix(rock, vec3(1.30, 1.04, 0.80), 0.6 * smoothstep(0.62, 0.95, band.r));
    vec4 course = textureLod(u_noise, vec2((bed + 0.08 * mid.b) * 0.11, 0.71), log2(max(pixel_m * 56.0, 1.0)));
    float cliff = smoothstep(0.15, 0.5, 1.0 - s.normal.z);
    rock *= 1.0 + cliff * (0.30 * (course.g - 0.5) - 0.40 * (1.0 - smoothstep(0.05, 0.30, course.g)));
    return Macro(sand, grass * (1.05 + 0.25 * (mid.g - 0.5)), rock * (0.82 + 0.36 * broad.g));
}

vec3 macro_tint(Macro macro, int layer) {
    if (layer == GRASS) return macro.grass;
    if (layer == DUNE) return mix(vec3(0.97, 0.99, 0.95), macro.grass / 1.2, 0.3);  // half of it is sand
    if (layer == STRATA || layer == REEF) return macro.rock;
    return layer == WEED ? vec3(1.0) : macro.sand;
}

// The mean square of the slopes that a pixel can't show makes it rougher: alpha² + variance (Cox & Munk 1954; L04).
float rougher(float roughness, float variance) {
    float alpha = roughness * roughness;
    return min(sqrt(sqrt(alpha * alpha + variance)), 1.0);
}

// Dark and slimy rock, up to where the splash reaches; the weight of rock.
float splash_on(inout Ground g, Site s, float rock) {
    float top = max(u_swash_top_m + u_wet_splash_m, 0.01);
    float splash = rock * (1.0 - smoothstep(0.5 * top, 1.25 * top, s.height + 1.2 * s.ragged));
    g.albedo *= mix(vec3(1.0), vec3(0.42, 0.43, 0.40), splash);
    g.roughness = mix(g.roughness, 0.45, splash * smoothstep(-0.3, 0.2, s.height));
    return splash;
}

// A film of water darkens what it fills and lies smoother than the grains.
void wet_through(inout Ground g, vec3 normal, float wet) {
    g.albedo *= mix(vec3(1.0), vec3(0.50, 0.49, 0.48), wet);
    g.roughness = mix(g.roughness, 0.30, wet);
    g.specular = mix(g.specular, 0.025, wet);
    g.normal = normalize(mix(g.normal, normal, 0.75 * wet));  // and the sheet levels the ripples
}

// `wet` 0 … 1 from the swash; `layer` is the one that shows most.
Ground ground_at(vec3 position, Site s, float wet, float pixel_m, out int layer) {
    layer = FLOOR;
    if (s.height < -DARK_DEPTH_M) return Ground(vec3(0.3, 0.27, 0.2), s.normal, 0.9, 0.03);
    ivec3 layers;
    vec3 shares;
    heaviest(s, layers, shares);
    Patch tile = small_patch(position.xy, s.broad, s.mid, pixel_m);
    Macro macro = macro_at(position, s, pixel_m);
    Sample samples[MOST_LAYERS];
    float over[MOST_LAYERS];
    float most = 0.0;
    for (int k = 0; k < MOST_LAYERS; ++k) {
        over[k] = -9.0;
        if (shares[k] < LEAST) continue;
        samples[k] = ground_sampled(layers[k], position, s.normal, pixel_m, tile, bent_at(position.xy));
        vec3 tint = macro_tint(macro, layers[k]);
        if (layers[k] == SAND) samples[k].lean *= mix(0.25, 1.1, smoothstep(0.3, 0.7, 0.6 * s.mid.g + 0.4 * s.broad.b));
        samples[k].albedo *= mix(vec3(1.0), tint, u_ground_macro);
        over[k] = 1.6 * shares[k] + 0.8 * samples[k].height;  // who stands higher covers the other
        most = max(most, over[k]);
    }
    // from afar a pixel holds many heights: there the two mix by their shares
    float depth = 0.3 + 1.1 * smoothstep(0.03, 0.5, pixel_m);
    vec3 albedo = vec3(0.0), lean = vec3(0.0);
    float sum = 0.0, roughness = 0.0, variance = 0.0, rock = 0.0, best = 0.0;
    for (int k = 0; k < MOST_LAYERS; ++k) {
        if (shares[k] < LEAST) continue;
        float part = max(over[k] - most + depth, 0.0) * smoothstep(LEAST, 3.0 * LEAST, shares[k]);
        albedo += part * samples[k].albedo;
        lean += part * samples[k].lean;
        roughness += part * samples[k].roughness;
        variance += part * samples[k].variance;
        rock += part * float(layers[k] == STRATA || layers[k] == REEF);
        sum += part;
        if (part > best) layer = layers[k];
        best = max(best, part);
    }
    sum = 1.0 / max(sum, 1e-5);
    float detail = u_ground_detail;
    lean *= detail * sum;
    lean *= inversesqrt(1.0 + 0.8 * dot(lean, lean));  // steeper grains shade each other and would turn black
    Ground g = Ground(min(albedo * sum, 0.9), normalize(s.normal - lean),
                      rougher(roughness * sum, detail * detail * variance * sum), 0.03);
    splash_on(g, s, rock * sum);
    wet = max(wet * (1.0 - 0.7 * rock * sum), s.cover.a) * smoothstep(-0.5, -0.1, s.height);
    wet_through(g, s.normal, wet);
    return g;
}
