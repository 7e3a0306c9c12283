// Meshes from files into the G-buffer (D12). With MARK: a colour for each prop as light, for the view of props.

#include "lib/frame.glsl"

#ifdef VERTEX
#include "lib/prop.glsl"
out vec3 v_relative, v_normal, v_colour, v_local;
out float v_over;  // metres over the water line
out float v_open;

void main() {
    v_relative = prop_relative();
    v_normal = prop_turned(in_normal);
    v_open = in_open;
    v_colour = in_colour;
    v_local = in_position * length(in_up.xyz);
    // what stands goes by the still sea
    v_over = in_mark.w > -1e5 ? v_local.z - in_mark.w : v_relative.z + u_camera.z - u_sea_now_m;
#ifdef MARK
    v_colour = in_mark.rgb;
#endif
    gl_Position = u_view_projection * vec4(v_relative, 1.0);
}
#endif

#ifdef FRAGMENT
#define WRITE_GBUFFER
#include "lib/gbuffer.glsl"
#include "level/noise.glsl"
in vec3 v_relative, v_normal, v_colour, v_local;
in float v_over, v_open;

const float ROUGHNESS = 0.62, WET_ROUGHNESS = 0.3, SPECULAR = 0.04;
const float POROUS = 0.6;  // share of its light that a wet surface keeps

void main() {
    vec3 n = normalize(gl_FrontFacing ? v_normal : -v_normal);
    vec3 to_eye = -normalize(v_relative), albedo = v_colour;
    // a smooth normal may lean away from the eye at an edge
    if (dot(n, to_eye) < 0.02) n = normalize(n + (0.02 - dot(n, to_eye)) * to_eye);
    vec3 position = u_camera + v_relative;
    float grain = noise_at(v_local.xy + v_local.zz * vec2(0.7, 0.4), 1.1, pixel_metres(v_relative, n)).g - 0.5;
    float damp = 1.0 - smoothstep(0.0, 0.10, v_over - 0.04 + 0.05 * grain);
    if (v_over > 0.0) damp *= 1.0 - smoothstep(0.3, 0.7, n.z);  // sides are splashed, a deck or floor lies dry
    albedo *= mix(1.0, POROUS, damp * smoothstep(-0.3, 0.0, v_over));  // under water a film is none
    vec3 shown = vec3(0.0);
#ifdef MARK
    shown = v_colour;
#endif
    write_gbuffer(Surface(albedo, v_open, n, mix(ROUGHNESS, WET_ROUGHNESS, damp), SPECULAR, LAND, 0.0, damp, shown,
                          eye_depth_of(v_relative), position.xy));
}
#endif
