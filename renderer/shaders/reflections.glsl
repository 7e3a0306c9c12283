// The land mirrored in the plane of the still sea, at half width and half height (H17), in closed form from the plane and
// the land's depth: no second rendering, no march. Every pixel below the horizon is asked, whatever hides the plane there,
// so that waves may look beside it (lib/reflections.glsl).
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/fog.glsl"
layout(location = 0) out vec4 out_mirrored;  // radiance times share, share of the mirror that is land
layout(location = 1) out vec2 out_way;       // one over the level metres from the eye to what is mirrored, share that is known
uniform sampler2D hdr, under_eye_depth;
// how far beyond the picture's sides, and its top and bottom, its edge is taken to go on: shares of its height
const vec2 BEYOND = vec2(0.08, 0.5);
// where land is asked for while only the sea's floor is seen: parts of the view's angle from the plane to the mirror
const float SHEET_M = 1.5;        // water runs up the sand no higher
const float SAND_M = 0.6;         // the sand it runs up on is no higher near by: its grain would be mirrored as stripes
const int GUESSES = 6, STEPS = 9;
const float GUESS[GUESSES] = float[GUESSES](0.03125, 0.0833, 0.25, 0.5, 0.75, 1.0);

// A mirrored ray seen from the eye is a straight line of the picture: where it has gone 1 / m times as far as the plane it
// lies in this direction, of which eye depth is a linear function too.
struct Line {
    vec3 ray;       // to the plane, one metre of eye depth long
    float plane_m;  // eye depth of the plane
    float height;   // over which things are mirrored: that of the plane in the world, or a little more
};
vec3 along(Line line, float m) { return vec3(line.ray.xy, (2.0 * m - 1.0) * line.ray.z); }

// What the eye sees in the direction where the ray has gone 1 / m as far as the plane.
struct Seen {
    vec2 pixel;       // in the picture
    float eye_depth;  // 0: sky
    float known;      // 1 where the direction is in the picture, less beside it
    float standing;   // m at which the ray would meet it if it stood upright
    bool emerged;     // out of the water
};
Seen seen_at(Line line, float m) {
    vec3 way = along(line, m);
    vec4 clip = u_view_projection * vec4(way, 0.0);
    Seen seen = Seen(vec2(0.0), 0.0, 0.0, 0.0, false);
    if (clip.w <= 1e-6) return seen;
    vec2 at = (clip.xy / clip.w * 0.5 + 0.5) * u_size;
    seen.pixel = clamp(at, vec2(0.5), u_size - 0.5);
    seen.eye_depth = texelFetch(under_eye_depth, ivec2(seen.pixel), 0).r;
    vec2 off = abs(at - seen.pixel) / (BEYOND * u_size.y);
    // over sky there is sky
    if (seen.eye_depth <= 0.0 && at.y > 0.0) off.y = 0.0;
    seen.known = clamp(1.0 - max(off.x, off.y), 0.0, 1.0);
    if (seen.eye_depth <= 0.0) return seen;
    float forward = dot(way, u_forward);
    seen.standing = forward * line.plane_m / seen.eye_depth;
    seen.emerged = u_camera.z + way.z * seen.eye_depth / forward > line.height;
    return seen;
}

// The first land along the ray; false where there is none. Higher in the picture land is farther, if it doesn't hang over:
// the way to what is seen is then never too long, and upright land is found at once. Over the sea's floor one may go on
// faster; where that was too far, the place is between.
bool find_land(Line line, inout Seen seen, inout float m) {
    float before = 1.0, after = -1.0;
    int guess = 0;
    for (int i = 0; i < STEPS; ++i) {
        if (after >= 0.0) {
            m = seen.standing > after && seen.standing < before ? seen.standing : 0.5 * (before + after);
        } else if (seen.emerged) {
            m = min(seen.standing, m);
        } else {
            while (guess < GUESSES && 1.0 - GUESS[guess] >= m) ++guess;
            if (guess == GUESSES) {
                seen.known = seen.known < 1.0 ? 0.0 : 1.0;
                return false;
            }
            m = 1.0 - GUESS[guess];
        }
        seen = seen_at(line, m);
        if (seen.eye_depth <= 0.0 && after < 0.0) return false;
        if (seen.emerged && abs(seen.standing - m) < 0.004 * m) return true;
        if (seen.emerged && seen.standing > m) after = m;
        else before = m;
    }
    return seen.eye_depth > 0.0;
}

vec3 lit_land(vec2 pixel) {
    vec2 at = clamp(pixel - 0.5, vec2(0.0), u_size - 1.001), f = fract(at);
    ivec2 c = ivec2(at), last = ivec2(u_size) - 1, d = min(c + 1, last);
    vec3 south = mix(texelFetch(hdr, c, 0).rgb, texelFetch(hdr, ivec2(d.x, c.y), 0).rgb, f.x);
    return mix(south, mix(texelFetch(hdr, ivec2(c.x, d.y), 0).rgb, texelFetch(hdr, d, 0).rgb, f.x), f.y);
}

void main() {
    out_mirrored = vec4(0.0);
    out_way = vec2(0.0);
    vec2 clip = 4.0 * gl_FragCoord.xy / u_size - 1.0;
    Line line;
    line.ray = u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y;
    float fall = u_sea_now_m - u_camera.z;
    if (line.ray.z * fall <= 0.0 || fall >= 0.0) return;
    line.plane_m = fall / line.ray.z;
    line.height = u_sea_now_m + 0.02;
    float m = 1.0;
    Seen seen = seen_at(line, m);
    if (seen.standing > 1.0) {  // land hides the plane: a sheet may lie on it; higher up it is what waves see that look past it
        fall = line.ray.z * seen.eye_depth;
        line.plane_m = seen.eye_depth;
        line.height = u_camera.z + fall + SAND_M;
        seen.emerged = false;
    }
    if (u_camera.z + fall > u_sea_now_m + SHEET_M) {
        out_mirrored = vec4(min(lit_land(seen.pixel), vec3(15000.0)), 1.0);
        out_way = vec2(1.0 / max(length(line.ray.xy) * seen.eye_depth, 0.01), 1.0);
        return;
    }
    if (!find_land(line, seen, m)) {
        out_way.y = seen.known;
        return;
    }
    float ray_m = dot(along(line, m), u_forward) * line.plane_m / max(m, 1e-4);
    float share = 1.0 - smoothstep(1.0, 2.0, abs(seen.eye_depth - ray_m) / (0.04 * seen.eye_depth + 0.3));
    share *= seen.known;
    if (share <= 0.0) return;
    vec3 mirror = vec3(line.ray.xy, -line.ray.z);
    float way_m = length(line.ray) * line.plane_m * (1.0 / max(m, 1e-3) - 1.0);
    float height = -fall * (1.0 / max(m, 1e-3) - 1.0);
    vec3 light = fog(min(lit_land(seen.pixel), vec3(15000.0)), normalize(mirror), 0.0, height, way_m);
    out_mirrored = vec4(light * share, share);
    out_way = vec2(m / max(length(line.ray.xy) * line.plane_m, 0.01), share);
}
#endif
