// How water looks that isn't the sea (D14 to D17, D19): where it goes, its ripples, its two layers of foam. There are no
// foam lines by depth: they would jump with every step of the bed (Diablo IV talk).
#include "level/river.glsl"
#include "level/noise.glsl"
#include "lib/foam.glsl"
#include "level/current.glsl"

uniform vec3 u_river_cycle;  // as u_foam_cycle: part of a cycle, number of whole ones, seconds a cycle
uniform float u_river_turns;
uniform float u_river_curl, u_river_curl_m;
uniform float u_river_speed_foam, u_river_speed_low_mps, u_river_speed_high_mps;
uniform float u_river_fall_foam, u_river_fall_low_deg, u_river_fall_high_deg;
uniform float u_river_wake_foam, u_river_fall_clear_m, u_river_strand_m;
uniform float u_river_turbulent, u_river_turbulent_tile_m, u_river_turbulent_albedo, u_river_streak_m;
uniform float u_river_stagnant, u_river_stagnant_still, u_river_stagnant_mps, u_river_stagnant_tile_m;
uniform float u_river_stagnant_albedo, u_river_stagnant_algae, u_river_stagnant_shadow, u_river_cut_mps;

// What a river does at a place.
struct Stream {
    float share;  // of its water, far out into the sea
    float own;    // 1 where its rules alone hold, 0 where the sea's waves come whole
    vec2 raw;     // current, m/s
    vec2 eddies;  // curl noise
    vec2 flow;    // their sum, with what pushes the water
    float lean;   // steepness of its level, degrees
    float rough;  // 0 … 1
    vec2 way;     // downstream
    float fallen; // metres that it has come down over the last few
    float drops;  // 1 where it falls free, 0 where it runs over its bed
    float boils;  // 1 at the foot of a fall, 0 where it has calmed down
    float spent;  // head in metres that its speed has lost: behind and before boulders, under narrows; <0 gained
};

// How far back upstream a place looks for what it has come over: a fall's lip, the boils' end, a boulder's lee.
const float LIP_M = 6.0, BOIL_M = 13.0, LEE_M = 2.2, EARTH_G = 9.81;

// The map evened out over a cell, with slopes that have no steps: level over the sea, a dual, and the way downstream. A
// quadratic B-spline through nine samples.
vec3 river_level(vec2 xy, out vec2 way) {
    ivec2 size = bed_size();
    vec2 at = clamp(xy / u_bed_cell_m, vec2(1.0), vec2(size) - 2.0), middle = floor(at + 0.5), f = at - middle;
    vec2 w[3] = vec2[3](0.5 * (0.5 - f) * (0.5 - f), 0.75 - f * f, 0.5 * (0.5 + f) * (0.5 + f));
    vec2 d[3] = vec2[3](f - 0.5, -2.0 * f, f + 0.5);
    ivec2 cell = ivec2(middle) + ivec2(0, size.y);
    float here_m = texelFetch(u_bed, cell, 0).z;
    vec3 level = vec3(0.0);
    way = vec2(0.0);
    for (int i = 0; i < 9; ++i) {
        ivec2 k = ivec2(i % 3, i / 3);
        vec4 v = texelFetch(u_bed, cell + k - 1, 0);
        vec2 slope = vec2(d[k.x].x * w[k.y].y, w[k.x].x * d[k.y].y) / u_bed_cell_m;
        level += v.x * vec3(w[k.x].x * w[k.y].y, slope);
        way += (v.y > 0.0 ? v.z : here_m) * slope;
    }
    float length_m = length(way);
    way = length_m > 0.3 ? way / length_m : vec2(0.0);
    return over_sea(level - vec3(u_tide_m, 0.0, 0.0));
}

// Level alone, over the sea.
float river_stage(vec2 xy) {
    ivec2 size = bed_size();
    vec2 at = clamp(xy / u_bed_cell_m, vec2(0.0), vec2(size) - 1.001), f = fract(at);
    ivec2 cell = ivec2(at) + ivec2(0, size.y);
    vec2 south = vec2(texelFetch(u_bed, cell, 0).x, texelFetch(u_bed, cell + ivec2(1, 0), 0).x);
    vec2 north = vec2(texelFetch(u_bed, cell + ivec2(0, 1), 0).x, texelFetch(u_bed, cell + 1, 0).x);
    vec2 column = mix(south, north, f.y);
    return max(mix(column.x, column.y, f.x) - u_tide_m, 0.0);
}

// What the water has come over: metres fallen, whether it falls free, how it boils, head spent.
vec4 river_past(vec2 xy, vec2 way, float level_m, float lean, vec2 current) {
    if (dot(way, way) < 0.5) return vec4(0.0);
    float lip_m = river_stage(xy - LIP_M * way), fallen = max(lip_m - level_m, 0.0);
    float before = max(river_stage(xy - BOIL_M * way) - level_m, 0.0), boils = 0.0;
    float calm = 1.0 - smoothstep(15.0, 40.0, lean);
    // a long slide has no lip to fall from: steep above as well
    float slide = smoothstep(1.2, 3.0, before - fallen) * (1.0 - calm);
    boils = calm * max(smoothstep(0.5, 2.6, fallen), 0.62 * smoothstep(1.0, 4.0, before));
    vec2 came = current_at(xy - LEE_M * way).rg;
    float spent = (dot(came, came) - dot(current, current)) / (2.0 * EARTH_G);
    return vec4(fallen, (1.0 - calm) * (1.0 - slide), boils, spent);
}

// Curl of a noise: eddies that neither gather nor thin out what they carry, as fast as the flow's `speed` at most.
vec2 curl_noise(vec2 xy, float speed, float pixel_m) {
    float side = 9.0 * u_river_curl_m, off = 0.16 * u_river_curl_m, p = max(pixel_m, off);
    float east = noise_at(xy + vec2(off, 0.0), side, p).g - noise_at(xy - vec2(off, 0.0), side, p).g;
    float north = noise_at(xy + vec2(0.0, off), side, p).g - noise_at(xy - vec2(0.0, off), side, p).g;
    return vec2(north, -east) * (u_river_curl * speed * 0.5 * u_river_curl_m / off);
}

// `current` as current_at has it, `force` as force_at.
Stream stream_at(River river, vec2 before, vec2 current, vec2 force, float pixel_m) {
    vec2 way, eddies = vec2(0.0);
    vec3 level = river_level(before, way);
    float share = smoothstep(0.0, 0.6, river.share), own = share * (1.0 - river.waves.x);
    if (u_river_curl > 0.0) eddies = share * curl_noise(before, length(current), pixel_m);
    float lean = degrees(atan(length(level.yz)));
    vec4 past = share > 0.05 ? share * river_past(before, way, level.x, lean, current) : vec4(0.0);
    return Stream(share, own, current, eddies, current + eddies + force, lean, river.rough, way,
                  past.x, past.y, past.z, past.w);
}

// Two copies half a cycle apart, as foam_places has them, with the river's own cycle: metres to where each is read, tiles
// to jump aside, weight of the second.
void river_phases(vec2 xy, vec2 flow, out vec4 way, out vec4 jump, out float weight) {
    way = vec4(0.0);
    jump = vec4(0.0, 0.0, OTHER);
    weight = 0.0;
#ifndef NO_FLOW
    if (u_river_cycle.z <= 0.0) return;
    float early = textureLod(u_noise, xy / 60.0, 3.0).g;
    float a = u_river_cycle.x + early, b = a + 0.5;
    vec2 number = floor(vec2(a, b)) + u_river_cycle.y;
    if (u_river_turns > 0.0) number = mod(number, u_river_turns);
    way = -u_river_cycle.z * vec4(flow * (fract(a) - 0.5), flow * (fract(b) - 0.5));
    jump = vec4(JUMP * number.x, JUMP.yx * number.y + OTHER);
    weight = abs(2.0 * fract(a) - 1.0);
#endif
}

// Two weighted copies keep the contrast of one about their mean.
vec4 river_mixed(vec4 a, vec4 b, float weight, vec4 mean) {
    return mean + (mix(a, b, weight) - mean) / sqrt(weight * weight + (1.0 - weight) * (1.0 - weight));
}

vec4 river_tiled(sampler2D image, vec2 xy, float tile_m, float lod, vec4 way, vec4 jump, float weight, vec4 mean) {
    vec4 a = textureLod(image, (xy + way.xy) / tile_m + jump.xy, lod);
    vec4 b = textureLod(image, (xy + way.zw) / tile_m + jump.zw, lod);
    return river_mixed(a, b, weight, mean);
}

float foam_lod(float tile_m, float pixel_m) { return max(log2(max(pixel_m * FOAM_TEXELS / tile_m, 1e-4)), 0.0); }

// Bright and streaky: noise averaged down the flow draws threads, the foam's own texture tears them (D14).
Foam turbulent_foam(vec2 xy, vec2 flow, float amount, float pixel_m) {
    if (amount < 0.004) return NO_FOAM;
    float tile_m = u_river_turbulent_tile_m, lod = foam_lod(tile_m, pixel_m), weight;
    vec4 way, jump;
    river_phases(xy, flow, way, jump, weight);
    vec4 fields = river_tiled(u_foam, xy, tile_m, lod, way, jump, weight, vec4(0.5, 0.5, 0.5, 0.35));
    vec2 drawn = flow * (u_river_streak_m / 3.0);
    float most = 4.0 * tile_m;
    drawn *= min(1.0, most / max(length(drawn), 1e-4));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 at = xy + drawn * (float(i) - 1.5);
        sum += 0.25 * river_tiled(u_noise, at, 1.6 * tile_m, foam_lod(1.6 * tile_m, pixel_m), way, jump, weight, vec4(0.5));
    }
    float thread = clamp(0.5 + 1.7 * (0.6 * sum.g + 0.4 * sum.b - 0.5), 0.0, 1.0);
    // boils and slicks: what rises between them is clear
    amount = mix(saturate(amount * (0.1 + 1.8 * smoothstep(0.2, 0.8, sum.r))), amount, amount * amount);
    vec4 torn = fields;
    torn.rgb = clamp(0.5 + 0.55 * (fields.rgb - 0.5) + 0.75 * (thread - 0.5), 0.0, 1.0);
    float cover = foam_cover(torn, amount, lod);
    // on a fall, white all over, the threads alone show which way it goes
    cover = saturate(cover * (0.72 + 0.25 * fields.a + 0.18 * fields.g) * mix(0.62, 1.14, thread));
    return Foam(cover, amount, smoothstep(0.1, 0.8, amount), saturate(0.25 + 0.5 * thread + 0.5 * (fields.b - 0.5)), 0.7);
}

// A slow film: rafts with soft edges and holes, hardly any threads (D14).
Foam stagnant_foam(vec2 xy, vec2 flow, float amount, float pixel_m) {
    if (amount < 0.004) return NO_FOAM;
    float tile_m = u_river_stagnant_tile_m, lod = foam_lod(tile_m, pixel_m), weight;
    vec4 way, jump;
    river_phases(xy, flow, way, jump, weight);
    vec4 fields = river_tiled(u_foam, xy, tile_m, lod + 1.0, way, jump, weight, vec4(0.5, 0.5, 0.5, 0.35));
    vec4 rafts = river_tiled(u_noise, xy, 2.3 * tile_m, foam_lod(2.3 * tile_m, pixel_m), way, jump, weight, vec4(0.5));
    float film = clamp(0.5 + 1.15 * (0.55 * rafts.g + 0.25 * rafts.b + 0.2 * (1.0 - fields.b) - 0.5), 0.0, 1.0);
    float wide = mix(0.13, 0.6, smoothstep(1.0, 6.0, lod));
    float cover = smoothstep(-wide, wide, film - (1.0 - amount)) * smoothstep(0.0, 0.1, amount);
    cover *= mix(0.55, 0.95, smoothstep(0.0, 0.5, film - (1.0 - amount) + 0.3 * fields.g));
    return Foam(cover, amount, 0.0, saturate(0.35 + 0.4 * fields.g), 0.0);
}

float speed_foam(vec2 flow) {
    return smoothstep(u_river_speed_low_mps, max(u_river_speed_high_mps, u_river_speed_low_mps + 1e-3), length(flow));
}

float fall_foam(float lean) {
    return smoothstep(u_river_fall_low_deg, max(u_river_fall_high_deg, u_river_fall_low_deg + 0.1), lean);
}

// Amount of turbulent foam: by speed (D15) and by the lean of the water's own level (D16) together, then the paint.
float turbulent_amount(Stream s, float painted, bool procedural) {
    float made = 1.0 - (1.0 - u_river_speed_foam * speed_foam(s.raw)) * (1.0 - u_river_fall_foam * fall_foam(s.lean));
    float wakes = u_river_wake_foam * smoothstep(0.0, 0.45, s.spent);
    made = 1.0 - (1.0 - made) * (1.0 - 0.62 * wakes) * (1.0 - 0.80 * u_river_fall_foam * s.boils);
    made = procedural ? min(made * u_foam_amount, 1.0) : 0.0;
    // where water gathers speed it runs glassy: tongues between boulders
    float glassy = u_river_wake_foam * smoothstep(0.01, 0.22, -s.spent) * (1.0 - fall_foam(s.lean));
    return s.share * (1.0 - 0.7 * glassy) * (1.0 - (1.0 - made) * (1.0 - saturate(painted * u_river_turbulent)));
}

// Amount of stagnant foam; what pushes the water cuts it, and it grows back as the push fades (D19).
float stagnant_amount(Stream s, vec2 xy, float painted, vec4 force, bool procedural, float pixel_m) {
    float slow = 1.0 - smoothstep(0.2, 1.0, length(s.raw) / u_river_stagnant_mps);
    float gathered = smoothstep(0.35, 0.75, noise_at(xy, 47.0, pixel_m).g);
    float made = procedural ? u_river_stagnant_still * slow * (1.0 - s.rough) * (0.35 + 0.65 * gathered) : 0.0;
    // what was stirred stays open for long after the push has gone, and closes from ragged edges
    float torn = 0.35 + 1.3 * noise_at(xy, 5.0, pixel_m).g;
    float kept = 1.0 - max(smoothstep(1.0, 4.0, length(force.xy) / u_river_cut_mps), smoothstep(0.06, 0.30, force.w * torn));
    return s.own * kept * (1.0 - (1.0 - made) * (1.0 - saturate(painted * u_river_stagnant)));
}

vec3 stagnant_albedo(Foam foam) {
    vec3 colour = mix(vec3(1.12, 1.0, 0.80), vec3(0.62, 0.95, 0.26), u_river_stagnant_algae);
    return colour * (u_river_stagnant_albedo * mix(0.75, 1.2, foam.relief));
}

#include "lib/river_fall.glsl"

// Both layers over the sea's foam, which is left as far as its waves come; `albedo` is that of them all. `painted`:
// stagnant, turbulent.
Foam with_river_foam(Foam sea, Stream s, vec2 xy, vec2 painted, vec4 force, bool procedural, float pixel_m, inout vec3 albedo) {
    sea.cover *= 1.0 - s.own;
    sea.bubbles *= 1.0 - s.own;
    Foam fast = turbulent_foam(xy, s.flow, turbulent_amount(s, painted.y, procedural), pixel_m);
    float hangs = procedural ? s.drops * min(u_river_fall_foam, 1.0) : 0.0;
    if (hangs > 0.01) fast = mixed_foam(fast, curtain_foam(s, xy, pixel_m), hangs);
    Foam slow = stagnant_foam(xy, s.flow, stagnant_amount(s, xy, painted.x, force, procedural, pixel_m), pixel_m);
    vec3 fast_albedo = foam_albedo(fast) * u_river_turbulent_albedo;
    vec3 shares = vec3(sea.cover * (1.0 - fast.cover), fast.cover, slow.cover * (1.0 - fast.cover) * (1.0 - sea.cover));
    float cover = shares.x + shares.y + shares.z;
    vec3 parts = shares / max(cover, 1e-4);
    albedo = parts.x * albedo + parts.y * fast_albedo + parts.z * stagnant_albedo(slow);
    return Foam(cover, max(sea.amount * (1.0 - s.own), max(fast.amount, slow.amount)), max(sea.bubbles, fast.bubbles),
                dot(parts, vec3(sea.relief, fast.relief, slow.relief)), dot(parts, vec3(sea.fresh, fast.fresh, slow.fresh)));
}

// Shade of stagnant foam on the bed (D14): its own texture, coarser, read towards the sun. 1 where the sun comes through.
float river_shade(Stream s, vec2 at, float amount, float pixel_m) {
    if (u_river_stagnant_shadow * amount < 0.01) return 1.0;
    return 1.0 - u_river_stagnant_shadow * stagnant_foam(at, s.flow, amount, max(pixel_m, 0.004 * u_river_stagnant_tile_m)).cover;
}

#ifdef FRAGMENT
#include "lib/water.glsl"
uniform float u_river_ripple, u_river_ripple_still, u_river_ripple_m;

// Ripples of a river as water_ripples has those of the wind: slope and, in z, the variance that a pixel can't show. They
// go with the flow, the steeper the faster it is and the rougher it runs.
vec3 river_ripples(Stream s, vec2 xy, float pixel_m) {
    float fast = max(s.rough, smoothstep(0.1, 2.2, length(s.raw))), weight;
    float steep = mix(u_river_ripple_still, u_river_ripple, fast);
    vec4 way, jump;
    river_phases(xy, s.flow, way, jump, weight);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 2; ++i) {
        float tile_m = u_river_ripple_m * (i == 0 ? 1.0 : 0.37), part = i == 0 ? 0.6 : 0.4;
        vec2 at = i == 0 ? xy : turn(xy, 0.6, 0.8);
        vec4 there = i == 0 ? way : vec4(turn(way.xy, 0.6, 0.8), turn(way.zw, 0.6, 0.8));
        float lod = log2(max(pixel_m * RIPPLE_TEXELS / tile_m, 1e-4));
        vec4 v = river_tiled(u_ripple, at, tile_m, lod, there, jump, weight, vec4(0.0));
        float whole = smoothstep(TILE_PIXELS.x, TILE_PIXELS.y, tile_m / max(pixel_m, 1e-4));
        vec2 slope = i == 0 ? v.xy : turn(v.xy, -0.6, 0.8);
        sum += vec3(slope * (sqrt(part) * whole), part * (1.0 - whole * whole));
    }
    return vec3(steep * sum.xy, steep * steep * sum.z);
}
#endif
