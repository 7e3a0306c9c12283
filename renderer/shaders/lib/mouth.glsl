// Where a river's water goes over into the sea's (D35): the plume of its jet, foam and flotsam along its sides, chop that
// the current holds up. Numbers of the jet as in level/river_jet.py; `water` there is this plume without its eddies.
#include "level/noise.glsl"
#include "lib/foam.glsl"

const int MOST_MOUTHS = 16;
uniform int u_mouths;
uniform vec4 u_mouth_place[MOST_MOUTHS];  // place, heading
uniform vec4 u_mouth_jet[MOST_MOUTHS];    // half width, reach, strength, tiles that its eddies have gone
uniform float u_mouth_waver, u_mouth_seam, u_mouth_flotsam, u_mouth_blocked;

const float JET_CORE = 10.4, JET_SPREAD = 0.1, JET_MIXES = 1.35, JET_EDGE = 0.12;
const float EDDY_TILE = 5.0;     // half widths
const float ROLLS = 40.0;        // to a tile: what is finer than that rolls no edge
const float FLOTSAM_TILE_M = 60.0;
const float HALF_OF_IT = 0.8326; // √ln 2: a Gaussian there is one half

struct Plume {
    float water;   // share of a river's, 0 … 1
    float out_here; // 1 where a jet says so, 0 up the river where its banks do
    float seam;    // foam along the shear line, 0 … 1
    float flotsam; // what floats in it covers so much
};

// One jet at a place `off` ahead of its mouth and to its left, m.
Plume jet_plume(vec2 off, vec4 jet, float pixel_m) {
    float half_m = jet.x, far = max(off.x, 0.0), core = JET_CORE * half_m, tile_m = EDDY_TILE * half_m;
    float flat_m = half_m * max(1.0 - far / core, 0.0);
    float mixed_m = JET_MIXES * (half_m + JET_SPREAD * far - flat_m) / HALF_OF_IT, wide_m = mixed_m + JET_EDGE * half_m;
    if (abs(off.y) > flat_m + 3.5 * wide_m + 0.5 * half_m || far > 1.5 * jet.y) return Plume(0.0, 0.0, 0.0, 0.0);
    // eddies roll down both sides, small at the mouth, then as wide as what is mixed; all tiles fit into the one that
    // they go round by
    vec2 at = vec2(off.x - jet.w * tile_m, off.y);
    vec4 broad = noise_at(at, tile_m, max(pixel_m, tile_m / ROLLS)), small = noise_at(at.yx, tile_m / 3.0, pixel_m);
    float grown = smoothstep(0.0, 3.0 * half_m, far);
    float push = 1.5 * (broad.g - 0.5) + 0.16 * (small.g - 0.5);
    float across = abs(off.y) + u_mouth_waver * push * mix(0.15 * half_m, 0.55 * half_m + 0.35 * mixed_m, grown);
    float ahead = far * (1.0 + 0.25 * u_mouth_waver * (broad.r - 0.5));
    float over = max(across - flat_m, 0.0) / wide_m;
    float ends = 1.0 - smoothstep(0.15 * jet.y, 1.1 * jet.y, ahead), middle = sqrt(core / max(far, core)) * ends * ends;
    float clouds = 1.0 + u_mouth_waver * grown * (0.8 * (broad.r - 0.5) + 0.12 * (small.g - 0.5));
    float water = saturate(middle * exp(-over * over) * clouds) * jet.z;
    float out_here = smoothstep(0.0, 1.5 * half_m, off.x);
    // it shears most where its water is half mixed: a thread there, drawn out, torn where eddies turn it under
    float thread_m = 0.5 + 0.015 * far, shown_m = max(thread_m, 0.7 * pixel_m);
    float side_m = across - flat_m - HALF_OF_IT * 0.55 * wide_m;
    vec2 side = vec2(side_m, side_m + 2.6 * thread_m) / shown_m;
    float lines = exp(-side.x * side.x) + 0.45 * exp(-side.y * side.y);
    float torn = smoothstep(0.34, 0.62, noise_at(at, 0.5 * tile_m, pixel_m).g);
    float lasts = ends * smoothstep(-0.5 * half_m, half_m, off.x) * jet.z;
    float seam = saturate(lines * thread_m / shown_m) * (0.35 + 0.65 * torn) * lasts;
    float speck = smoothstep(0.84, 0.88, noise_at(at.yx, tile_m / max(round(tile_m / FLOTSAM_TILE_M), 1.0), pixel_m).b);
    float near = exp2(-side_m * side_m / (4.0 + thread_m * thread_m));
    return Plume(water, out_here, u_mouth_seam * seam, u_mouth_flotsam * speck * near * torn * lasts);
}

// All of a level's plumes; `xy` before the waves move it.
Plume plume_at(vec2 xy, float pixel_m) {
    Plume sum = Plume(0.0, 0.0, 0.0, 0.0);
    for (int i = 0; i < u_mouths; ++i) {
        vec2 off = xy - u_mouth_place[i].xy, way = u_mouth_place[i].zw;
        off = vec2(dot(off, way), off.y * way.x - off.x * way.y);
        if (off.x < -u_mouth_jet[i].x) continue;
        Plume one = jet_plume(off, u_mouth_jet[i], pixel_m);
        float free = 1.0 - sum.water;  // no line where two run side by side
        sum = Plume(1.0 - free * (1.0 - one.water), max(sum.out_here, one.out_here),
                    max(sum.seam * (1.0 - one.water), one.seam * free), max(sum.flotsam, one.flotsam * free));
    }
    return sum;
}

// Share of rivers' water at a place where the map has `share` of it.
float river_tint(Plume plume, float share) { return mix(share, plume.water, plume.out_here); }

const float BLOCKED_CHOPS = 3.2;  // lengths of the chop: a tile of where it breaks

// Foam of chop that the current holds up, 0 … 1: it breaks where it stands, in short rows across the wind, and leaves lace
// that goes out to sea with the water. `white` as River has it, `crest` height against the largest, `chop_m` its length.
float blocked_foam(float white, vec2 xy, float crest, float chop_m, float pixel_m) {
    float amount = u_mouth_blocked * white, tile_m = BLOCKED_CHOPS * chop_m;
    if (amount < 0.01) return 0.0;
    vec2 at = vec2(1.9 * dot(xy, u_wind_way), u_wind_way.x * xy.y - u_wind_way.y * xy.x);
    float fields = smoothstep(0.15, 0.75, noise_at(xy, 2.7 * tile_m, pixel_m).g), breaks = 0.0;
    float grain = noise_at(xy, 0.31 * tile_m, pixel_m).b - 0.5;
    for (int i = 0; i < 2; ++i) {
        float age = i == 0 ? u_cap_age.z : u_cap_age.w;
        vec2 place = i == 0 ? u_cap_place.xy : u_cap_place.zw;
        float share = 0.6 * amount * age * fields * clamp(1.0 + 2.0 * crest, 0.3, 1.8);
        float cap = noise_at(at + place * tile_m, tile_m, pixel_m).g + 0.22 * grain;
        breaks = max(breaks, smoothstep(1.0 - 1.7 * share, 1.08 - 0.3 * share, cap) * smoothstep(0.0, 0.1, share));
    }
    return amount * (0.2 * fields + 0.08 * grain) + (1.0 - 0.3 * amount) * 0.8 * breaks;
}

// Leaves and wood over all foam.
Foam with_flotsam(Foam foam, float cover, inout vec3 albedo) {
    float whole = foam.cover + cover * (1.0 - foam.cover);
    albedo = mix(albedo, vec3(0.15, 0.11, 0.062), cover / max(whole, 1e-4));
    return Foam(whole, max(foam.amount, cover), foam.bubbles, foam.relief, mix(foam.fresh, 0.0, cover));
}
