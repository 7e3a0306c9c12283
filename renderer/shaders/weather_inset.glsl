// The weather map from above as an inset (Z04): the level's border, the wind, where the horizon's own sky begins.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "level/weather.glsl"
#include "lib/gbuffer.glsl"
#include "lib/inset.glsl"
uniform int u_stage;
uniform vec2 u_extent_m;    // of the level
uniform vec2 u_inset_wind;  // where it blows to, in the inset; its length is that of the arrow, 0 … 1
out vec4 out_colour;

const vec3 LINE = vec3(1.0), ARROW = vec3(1.0);
const float LEAST_PX = 4.0;  // half of a side of the level's border, however small the level is on the map

float along_line(float away_px, float width_px) {
    return 1.0 - smoothstep(0.5 * width_px, 0.5 * width_px + 1.0, abs(away_px));
}

float segment(vec2 at, vec2 a, vec2 b, float width_px) {
    vec2 way = b - a;
    return along_line(length(at - a - way * clamp(dot(at - a, way) / max(dot(way, way), 1e-6), 0.0, 1.0)), width_px);
}

// The level's border; `world` metres, `pixel_m` metres a pixel.
float level_border(vec2 world, float pixel_m, float width_px) {
    vec2 off = abs(world - 0.5 * u_extent_m) / pixel_m - max(0.5 * u_extent_m / pixel_m, vec2(LEAST_PX));
    return along_line(max(off.x, off.y), width_px);
}

// An arrow in the lower right corner, on a disc that darkens what is under it.
float wind_arrow(out float disc) {
    float radius = max(0.09 * u_inset.z, 7.0), strength = length(u_inset_wind);
    vec2 at = gl_FragCoord.xy - u_inset.xy - vec2(u_inset.z, 0.0) - vec2(-1.0, 1.0) * (radius + 4.0);
    disc = 1.0 - smoothstep(radius - 1.0, radius, length(at));
    if (strength <= 0.0) return 1.0 - smoothstep(1.0, 2.0, length(at));
    vec2 way = u_inset_wind / strength, side = vec2(-way.y, way.x), tip = 0.85 * radius * strength * way;
    vec2 back = tip - 0.45 * radius * way;
    return max(segment(at, -tip, tip, 1.4), max(segment(at, tip, back + 0.3 * radius * side, 1.4),
                                                segment(at, tip, back - 0.3 * radius * side, 1.4)));
}

void main() {
    vec2 world = inset_world();
    vec3 colour = weather_of(world, u_camera.xy, u_stage).rgb;
    float pixel_m = u_inset_map.w, disc;
    if (u_stage >= STAGE_HORIZON)
        colour = mix(colour, LINE, 0.35 * along_line((distance(world, u_camera.xy) - u_weather_horizon.x) / pixel_m, 1.0));
    colour *= 1.0 - 0.6 * level_border(world, pixel_m, 3.0);
    colour = mix(colour, LINE, 0.9 * level_border(world, pixel_m, 1.2));
    float arrow = wind_arrow(disc);
    colour = mix(mix(colour, vec3(0.0), 0.55 * disc), ARROW, arrow);
    out_colour = inset_colour(colour);
}
#endif
