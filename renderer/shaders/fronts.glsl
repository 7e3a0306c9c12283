// Over the finished picture, on the water (T06): crests now and their ghosts, isochrones, speed, breakers. Lines have one
// width on the screen: a phase's distance over its change from pixel to pixel on the moving surface.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/eye_depth.glsl"
#include "lib/passage.glsl"
uniform sampler2D g_eye_depth, g_material;
uniform vec4 u_ghosts[17];     // colour and alpha, from the earliest
uniform float u_ghost_cycles;  // between two of them
uniform int u_ghost_count;     // to either side
uniform bool u_front_crests, u_front_speed, u_front_breakers;
uniform float u_isochrone_cycles;  // between two of them, 0: none
uniform float u_isochrone_first;   // of the clock's cycle, in cycles: seconds are counted from 0, not from now
uniform vec3 u_isochrone_colour;
uniform vec3 u_speed_ramp[9];
uniform vec2 u_speed_range;
out vec4 out_colour;

void lay(inout vec4 under, vec3 colour, float alpha) {
    float sum = alpha + under.a * (1.0 - alpha);
    under = vec4(mix(under.rgb, colour, sum > 0.0 ? alpha / sum : 0.0), sum);
}

vec3 ray_at(ivec2 pixel, ivec2 size) {
    vec2 clip = (vec2(pixel) + 0.5) / vec2(size) * 2.0 - 1.0;
    return u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y;
}

// World way on the surface as it was drawn, from the middle of a drawn pixel to the next along one side of the screen,
// in shown pixels: to the neighbour on either hand that lies nearer, for one of them may stand behind an edge.
vec2 beside(ivec2 pixel, ivec2 way) {
    ivec2 size = textureSize(g_eye_depth, 0);
    vec2 nearest = vec2(0.0);
    float here = texelFetch(g_eye_depth, pixel, 0).r, least = 1e9;
    vec3 from = ray_at(pixel, size) * here;
    for (int side = -1; side <= 1; side += 2) {
        ivec2 at = clamp(pixel + side * way, ivec2(0), size - 1);
        float eye_depth = texelFetch(g_eye_depth, at, 0).r, apart = abs(eye_depth - here);
        if (at == pixel || eye_depth <= 0.0 || apart >= least) continue;
        least = apart;
        nearest = (ray_at(at, size) * eye_depth - from).xy;
    }
    return nearest * vec2(size) / u_size;
}

// A line where a phase is whole: cover of the pixel, from how far the phase is and how it changes over a pixel. Lines
// closer than some pixels would be a grey sheet: they fade.
float line(float phase, float change, float width_px) {
    float away = abs(phase - floor(phase + 0.5)) / max(change, 1e-6);
    return (1.0 - smoothstep(0.5 * width_px - 0.5, 0.5 * width_px + 0.5, away)) * (1.0 - smoothstep(0.08, 0.25, change));
}

vec3 speed_colour(float speed_mps) {
    float part = clamp((speed_mps - u_speed_range.x) / (u_speed_range.y - u_speed_range.x), 0.0, 1.0) * 8.0;
    int low = int(min(floor(part), 7.0));
    return mix(u_speed_ramp[low], u_speed_ramp[low + 1], part - float(low));
}

// Stripes for spilling, both ways for plunging, dots for surging, in pixels.
float pattern(int kind) {
    vec2 at = gl_FragCoord.xy / 9.0;
    float one = abs(fract(at.x + at.y) - 0.5), two = abs(fract(at.x - at.y) - 0.5);
    if (kind == 0) return 1.0 - smoothstep(0.08, 0.2, one);
    if (kind == 1) return 1.0 - smoothstep(0.08, 0.2, min(one, two));
    return 1.0 - smoothstep(0.2, 0.32, length(fract(at * 1.2) - 0.5));
}

void main() {
    ivec2 size = textureSize(g_eye_depth, 0), pixel = ivec2(gl_FragCoord.xy * vec2(size) / u_size);
    float eye_depth = smooth_eye_depth(g_eye_depth);
    if (int(texelFetch(g_material, pixel, 0).g * 255.0 + 0.5) != SEA || eye_depth <= 0.0) discard;
    vec3 relative = pixel_ray() * eye_depth;
    Passage p = passage_at(u_camera.xy + relative.xy);
    if (p.strength <= 0.0) discard;
    vec2 right = beside(pixel, ivec2(1, 0)), up = beside(pixel, ivec2(0, 1));
    float change = length(vec2(dot(p.since.yz, right), dot(p.since.yz, up)));
    vec4 colour = vec4(0.0);
    if (u_front_speed) lay(colour, speed_colour(p.speed_mps), 0.8 * p.strength);
    if (u_front_breakers && p.broken >= 0.0) {
        int kind = breaker_kind(p);
        float fade = 1.0 - smoothstep(0.05, 0.35, p.broken);
        lay(colour, u_breaker_colours[kind], (0.18 + 0.62 * pattern(kind)) * fade * p.strength);
    }
    if (u_isochrone_cycles > 0.0) {
        float phase = (u_isochrone_first - p.since.x) / u_isochrone_cycles, steep = change / u_isochrone_cycles;
        lay(colour, vec3(0.0), 0.35 * p.strength * line(phase, steep, 3.0));
        lay(colour, u_isochrone_colour, 0.75 * p.strength * line(phase, steep, 1.2));
    }
    if (u_front_crests) {
        for (int n = 2 * u_ghost_count; n >= 0; --n) {
            // the far ones first, the crest itself on top
            int k = (n + 1) / 2 * (n % 2 == 0 ? 1 : -1);
            vec4 ink = u_ghosts[u_ghost_count + k];
            float phase = p.since.x + float(k) * u_ghost_cycles, width = k == 0 ? 2.6 : 1.8;
            lay(colour, vec3(0.0, 0.02, 0.05), 0.5 * ink.a * p.strength * line(phase, change, width + 2.0));
            lay(colour, ink.rgb, ink.a * p.strength * line(phase, change, width));
        }
    }
    if (colour.a <= 0.0) discard;
    out_colour = colour;
}
#endif
