// The sun's highlight on the water, moved out of the player's way (D20): the view-space normal is turned for the highlight
// alone, reflections and refraction keep the true one.
#include "lib/brdf.glsl"

uniform float u_glare_specular, u_glare_yaw_deg, u_glare_pitch_deg;
uniform float u_quiet_highlight, u_quiet_centre, u_quiet_centre_size;

// A highlight lies where the normal halves sun and eye: it goes right where the normal is turned left, down where up.
vec3 glare_normal(vec3 normal) {
    vec3 right = normalize(u_ray_x), up = normalize(u_ray_y), to_eye = -normalize(u_forward);
    vec3 n = vec3(dot(normal, right), dot(normal, up), dot(normal, to_eye));
    float yaw = radians(u_glare_yaw_deg), pitch = radians(u_glare_pitch_deg);
    n.xz = vec2(n.x * cos(yaw) - n.z * sin(yaw), n.x * sin(yaw) + n.z * cos(yaw));
    n.yz = vec2(n.y * cos(pitch) + n.z * sin(pitch), n.z * cos(pitch) - n.y * sin(pitch));
    return n.x * right + n.y * up + n.z * to_eye;
}

// Share of the highlight that the quiet middle of the picture leaves, and the painted quiet area (D39).
float glare_share(float quiet) {
    vec2 off = abs(gl_FragCoord.xy / u_size * 2.0 - 1.0) / u_quiet_centre_size;
    float middle = 1.0 - smoothstep(0.8, 1.2, max(off.x, off.y));
    return u_glare_specular * (1.0 - u_quiet_highlight * max(u_quiet_centre * middle, quiet));
}

// The mirrored sun for unit illuminance.
vec3 sun_highlight(vec3 normal, vec3 to_eye, vec3 to_sun, float roughness, vec3 f0, float quiet) {
    return glare_share(quiet) * brdf_sun_water(vec3(0.0), glare_normal(normal), to_eye, to_sun, roughness, f0);
}

bool glare_moved() { return u_glare_specular != 1.0 || u_glare_yaw_deg != 0.0 || u_glare_pitch_deg != 0.0 || u_quiet_centre > 0.0; }

// Radiance of the water's surface under the sun, foam and highlight.
vec3 sun_on_water(vec3 albedo, vec3 normal, vec3 to_eye, vec3 to_sun, float roughness, vec3 f0, float quiet) {
    vec3 both = brdf_sun_water(albedo, normal, to_eye, to_sun, roughness, f0);
    if (!glare_moved() && quiet <= 0.0) return both;
    vec3 matt = both - brdf_sun_water(vec3(0.0), normal, to_eye, to_sun, roughness, f0);
    return matt + sun_highlight(normal, to_eye, to_sun, roughness, f0, quiet);
}
