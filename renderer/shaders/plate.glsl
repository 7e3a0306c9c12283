// Plates of the lit land (H12). DOWN: half width and height, with caustics (H13), to A. ALONG, ACROSS: A blurred to B.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
out vec4 out_plate;
#ifdef DOWN
#include "lib/sky.glsl"
#include "lib/sea_below.glsl"
uniform sampler2D hdr;
#ifdef RIVERS
#include "level/river.glsl"
#endif
const float OUT_OF_WATER = 0.002;  // weight of what stands higher than waves reach, so that no weight is nothing

void main() {
    float pixel_m = 1e6;
    ivec2 corner = 2 * ivec2(gl_FragCoord.xy), last = ivec2(u_size) - 1;
    vec4 sum = vec4(0.0), bed = vec4(0.0);  // bed: what of it lies under water, its place and depth times how much
    for (int i = 0; i < 4; ++i) {
        ivec2 pixel = min(corner + ivec2(i & 1, i >> 1), last);
        float eye_depth = texelFetch(under_eye_depth, pixel, 0).r;
        vec2 clip = (vec2(pixel) + 0.5) / u_size * 2.0 - 1.0;
        vec3 position = u_camera + (u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y) * eye_depth;
        if (eye_depth > 0.0) pixel_m = min(pixel_m, eye_depth * u_pixel_angle);
        float depth = u_sea_now_m - position.z;
#ifdef RIVERS
        River river = river_at(position.xy);
        depth += river.share > 0.5 ? river.still : 0.0;
#endif
        float weight = eye_depth > 0.0 ? mix(OUT_OF_WATER, 1.0, smoothstep(-1.5, -0.5, depth)) : OUT_OF_WATER;
        vec3 light = texelFetch(hdr, pixel, 0).rgb;
        if (depth > 0.0 && eye_depth > 0.0) bed += vec4(position.xy, depth, 1.0);
        sum += vec4(min(light, 15000.0) * weight, weight);
    }
    // one look for the four pixels: they are one texel
    if (bed.w > 0.0) sum.rgb *= caustics(bed.xy / bed.w, bed.z / bed.w, pixel_m);
    out_plate = 0.25 * sum;
}
#else
uniform float u_water_blur;
#ifdef ALONG
#include "lib/plate.glsl"
vec4 source(vec2 texel) { return plate_texel(texel, 0.0); }
const vec2 WAY = vec2(1.0, 0.0);
#else
uniform sampler2D u_plate_half;
vec4 source(vec2 texel) { return textureLod(u_plate_half, texel / vec2(textureSize(u_plate_half, 0)), 0.0); }
const vec2 WAY = vec2(0.0, 1.0);
#endif

// Seven taps of a bell; its width is a share of the picture's height, whatever is drawn.
void main() {
#ifdef ALONG
    vec2 texel = gl_FragCoord.xy;
#else
    vec2 texel = gl_FragCoord.xy - vec2(textureSize(u_plate_half, 0).x, 0.0);
#endif
    float step_texels = u_water_blur * u_size.y / 400.0;
    vec4 sum = vec4(0.0);
    float total = 0.0;
    for (int i = -3; i <= 3; ++i) {
        float weight = exp(-0.25 * float(i * i));
        sum += weight * source(texel + WAY * (step_texels * float(i)));
        total += weight;
    }
    out_plate = sum / total;
}
#endif
#endif
