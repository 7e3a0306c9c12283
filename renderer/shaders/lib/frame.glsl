// What every pass knows of the camera. Positions are relative to it; radiance is in kcd/m², illuminance in klx.

uniform vec3 u_camera;           // world, metres
uniform vec3 u_forward;
uniform mat4 u_view_projection;  // clip space from camera-relative positions
uniform vec3 u_ray_centre;       // direction of a pixel = centre + x · ray_x + y · ray_y, one metre of eye depth long
uniform vec3 u_ray_x;
uniform vec3 u_ray_y;
uniform vec2 u_size;
uniform float u_pixel_angle;     // radians a pixel at the centre
uniform float u_level_sea_level_m;
uniform float u_sea_now_m;  // with the tide

const int NOTHING = 0, LAND = 1, SEA = 2, RIVER = 3, ICE = 4, PUDDLE = 5, SNOW = 6;  // targets.py MATERIALS

#ifdef VERTEX
// One triangle that covers the target.
void fullscreen_triangle() {
    gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0), 0.0, 1.0);
}
#endif

#ifdef FRAGMENT
vec3 pixel_ray() {
    vec2 clip = gl_FragCoord.xy / u_size * 2.0 - 1.0;
    return u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y;
}
#endif

float eye_depth_of(vec3 relative) { return dot(relative, u_forward); }

// Side of a pixel on a surface, metres, whatever its derivatives say.
float pixel_metres(vec3 relative, vec3 normal) {
    float away = length(relative);
    return away * u_pixel_angle / sqrt(max(abs(dot(relative, normal)) / max(away, 1e-4), 0.02));
}
