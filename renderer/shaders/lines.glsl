// Lines of the world over the picture: each segment a strip of four vertices. ON_WATER: in colours of the current's
// speed, with dark edges, hidden by land.
#include "lib/frame.glsl"

#ifdef ON_WATER
const float HALF_PX = 2.4;
#else
const float HALF_PX = 1.5;
#endif

#ifdef VERTEX
#ifdef ON_WATER
in vec4 in_start;  // camera-relative, m/s
in vec4 in_end;
noperspective out float v_side;
out float v_speed;
#else
in vec3 in_start;  // camera-relative
in vec3 in_end;
#endif

void main() {
    vec4 a = u_view_projection * vec4(in_start.xyz, 1.0), b = u_view_projection * vec4(in_end.xyz, 1.0);
    // keep the part before the eye: dividing by what lies behind it would turn the line round
    const float NEAREST = 0.05;
    if (a.w < NEAREST && b.w >= NEAREST) a = mix(a, b, (NEAREST - a.w) / (b.w - a.w));
    if (b.w < NEAREST && a.w >= NEAREST) b = mix(b, a, (NEAREST - b.w) / (a.w - b.w));
    vec2 way = (b.xy / max(b.w, NEAREST) - a.xy / max(a.w, NEAREST)) * u_size;
    vec2 side = vec2(-way.y, way.x) / max(length(way), 1e-6) * 2.0 * HALF_PX / u_size;
    vec4 here = gl_VertexID < 2 ? a : b;
    float sign = gl_VertexID % 2 == 0 ? -1.0 : 1.0;
    gl_Position = vec4(here.xy + side * sign * here.w, 0.0, here.w);
#ifdef ON_WATER
    v_side = sign;
    v_speed = gl_VertexID < 2 ? in_start.w : in_end.w;
#endif
}
#endif

#ifdef FRAGMENT
out vec4 out_colour;

#ifdef ON_WATER
#include "lib/eye_depth.glsl"
uniform sampler2D under_eye_depth;
noperspective in float v_side;
in float v_speed;

const float FULL_MPS = 2.0;   // and over: yellow
const float BEHIND_M = 0.4;   // so far in land a line still shows: the shore's samples are coarse

// From blue over grey to yellow, ever lighter: told apart by all eyes; slow differences show most.
vec3 speed_colour(float speed) {
    float part = sqrt(clamp(speed / FULL_MPS, 0.0, 1.0));
    return part < 0.5 ? mix(vec3(0.16, 0.34, 0.80), vec3(0.66, 0.70, 0.74), 2.0 * part)
                      : mix(vec3(0.66, 0.70, 0.74), vec3(1.00, 0.88, 0.20), 2.0 * part - 1.0);
}

void main() {
    float here = 1.0 / gl_FragCoord.w, land = smooth_eye_depth(under_eye_depth);
    if (land > 0.0 && land < here - BEHIND_M - 0.004 * here) discard;
    float inner = 1.0 - smoothstep(HALF_PX - 1.4, HALF_PX - 0.6, abs(v_side) * HALF_PX);
    out_colour = vec4(mix(vec3(0.02, 0.05, 0.10), speed_colour(v_speed), inner), mix(0.45, 0.95, inner));
}
#else
void main() { out_colour = vec4(1.0, 0.85, 0.35, 0.95); }
#endif
#endif
