// The next image of the clouds from the sixteenth that was marched and from what is remembered (Z16): STILL where nothing
// moved, MOVED where it did, else there is nothing to remember. Defines, for software OpenGL runs every branch.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
uniform sampler2D u_parts, u_parts_depth;  // the last sixteen parts side by side, four by four
uniform sampler2D u_last, u_last_depth;    // the last image
uniform vec2 u_cloud_size;
uniform ivec2 u_part;                      // sides of a part
uniform int u_slot;                        // which part was marched in this frame
uniform vec4 u_moved[17];                  // from the camera of a part (the last: of the last image) to this one, known
uniform vec4 u_back_x[17], u_back_y[17], u_back_z[17];  // rows that turn into it
uniform vec4 u_gone_on[17];                // light now over that of then, where a day runs
layout(location = 0) out vec4 out_light;
layout(location = 1) out float out_depth;

const int BLOCK = 4, LAST = 16;
const ivec2 ORDER[16] = ivec2[16](ivec2(0, 0), ivec2(2, 2), ivec2(2, 0), ivec2(0, 2), ivec2(1, 1), ivec2(3, 3), ivec2(3, 1),
    ivec2(1, 3), ivec2(1, 0), ivec2(3, 2), ivec2(3, 0), ivec2(1, 2), ivec2(0, 1), ivec2(2, 3), ivec2(2, 1), ivec2(0, 3));
const float SHARP = 3.0;        // one over twice the variance of a marched pixel's weight, in pixels
const float FLAT = 0.02;         // added to the spread of the samples: few on a line make no plane
const float SPARSE = 0.02, DENSE = 0.25;  // sums of weights between which the last image is left behind
const float ROOM = 1.0;        // of what fresh neighbours span, by which a remembered pixel may leave it

ivec2 corner(int slot) { return ivec2(slot % BLOCK, slot / BLOCK) * u_part; }

// The marched part, bilinear, at a pixel of the image.
vec2 fresh_at(vec2 pixel) {
    vec2 at = clamp((pixel - vec2(ORDER[u_slot])) / float(BLOCK) + 0.5, vec2(0.5), vec2(u_part) - 0.5);
    return (at + vec2(corner(u_slot))) / vec2(u_part * BLOCK);
}

// Where a place relative to this camera was in the image of a part, in pixels; far outside where it was behind.
vec2 was_at(vec3 there, int slot) {
    there += u_moved[slot].xyz;
    float ahead = dot(there, u_back_z[slot].xyz);
    if (ahead <= 0.0) return vec2(-1e6);
    return (vec2(dot(there, u_back_x[slot].xyz), dot(there, u_back_y[slot].xyz)) / ahead * 0.5 + 0.5) * u_cloud_size - 0.5;
}

// What was marched about a place in the last sixteen frames: a plane through it, fitted by weights that fall with the
// distance in pixels (moving least squares), so that what lies to one side is not moved there. Its sum of weights too.
vec4 marched_near(vec3 there, out float depth, out float total) {
    vec4 sum = vec4(0.0), sum_x = vec4(0.0), sum_y = vec4(0.0);
    vec2 mean = vec2(0.0);
    vec3 square = vec3(1e-4, 0.0, 1e-4);
    depth = total = 0.0;
    for (int slot = 0; slot < 16; ++slot) {
        if (u_moved[slot].w == 0.0) continue;
        vec2 at = was_at(there, slot);
        ivec2 texel = ivec2(floor((at - vec2(ORDER[slot])) / float(BLOCK) + 0.5));
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, u_part))) continue;
        vec2 off = vec2(texel * BLOCK + ORDER[slot]) - at;
        float weight = exp(-SHARP * dot(off, off));
        vec4 value = texelFetch(u_parts, corner(slot) + texel, 0) * u_gone_on[slot] * weight;
        sum += value;
        sum_x += value * off.x;
        sum_y += value * off.y;
        mean += off * weight;
        square += vec3(off.x * off.x, off.x * off.y, off.y * off.y) * weight;
        depth += texelFetch(u_parts_depth, corner(slot) + texel, 0).r * weight;
        total += weight;
    }
    float one = 1.0 / max(total, 1e-9);
    depth *= one;
    sum *= one;
    mean *= one;
    square = square * one - vec3(mean.x * mean.x, mean.x * mean.y, mean.y * mean.y) + vec3(FLAT, 0.0, FLAT);
    vec4 along_x = sum_x * one - sum * mean.x, along_y = sum_y * one - sum * mean.y;
    float determinant = square.x * square.z - square.y * square.y;
    vec4 slope_x = (along_x * square.z - along_y * square.y) / determinant;
    vec4 slope_y = (along_y * square.x - along_x * square.y) / determinant;
    return sum - slope_x * mean.x - slope_y * mean.y;
}

// The last image at a place in its pixels: Catmull-Rom by nine fetches.
vec4 remembered(vec2 at) {
    vec2 size = u_cloud_size, low = floor(at), f = at - low;
    low += 0.5;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f), w12 = w1 + w2;
    vec2 a = (low - 1.0) / size, b = (low + w2 / w12) / size, c = (low + 2.0) / size;
    vec3 y = vec3(a.y, b.y, c.y), weight_y = vec3(w0.y, w12.y, w3.y);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 3; ++i) {
        vec4 row = textureLod(u_last, vec2(a.x, y[i]), 0.0) * w0.x + textureLod(u_last, vec2(b.x, y[i]), 0.0) * w12.x;
        sum += (row + textureLod(u_last, vec2(c.x, y[i]), 0.0) * w3.x) * weight_y[i];
    }
    return sum;
}

#ifdef MOVED
// A pixel that was not marched: what is remembered of it, held near what was marched about it.
vec4 moved_light(ivec2 pixel, ivec2 block, vec4 fresh, inout float depth) {
    vec2 clip = (vec2(pixel) + 0.5) / u_cloud_size * 2.0 - 1.0;
    vec3 there = normalize(u_ray_centre + clip.x * u_ray_x + clip.y * u_ray_y) * max(depth, 1.0);
    vec4 low = fresh, high = fresh, light = fresh;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            vec4 other = texelFetch(u_parts, corner(u_slot) + clamp(block + ivec2(x, y), ivec2(0), u_part - 1), 0);
            low = min(low, other);
            high = max(high, other);
        }
    }
    vec2 at = was_at(there, LAST);
    if (all(greaterThan(at, vec2(-0.5))) && all(lessThan(at, u_cloud_size - 0.5))) {
        light = remembered(at) * u_gone_on[LAST];
        depth = textureLod(u_last_depth, (at + 0.5) / u_cloud_size, 0.0).r;
    }
    float marched_depth, total;
    vec4 marched = marched_near(there, marched_depth, total);
    float share = smoothstep(SPARSE, DENSE, total);
    vec4 room = ROOM * (high - low);
    light = clamp(mix(light, marched, share), max(low - room, 0.0), high + room);
    light.a = clamp(light.a, 0.0, 1.0);
    depth = mix(depth, marched_depth, share);
    return light;
}
#endif

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), block = pixel / BLOCK, fresh = corner(u_slot) + block;
    bool marched_now = pixel - block * BLOCK == ORDER[u_slot];
#ifdef STILL
    out_light = marched_now ? texelFetch(u_parts, fresh, 0) : texelFetch(u_last, pixel, 0);
    out_depth = marched_now ? texelFetch(u_parts_depth, fresh, 0).r : texelFetch(u_last_depth, pixel, 0).r;
#else
    vec2 near = fresh_at(vec2(pixel));
    vec4 light = textureLod(u_parts, near, 0.0);
    float depth = textureLod(u_parts_depth, near, 0.0).r;
#ifdef MOVED
    light = moved_light(pixel, block, light, depth);
#endif
    out_light = marched_now ? texelFetch(u_parts, fresh, 0) : light;
    out_depth = marched_now ? texelFetch(u_parts_depth, fresh, 0).r : depth;
#endif
}
#endif
