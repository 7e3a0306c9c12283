// A view: VIEW_VALUE, a row's expression of views.py, over everything that is known of a pixel.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "level/waves.glsl"
#include "lib/wave_lists.glsl"
#include "lib/gbuffer.glsl"
#include "lib/height.glsl"
#include "lib/shadow.glsl"
#include "lib/wet.glsl"
#include "lib/glare.glsl"
#include "lib/sea_material.glsl"
#include "level/layer.glsl"
#include "lib/sea_below.glsl"
#include "lib/flow_faults.glsl"
#include "lib/plate.glsl"
#ifdef INSET
#include "lib/inset.glsl"
#endif
#include "lib/reflections.glsl"
#include "lib/rain_shown.glsl"
#include "lib/mouth_shown.glsl"
uniform sampler2D u_layer_foam;
uniform sampler2D hdr;
#include "lib/river_shown.glsl"
#ifdef LAYER
uniform sampler2D u_layer;
uniform float u_layer_cell_m;
#endif
#ifdef WALKABLE
uniform sampler2D u_walkable;
#endif
#ifdef FLOW_BYTES
#include "lib/flow_bytes.glsl"
#endif
#ifdef HIGH_CLOUDS
#include "lib/high_clouds.glsl"
#endif
#ifdef PASSAGE
#include "lib/passage.glsl"
#endif
#ifdef SHORE_FIELD
#include "lib/shore_field.glsl"
#endif
#ifdef PATCHES
#include "lib/patches.glsl"
#endif
#ifdef BEACH_MESH
#include "lib/beach_mesh.glsl"
#endif
#ifdef WEATHER
#include "level/rain.glsl"
#endif
#ifdef WEATHER_STAGE
uniform sampler2D u_weather_stage;
vec3 weather_stage(vec2 xy) { return textureLod(u_weather_stage, xy / 70000.0 + 0.5, 0.0).rgb; }
#endif
out vec4 out_value;

vec3 material_colour(int material) {
    const vec3 COLOURS[7] = vec3[7](vec3(0.0), vec3(0.62, 0.5, 0.3), vec3(0.1, 0.35, 0.75), vec3(0.2, 0.65, 0.75),
                                    vec3(0.75, 0.9, 1.0), vec3(0.35, 0.3, 0.55), vec3(0.95));
    return COLOURS[clamp(material, 0, 6)];
}

// Pixels of a triangle as grey, too small ones red; 0: the horizon's plane.
vec3 triangle_colour(float area) {
    if (area <= 0.0) return vec3(0.03, 0.06, 0.15);
    return area < 16.0 ? vec3(0.9, 0.05, 0.05) : vec3(0.15 + sqrt(area) / 24.0);
}

// The sun's mirror light as light.glsl adds it.
vec3 sun_glint(Surface s, vec3 relative) {
    vec3 sun = sun_radiance() * sun_visibility(u_camera + relative);
    return sun_highlight(s.normal, -normalize(relative), u_sun_direction, s.roughness, vec3(s.specular),
                         current_at(s.before).b) * sun;
}

vec3 crest_light(Sea sea, Surface s, vec3 relative) {
    return water_crest_light(max(sea.height01, wave_body(sea, 1.0)), s.normal, -normalize(relative), u_sun_direction);
}

// Foam as sea.glsl finds it, with the painted layers.
Foam view_foam(Sea sea, vec2 before, vec3 position, float pixel_m) {
    vec4 current = current_at(before), force = force_at(sea.position.xy);
    current.rg += force.xy;
    stirred = force.w;
    return sea_foam(sea, on_face(before, sea), water_column(sea, position.z), 1.0,
                    layer_at(u_layer_foam, before, u_cell_m).rg, current, true, pixel_m);
}

// The three densities as they are packed, where the current has them.
vec4 foam_density(vec2 before, float pixel_m) {
    float lee, lod = max(log2(max(pixel_m * FOAM_TEXELS / u_foam_tile_m, 1e-4)), 0.0);
    return foam_fields(before, current_at(before).rg, u_sun_direction.xy, lod, lee);
}

// By type orange, blue or grey, told apart by everyone; by progress from dark to bright, white water pale (D34).
vec3 breaking_colour(Sea sea) {
#ifdef PLUNGE
    ShoreMasks m = sea.shore;
    vec3 type = mix(mix(vec3(0.60), vec3(0.0, 0.45, 0.85), min(m.breaker.leaning.x / SPILLED, 1.0)), vec3(0.95, 0.55, 0.0), m.breaker.plunging.x);
    float waves = max(max(m.line, m.back), m.fall), grown = smoothstep(STEEPENS, 1.5, m.progress);
    return mix(type * (0.10 + 0.75 * waves * grown), vec3(1.0), 0.8 * m.white);
#else
    return vec3(0.0);
#endif
}

float shade_of_foam(Sea sea, Surface s) {
    vec2 at = foam_shade_place(s.before, sea.bed.depth.x + sea.still);
    float shade = foam_shade(at, layer_at(u_layer_foam, at, u_cell_m).rg, current_at(at), s.eye_depth * u_pixel_angle);
    return river_shade_shown(sea, s.before, at, shade, s.eye_depth * u_pixel_angle);
}

vec3 mirrored_land(Surface s, vec3 relative) {
    float known;
    return land_mirrored(relative, water_mirror(s.normal, -normalize(relative), s.roughness), s.roughness, known).rgb;
}

// What water_ripples adds to the normal, gusts left out; flat on land.
vec3 ripple_normal(Surface s, vec3 relative) {
    if (s.material != SEA) return vec3(0.0, 0.0, 1.0);
    float pixel_m = pixel_metres(relative, vec3(0.0, 0.0, 1.0));
    float long_m = min(length(relative) * u_pixel_angle / max(abs(normalize(relative).z), 0.02), 3.0 * pixel_m);
    return normalize(vec3(-water_ripples(s.before, long_m).xy, 1.0));
}

// Where the tide goes, from the ground's height and slopes: colours by height, lines where still water stands.
vec3 tide_band(vec3 ground, vec2 xy, float pixel_m) {
    if (any(lessThan(xy, vec2(0.0))) || any(greaterThan(xy, u_extent_m))) return vec3(0.02, 0.04, 0.09);
    float low = u_tide_band_m.x, high = u_tide_band_m.y, height = ground.x;
    vec3 value = height < low ? mix(vec3(0.12, 0.38, 0.62), vec3(0.03, 0.08, 0.22), clamp((low - height) / 6.0, 0.0, 1.0))
                 : height < high ? mix(vec3(0.85, 0.62, 0.25), vec3(0.98, 0.88, 0.55), (height - low) / max(high - low, 1e-3))
                                 : mix(vec3(0.30, 0.42, 0.24), vec3(0.16, 0.22, 0.14), clamp((height - high) / 12.0, 0.0, 1.0));
    float rise_m = max(length(ground.yz), 0.01) * max(pixel_m, 1e-4);  // a pixel's height
    vec3 lines = vec3(low, u_still_m, high), away = abs(vec3(height) - lines) / rise_m;
    vec3 drawn = 1.0 - smoothstep(vec3(0.8), vec3(1.8), away);
    value = mix(value, vec3(0.95), 0.9 * max(drawn.x, drawn.z));
    return mix(value, vec3(0.8, 0.15, 0.1), 0.9 * drawn.y);
}

void main() {
#ifdef INSET
    ivec2 pixel = ivec2(inset_part() * vec2(textureSize(g_eye_depth, 0)));
    vec2 clip = inset_part() * 2.0 - 1.0;
    vec3 ray = u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y;
#else
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ray = pixel_ray();
#endif
#ifdef INSET_MAP
    Bed under_it = bed_at(inset_world());
    Surface s = inset_surface(inset_world(), under_it.sea.x > 0.5 && under_it.depth.x > 0.0, u_inset_map.w);
    vec3 position = vec3(inset_world(), u_sea_level_m + max(-under_it.depth.x, 0.0));
#else
    Surface s = read_gbuffer(pixel);
    vec3 position = u_camera + ray * s.eye_depth;
#endif
    float on_sea = float(s.material == SEA), on_land = float(s.material == LAND);
    Sea sea = sea_surface(s.before);
#ifdef INSET_MAP
    if (s.material == SEA) position.z = sea.position.z;
#endif
    Bed bed = bed_at(position.xy);
    vec3 ground = ground_sample(position.xy);
    vec3 lit = texelFetch(hdr, pixel, 0).rgb;
    vec3 under = pow(texelFetch(under_albedo, pixel, 0).rgb, vec3(2.0));
#ifdef INSET_MAP
    vec2 below = position.xy;
#else
    vec2 below = u_camera.xy + ray.xy * texelFetch(under_eye_depth, pixel, 0).r;
#endif
#ifdef LAYER
    vec4 painted = texture(u_layer, (below / u_layer_cell_m + 0.5) / vec2(textureSize(u_layer, 0)));
#endif
#ifdef WALKABLE
    ivec2 cell = clamp(ivec2(floor(below / u_cell_m + 0.5)), ivec2(0), textureSize(u_walkable, 0) - 1);
    bool on_level = all(greaterThanEqual(below, vec2(0.0))) && all(lessThanEqual(below, u_extent_m));
    float walkable = float(on_level && u_sea_now_m <= texelFetch(u_walkable, cell, 0).r);
#endif
#ifdef SHORE_FIELD
    vec4 shore_field = shore_field_at(position.xy);
#endif
    vec3 value = VIEW_VALUE;
    value = s.material == NOTHING ? vec3(0.0) : value;
#ifdef INSET
    out_value = inset_colour(value);
#else
    out_value = vec4(value, 1.0);
#endif
}
#endif
