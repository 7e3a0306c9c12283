// Over the finished picture, on the ground below the water: brush ring, walkable depth, the level's border, the centre.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
#include "lib/eye_depth.glsl"
uniform sampler2D under_eye_depth;
uniform vec4 u_ring;      // x, y, radius m, hardness; no ring where the radius is 0
uniform bool u_outline, u_centre;
uniform vec2 u_extent_m;
uniform float u_cell_m;
#ifdef WALKABLE
uniform sampler2D u_walkable;
#endif
out vec4 out_colour;

void lay(inout vec4 under, vec3 colour, float alpha) {
    float sum = alpha + under.a * (1.0 - alpha);
    under = vec4(mix(under.rgb, colour, sum > 0.0 ? alpha / sum : 0.0), sum);
}

float line(float distance_m, float width_px, float pixel_m) {
    return 1.0 - smoothstep(0.5 * width_px, 0.5 * width_px + 1.0, abs(distance_m) / pixel_m);
}

void main() {
    float eye_depth = smooth_eye_depth(under_eye_depth);
    vec3 relative = pixel_ray() * eye_depth;
    vec2 ground = u_camera.xy + relative.xy;
    float pixel_m = max(pixel_metres(relative, vec3(0.0, 0.0, 1.0)), 1e-4);
    vec2 outside = max(-ground, ground - u_extent_m);
    bool on_level = eye_depth > 0.0 && max(outside.x, outside.y) < 0.0;
    vec4 colour = vec4(0.0);
#ifdef WALKABLE
    if (on_level) {
        ivec2 cell = clamp(ivec2(floor(ground / u_cell_m + 0.5)), ivec2(0), textureSize(u_walkable, 0) - 1);
        bool walk = u_sea_now_m <= texelFetch(u_walkable, cell, 0).r;
        lay(colour, walk ? vec3(0.10, 0.85, 0.25) : vec3(0.90, 0.10, 0.08), 0.42);
    }
#endif
    if (u_outline && eye_depth > 0.0)
        lay(colour, vec3(1.0, 0.85, 0.3), 0.8 * line(max(outside.x, outside.y), 1.5, pixel_m));
    if (u_ring.z > 0.0 && eye_depth > 0.0) {
        float away = length(ground - u_ring.xy), part = away / u_ring.z;
        float inner = u_ring.w * u_ring.z;
        lay(colour, vec3(1.0, 0.75, 0.25), 0.22 * (1.0 - smoothstep(min(u_ring.w, 0.999), 1.0, part)));
        lay(colour, vec3(1.0), 0.35 * line(away - inner, 1.0, pixel_m) * step(1e-3, u_ring.w));
        lay(colour, vec3(0.0), 0.45 * line(away - u_ring.z, 3.5, pixel_m));
        lay(colour, vec3(1.0, 0.95, 0.85), 0.95 * line(away - u_ring.z, 1.2, pixel_m));
    }
    if (u_centre) {
        vec2 off = abs(gl_FragCoord.xy - 0.5 * u_size) - u_size / 6.0;
        float edge = max(off.x, off.y);
        lay(colour, vec3(1.0), 0.7 * (1.0 - smoothstep(0.5, 1.5, abs(edge))));
    }
    out_colour = colour;
}
#endif
