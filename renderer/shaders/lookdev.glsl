// Look-dev (L08): two balls and a card held before the camera, written over the G-buffer so that the light pass lights
// them as it lights everything. The card lies open to the sky, tilted to the eye: all 24 patches in one light.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#define WRITE_GBUFFER
#include "lib/gbuffer.glsl"
uniform vec3 u_patches[24];
const float BALL = 0.17;                  // radius, in half heights of the picture
const vec2 GREY = vec2(-0.62, -0.72), CHROME = vec2(-0.18, -0.72), CARD = vec2(0.46, -0.72);
const vec2 CARD_HALF = vec2(0.37, 0.235);
const float HELD_M = 2.0;                 // eye depth
const float CHROME_ROUGHNESS = 0.03, CARD_TILT = 0.6;

// Normal of a ball at a place of its disc, seen from afar along the ray.
vec3 ball_normal(vec2 at, vec3 right, vec3 up, vec3 back) {
    return normalize(at.x * right + at.y * up + sqrt(max(1.0 - dot(at, at), 0.0)) * back);
}

void main() {
    vec2 clip = gl_FragCoord.xy / u_size * 2.0 - 1.0;
    vec2 at = vec2(clip.x * u_size.x / u_size.y, clip.y);
    vec3 right = normalize(u_ray_x), up = normalize(u_ray_y), back = -normalize(u_forward);
    Surface s = Surface(vec3(0.18), 1.0, back, 1.0, 0.0, LAND, 0.0, 0.0, vec3(0.0), HELD_M,
                        u_camera.xy + pixel_ray().xy * HELD_M);
    vec2 grey = (at - GREY) / BALL, chrome = (at - CHROME) / BALL, card = (at - CARD) / CARD_HALF;
    if (dot(grey, grey) < 1.0) s.normal = ball_normal(grey, right, up, back);
    else if (dot(chrome, chrome) < 1.0) {
        s.normal = ball_normal(chrome, right, up, back);
        s.albedo = vec3(0.0);
        s.specular = 1.0;
        s.roughness = CHROME_ROUGHNESS;
    } else if (max(abs(card.x), abs(card.y)) < 1.0) {
        vec2 place = (vec2(card.x, -card.y) * 0.5 + 0.5) * vec2(6.0, 4.0);
        vec2 off = abs(fract(place) - 0.5);
        int patch_number = int(place.y) * 6 + int(place.x);
        s.albedo = max(off.x, off.y) > 0.44 ? vec3(0.03) : u_patches[clamp(patch_number, 0, 23)];
        s.normal = normalize(mix(vec3(0.0, 0.0, 1.0), back, CARD_TILT));
    } else discard;
    write_gbuffer(s);
}
#endif
