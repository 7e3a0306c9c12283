// The dark foot of things (L03): what part of the sky they leave open on the ground beside them and on themselves.
#include "lib/frame.glsl"

#ifdef VERTEX
in vec4 in_foot;    // relative to the eye, radius m
in vec4 in_shape;   // cosine and sine of the yaw, half length m, darkness
in vec2 in_normal;
flat out vec4 v_foot, v_shape;
flat out vec2 v_normal;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    float reach = 1.25 * (in_foot.w + in_shape.z);
    vec3 at = in_foot.xyz + reach * (corner.x * normalize(u_ray_x) + corner.y * normalize(u_ray_y));
    v_foot = in_foot;
    v_shape = in_shape;
    v_normal = in_normal;
    gl_Position = u_view_projection * vec4(at, 1.0);
}
#endif

#ifdef FRAGMENT
uniform sampler2D g_eye_depth;
flat in vec4 v_foot, v_shape;
flat in vec2 v_normal;
out vec4 out_open;

void main() {
    float eye_depth = texelFetch(g_eye_depth, ivec2(gl_FragCoord.xy), 0).r;
    vec3 p = pixel_ray() * eye_depth - v_foot.xyz;
    if (dot(p, p) > 4.0 * (v_foot.w + v_shape.z) * (v_foot.w + v_shape.z)) discard;
    vec3 up = vec3(v_normal, sqrt(max(1.0 - dot(v_normal, v_normal), 0.0)));
    float over = dot(p, up) / v_foot.w;
    vec2 along = vec2(dot(p.xy, v_shape.xy), dot(p.xy, vec2(-v_shape.y, v_shape.x)));
    along.x -= clamp(along.x, -v_shape.z, v_shape.z);
    float away = length(along) / v_foot.w;
    float near = clamp(1.0 - away, 0.0, 1.0), low = clamp(1.0 - max(over, -over * 0.7) * 1.9, 0.0, 1.0);
    out_open = vec4(0.0, 0.0, 0.0, 1.0 - v_shape.w * smoothstep(0.0, 0.75, near) * low * low);
}
#endif
