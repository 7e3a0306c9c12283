// Scattered things into the G-buffer (L09): ROCK, WOOD or GRASS says of what they are. With MARK: the kind's colour as
// light, for the view of kinds.
#include "lib/frame.glsl"

#ifdef VERTEX
#include "lib/scatter.glsl"
#include "level/wind.glsl"
uniform vec4 u_gusts[3];    // wave vector 1/m, phase 0 … 1
uniform float u_wind_bend;  // lean of a blade in a middling gust, rad
uniform float u_kind_wind;
out vec3 v_relative, v_normal, v_local;
out vec4 v_look;  // tint, open, sway (grass) or size in metres, phase

// Sideways way of a point over the ground, in its height: mean lean, gusts that run over the field, each tuft's tremble.
vec2 wind_lean(vec2 foot) {
    float gust = 0.0;
    for (int i = 0; i < 3; ++i) gust += sin(6.2831853 * (dot(foot, u_gusts[i].xy) - u_gusts[i].z)) * (0.6 / float(i + 1));
    float tremble = sin(6.2831853 * (2.0 * u_gusts[2].z + in_look.z * 7.0 + 0.3 * in_position.x)) * 0.10;
    vec2 across = vec2(-u_wind_way.y, u_wind_way.x);
    return (u_wind_way * (0.55 + 0.45 * gust) + across * tremble) * u_wind_bend * u_kind_wind;
}

void main() {
    mat3 axes = instance_axes();
    vec3 at = axes * in_position * in_place.w;
#ifdef GRASS
    float bent = in_sway * in_sway;
    vec2 lean = wind_lean(in_place.xy + u_camera.xy) * bent;
    float tall = max(at.z, 0.0);
    at.xy += lean * tall;
    at.z -= 0.5 * dot(lean, lean) * tall;  // a blade keeps its length
#endif
    v_relative = in_place.xyz + at;
    v_normal = axes * in_normal;
    v_local = in_position * in_look.w;
#ifdef GRASS
    v_look = vec4(in_look.xy, in_sway, in_look.z);
#else
    v_look = vec4(in_look.xy, in_look.w, in_look.z);
#endif
    gl_Position = u_view_projection * vec4(v_relative, 1.0);
}
#endif

#ifdef FRAGMENT
#define WRITE_GBUFFER
#include "lib/gbuffer.glsl"
#include "lib/wet.glsl"
uniform float u_still_m;
uniform float u_kind_tall;
uniform float u_wet_splash_m;
uniform vec3 u_kind_colour;
in vec3 v_relative, v_normal, v_local;
in vec4 v_look;

#ifdef GRASS
const float SPECULAR = 0.015;  // blades hide each other's gloss
#else
const float SPECULAR = 0.04;
#endif

struct Thing { vec3 albedo; vec3 normal; float roughness; float open; };

#ifdef ROCK
// The tones of the land's rock: grey to buff, grain and veins from three planes of noise, lichen on top of dry ones.
Thing thing_at(vec3 p, vec3 n, float pixel_m, float height, out float porous) {
    vec3 w = n * n;
    w *= w;
    w /= w.x + w.y + w.z;
    vec4 grain = vec4(0.0), broad = vec4(0.0);
    vec2 shift = v_look.xw * 13.7;
    if (w.z > 0.05) { grain += w.z * noise_at(p.xy + shift, 1.1, pixel_m); broad += w.z * noise_at(p.xy + shift, 6.3, pixel_m); }
    if (w.x > 0.05) { grain += w.x * noise_at(p.yz + shift, 1.1, pixel_m); broad += w.x * noise_at(p.yz + shift, 6.3, pixel_m); }
    if (w.y > 0.05) { grain += w.y * noise_at(p.xz + shift, 1.1, pixel_m); broad += w.y * noise_at(p.xz + shift, 6.3, pixel_m); }
    vec3 tint = mix(vec3(0.150, 0.140, 0.130), vec3(0.34, 0.30, 0.245), smoothstep(0.1, 0.95, v_look.x));
    tint = mix(tint, vec3(0.36, 0.27, 0.18), 0.5 * smoothstep(0.55, 0.9, broad.g) * smoothstep(0.4, 0.9, v_look.w));
    tint *= 0.50 + 0.62 * grain.g + 0.42 * broad.r + 0.35 * (grain.b - 0.5);
    tint *= 1.0 - 0.40 * smoothstep(0.80, 0.97, grain.a);  // cracks
    float lichen = smoothstep(0.62, 0.85, 0.6 * broad.b + 0.4 * grain.g) * smoothstep(0.3, 0.8, n.z);
    tint = mix(tint, vec3(0.33, 0.32, 0.24), 0.4 * lichen * smoothstep(2.0, 5.0, height));
    // splash keeps large ones dark, as it does the land's rock (L06); small ones lie clean on the sand
    float reach = max(u_shore_range_m * u_shore_runup + u_wet_splash_m, 0.01);
    float splash = 1.0 - smoothstep(0.55 * reach, 1.2 * reach, height + 0.9 * (broad.g - 0.5) + 0.5 * (grain.g - 0.5));
    tint *= mix(vec3(1.0), vec3(0.50, 0.51, 0.48), splash * smoothstep(0.15, 0.6, v_look.z) * smoothstep(-0.5, 0.0, height));
    vec3 bump = vec3(grain.g - 0.5, grain.b - 0.5, grain.r - 0.5) * 0.55 + vec3(broad.g, broad.b, broad.r) * 0.5 - 0.25;
    porous = 0.9;
    return Thing(tint, normalize(n + bump), 0.84, 1.0);
}
#endif

#ifdef WOOD
// Bleached by salt and sun: silver grey with dark grain along the trunk, browner where it is young or damp.
Thing thing_at(vec3 p, vec3 n, float pixel_m, float height, out float porous) {
    float turn = dot(v_local.yz, v_local.yz) > 1e-12 ? atan(v_local.y, v_local.z) : 0.0;  // the middle of an end has none
    vec2 along = vec2(v_local.x * 0.16, turn * 0.16 + v_look.w * 3.1);
    float lod = log2(max(pixel_m * NOISE_TEXELS * 0.9, 1e-4));
    vec4 grain = textureLod(u_noise, along * vec2(1.0, 3.0), lod);
    vec4 broad = textureLod(u_noise, along * 0.5 + 0.3, lod - 2.0);
    vec3 tint = mix(vec3(0.24, 0.205, 0.165), vec3(0.38, 0.35, 0.31), 0.2 + 0.8 * v_look.x);
    tint = mix(tint, vec3(0.27, 0.20, 0.14), 0.35 * smoothstep(0.55, 0.9, broad.g));
    tint *= 0.62 + 0.55 * grain.g + 0.22 * (grain.b - 0.5);
    tint *= 1.0 - 0.6 * smoothstep(0.78, 0.93, grain.a);  // drying cracks
    porous = 0.8;
    return Thing(tint, normalize(n + 0.35 * vec3(0.0, grain.g - 0.5, grain.b - 0.5)), 0.8, 1.0);
}
#endif

#ifdef GRASS
// Two tints by tuft: marram is blue-green to straw, meadow green to dry; the root is dark and hidden, the tip catches light.
Thing thing_at(vec3 p, vec3 n, float pixel_m, float height, out float porous) {
    vec4 wide = noise_at(p.xy, 61.0, pixel_m);
    float dry = clamp(0.55 * v_look.x + 0.75 * (wide.g - 0.25), 0.0, 1.0);
    vec3 meadow = mix(vec3(0.062, 0.080, 0.032), vec3(0.180, 0.154, 0.084), dry);
    vec3 marram = mix(vec3(0.108, 0.130, 0.060), vec3(0.300, 0.254, 0.138), dry);
    vec3 tint = mix(meadow, marram, u_kind_tall);
    tint *= mix(0.55, 1.15, v_look.z);
    tint = mix(tint, tint * vec3(1.25, 1.12, 0.85), v_look.z * v_look.z * 0.6);
    porous = 0.3;
    // blades lean every way: the light on a field is that on its ground
    return Thing(tint, normalize(mix(vec3(0.0, 0.0, 1.0), n, 0.38)), 0.9, mix(0.42, 1.0, smoothstep(0.0, 0.75, v_look.z)));
}
#endif

void main() {
    vec3 position = u_camera + v_relative;
    vec3 n = normalize(v_normal);
    float pixel_m = pixel_metres(v_relative, n), height = position.z - u_still_m, porous;
    Thing thing = thing_at(position, n, pixel_m, height, porous);
    float damp = 0.0;
#ifndef GRASS
    height -= u_tide_m;
    damp = height < 0.0 ? 1.0 : shore_wet(position.xy, height, pixel_m).damp;
    // a film darkens; under water there is none (lib/ground.glsl does the same)
    thing.albedo *= mix(vec3(1.0), vec3(0.46, 0.46, 0.45), damp * porous * smoothstep(-0.5, -0.1, height));
    thing.roughness = mix(thing.roughness, 0.35, damp);
#endif
    vec3 shown = vec3(0.0);
#ifdef MARK
    shown = u_kind_colour;
#endif
    write_gbuffer(Surface(thing.albedo, thing.open * v_look.y, thing.normal, thing.roughness, SPECULAR, LAND, 0.0, damp,
                          shown, eye_depth_of(v_relative), position.xy));
}
#endif
