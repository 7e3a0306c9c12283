// What the sea is made of at a pixel: foam from the shore masks, ripples by depth, light from below (D04 D09 L06 L07).
// sea.glsl finds the point and the normal; this says how it looks.
#include "lib/sky.glsl"
#include "lib/water.glsl"
#include "lib/foam.glsl"

const float BREAKS_S = 0.45, BROKEN_S = 0.85;  // share of the shore range over which fronts turn into foam

// Metres of water over the bed, from the shore map: steady where the ray's way through thin water isn't.
float water_column(Sea sea, float height) { return sea.bed.depth.x + height - u_sea_level_m; }

// Ripples die out in thin sheets.
float ripple_share(float column) { return mix(0.10, 1.0, smoothstep(0.02, 1.6, column)); }

// Way of the water at the surface, m/s: the bore carries it up the beach, behind it the sheet drains.
vec2 surface_flow(Sea sea) {
    vec2 uphill = -sea.bed.clock.yz;
    float steep = length(uphill);
    if (steep < 1e-4) return vec2(0.0);
    float broken = smoothstep(BREAKS_S, BROKEN_S, sea.shore.s);
    return uphill / steep * (broken * mix(-0.25, 0.9, clamp(sea.shore.line + sea.shore.fall, 0.0, 1.0)));
}

Foam sea_foam(Sea sea, vec2 before, float column, float sharp, float pixel_m) {
    float broken = smoothstep(BREAKS_S, BROKEN_S, sea.shore.s);
    float shore = sea.bed.sea.x * u_shore_on;
    // the last decimetre of water carries the rim, half a metre the lace behind it
    float sheet = exp2(-max(column, 0.0) / 0.16) * shore;
    float crest = smoothstep(0.55, 0.95, sea.height01) * sea.deep * sharp * 0.5;
    return foam_at(before, sea.shore.line * broken, sea.shore.back * broken, sea.shore.fall * broken, sheet, crest,
                   surface_flow(sea), u_sun_direction.xy, pixel_m);
}

uniform bool u_show_caustics;

// Bright lines that waves draw on the bed: edges of foam cells are the same curves as caustics. Mean 1.
float caustics(vec2 xy, float depth, float pixel_m) {
    float strength = smoothstep(0.05, 0.5, depth) * exp(-0.22 * depth) * u_sun_direction.z;
    float lod = log2(max(pixel_m * FOAM_TEXELS / 5.2, 1e-4));
    strength *= u_show_caustics ? 1.0 - smoothstep(1.5, 4.0, lod) : 0.0;
    if (strength < 0.01) return 1.0;
    lod = max(lod, 1.0) + 0.35 * depth;
    vec2 a = textureLod(u_foam, xy / 5.2 + u_ripple_way[1].zz * vec2(0.6, 1.0), lod).rg;
    vec2 b = textureLod(u_foam, xy / 6.1 - u_ripple_way[2].zz * vec2(1.0, -0.5) + 0.37, lod).rg;
    float web = min(a.y, b.y);
    return 1.0 + strength * (2.6 * web * web * web - 0.45);
}

// Light that comes back out of the water: from the bed and from the water itself. `sun` and `sky` are illuminance and
// irradiance on the surface; the surface's own losses in and out are Mobley's (Light and Water, 1994, ch. 10).
vec3 light_from_below(
    vec3 bed_albedo, float still_depth, vec2 bed_xy, float depth, float cosine, vec3 sun, vec3 sky, float pixel_m
) {
    float sun_up = max(u_sun_direction.z, 0.0);
    vec3 bed = bed_albedo * caustics(bed_xy, depth, pixel_m);
    vec3 albedo = water_albedo(bed, depth, cosine, max(sun_up, 0.25));
    // the sand of the swash is dark already: it is wet (lib/ground.glsl)
    vec3 out_of_water = mix(vec3(1.0), 0.54 / (1.0 - 0.48 * albedo), smoothstep(0.05, 0.5, still_depth));
    return albedo * out_of_water * (sun * sun_up * (1.0 - water_fresnel(sun_up, 0.0)) + 0.93 * sky) / 3.14159265;
}

// Air beaten into the water round foam makes it pale and greenish.
vec3 bubbles(vec3 light, Foam foam, vec3 sun, vec3 sky) {
    vec3 plume = vec3(0.20, 0.29, 0.29) * (sun * max(u_sun_direction.z, 0.0) + sky) / 3.14159265;
    return mix(light, plume, 0.5 * foam.bubbles);
}
