// The wet shore (L06): what the waves of the last half minute left on the sand, in closed form from the shore clock, so
// that sand and water share one phase (D03, D10, H20). Damp sand that dries, the film that mirrors the sky behind the
// draining sheet, the lace at the line of its run-up.
#include "level/swash.glsl"
#include "level/noise.glsl"
#include "lib/sky.glsl"
#include "lib/foam.glsl"
#include "level/patches.glsl"

uniform float u_shore_interval_s;
uniform float u_tide_left_s[17];  // since when the heights from low to high water are dry
uniform vec2 u_tide_band_m;       // low and high water, heights in the level
uniform int u_wet_waves;  // so many are remembered; what came before them counts as a mean
uniform float u_wet_dry_s, u_wet_film, u_wet_film_s, u_wet_lace, u_wet_lace_s;

const float SOAK_S = 0.5;         // so long sand drinks before it is wet through
const float CREEP_M = 0.03;      // so far above the sheet the grains draw water, in places
const float ALWAYS_WET_M = 0.6;   // below the still sea by this much nothing ever shows

struct Wet {
    float damp;  // 1 wet through
    float film;  // 1 covered by a film of water
    float lace;  // amount of foam left lying, before its texture
};

const Wet DRY = Wet(0.0, 0.0, 0.0);

// Where smoothstep(0, 1, x) is y, to 0.006: right in value and steepness at both ends and the middle.
float inverse_smoothstep(float y) {
    float u = sqrt(2.0 * clamp(min(y, 1.0 - y), 0.0, 0.5));
    float x = u * (0.40825 + 0.09175 * u * u);
    return y < 0.5 ? x : 1.0 - x;
}

// Where u + u² − u³ is y, to 0.0005: when the sheet comes on its way up (swash_run).
float inverse_uprush(float y) {
    float left = clamp(1.0 - y, 0.0, 1.0), a = sqrt(0.5 * left);
    float v = a * (1.0 + a * (0.25 + 0.4 * a));  // v² (2 − v) = left
    return clamp(1.0 - v + (v * v * (2.0 - v) - left) / max(v * (4.0 - 3.0 * v), 1e-3), 0.0, 1.0);
}

// What one wave left at a height that is `part` of its reach, `age` intervals after it met the still water line. `down_m`
// is the way from its furthest line seaward, `grain` noise that breaks every edge.
Wet wave_left(float part, float age, float down_m, vec2 grain) {
    float up = u_shore_uprush;
    float from = up * inverse_uprush(part), to = up + (1.0 - up) * inverse_smoothstep(1.0 - part);
    float covered_s = (clamp(age, from, to) - from) * u_shore_interval_s;
    float since_s = max(age - to, 0.0) * u_shore_interval_s;
    float turned_s = (age - up) * u_shore_interval_s;
    float soak = smoothstep(0.0, SOAK_S, covered_s);
    float old = 1.0 - smoothstep(float(u_wet_waves) - 1.0, float(u_wet_waves), age);
    // the film sinks sooner high up, where the ground below is not yet full
    float life = 1.0 - since_s / (u_wet_film_s * mix(1.0, 0.45, part));
    float film = soak * smoothstep(0.0, 0.45, life - 0.4 * grain.x * (1.0 - life));
    // a line of bubbles where the sheet turned, thinner lace below it; both tear as they age
    float line = exp2(-max(down_m, 0.0) / (0.20 + 0.30 * grain.y)) * smoothstep(-0.12, 0.02, down_m);
    float left = 0.75 * line + 0.42 * grain.y * smoothstep(0.30, 0.95, part) * step(0.0, down_m);
    left *= smoothstep(0.0, 0.6, turned_s) * (1.0 - smoothstep(0.0, 1.0, turned_s / (u_wet_lace_s * (0.7 + 0.6 * grain.x))));
    return Wet(old * soak * exp(-since_s / u_wet_dry_s), old * film, old * left);
}

// What the ebb left on sand at a height over the still sea: as damp as the time makes it since it fell dry.
float tide_damp(float height) {
    if (!u_tide_on) return 0.0;
    float part = (height + u_sea_now_m - u_tide_band_m.x) / max(u_tide_band_m.y - u_tide_band_m.x, 1e-3) * 16.0;
    if (part >= 16.0 || part < 0.0) return 0.0;
    float dry_s = mix(u_tide_left_s[int(part)], u_tide_left_s[int(part) + 1], fract(part));
    return exp(-dry_s / u_wet_dry_s);
}

// `height` over the still sea.
Wet shore_wet(vec2 xy, float height, float pixel_m) {
    float top = max(u_shore_range_m * u_shore_runup, 0.02);
    if (height > top + 2.0 * CREEP_M) return Wet(tide_damp(height), 0.0, 0.0);
    if (height < -ALWAYS_WET_M) return Wet(1.0, 0.0, 0.0);
    Bed bed = bed_at(xy);
    float moving = u_shore_on * u_shore_vertex * bed.sea.x * patch_shore(xy).x;
    vec4 noise = noise_at(xy, 11.0, pixel_m);
    vec2 grain = vec2(0.5 * noise.g + 0.5 * noise.b, noise.r);
    float steep = max(length(bed.smoothed.yz), 0.015);
    float arrived = swash_arrived(xy, shore_early(xy, beach_at(xy).sway)).x;
    int wave = u_shore_cycle * u_shore_count + int(floor(arrived));
    float h = max(height - CREEP_M * grain.x, 0.0);
    top *= slope_reach(xy).x;
    // what older waves left on the whole, by how many of them come so high
    float often = 1.0 - smoothstep(0.96 - 0.6 * u_shore_runup_variety, 1.0 - 0.1 * u_shore_runup_variety, h / top);
    Wet sum = Wet(often * exp((0.5 - float(u_wet_waves)) * u_shore_interval_s / u_wet_dry_s), 0.0, 0.0);
    for (int i = 0; i < u_wet_waves; ++i) {
        float reach = top * swash_reach(xy, wave - i).x;
        Wet one = wave_left(min(h / max(reach, 1e-3), 1.0), fract(arrived) + float(i), (reach - h) / steep, grain);
        sum = Wet(max(sum.damp, one.damp), max(sum.film, one.film), max(sum.lace, one.lace));
    }
    float still = 1.0 - smoothstep(0.0, 0.1, height);
    return Wet(max(sum.damp * moving, max(still, tide_damp(height))), sum.film * moving * u_wet_film, sum.lace * moving * u_wet_lace);
}

// The lace as foam on the sand: two fetches of the sea's own texture, because it lies still and unshaded.
Foam shore_lace(Wet wet, vec2 xy, float pixel_m) {
    float amount = min(wet.lace, 0.95), lod = max(log2(max(pixel_m * FOAM_TEXELS / u_foam_tile_m, 1e-4)), 0.0);
    vec4 fields = textureLod(u_foam, xy / u_foam_tile_m, lod);
    vec4 cells = textureLod(u_foam, turn(xy, 0.454, 0.891) * (4.7 / u_foam_tile_m), lod + 2.2);
    float close = 1.0 - smoothstep(0.0, 2.5, lod);
    fields.rgb += ((cells.a - 0.35) * 0.25 + (cells.g - 0.5) * 0.20) * close;
    float cover = foam_cover(fields, amount, lod) * (0.80 + 0.20 * mix(0.4, fields.a, close));
    float relief = cover * mix(0.6, 0.4 + 0.5 * cells.g + 0.3 * (cells.a - 0.35), close);
    return Foam(cover, amount, 0.0, saturate(relief), 0.25);
}
