// Lines of the world over the picture, three pixels wide: each segment a strip of four vertices.
#include "lib/frame.glsl"

#ifdef VERTEX
in vec3 in_start;  // camera-relative
in vec3 in_end;

void main() {
    vec4 a = u_view_projection * vec4(in_start, 1.0), b = u_view_projection * vec4(in_end, 1.0);
    // keep the part before the eye: dividing by what lies behind it would turn the line round
    const float NEAREST = 0.05;
    if (a.w < NEAREST && b.w >= NEAREST) a = mix(a, b, (NEAREST - a.w) / (b.w - a.w));
    if (b.w < NEAREST && a.w >= NEAREST) b = mix(b, a, (NEAREST - b.w) / (a.w - b.w));
    vec2 way = (b.xy / max(b.w, NEAREST) - a.xy / max(a.w, NEAREST)) * u_size;
    vec2 side = vec2(-way.y, way.x) / max(length(way), 1e-6) * 3.0 / u_size;
    vec4 here = gl_VertexID < 2 ? a : b;
    gl_Position = vec4(here.xy + side * (gl_VertexID % 2 == 0 ? -1.0 : 1.0) * here.w, 0.0, here.w);
}
#endif

#ifdef FRAGMENT
out vec4 out_colour;

void main() { out_colour = vec4(1.0, 0.85, 0.35, 0.95); }
#endif
