// How much sky each sample of the ground sees: horizons in WAYS directions out to the last of u_steps, and from the
// same heights how broken the ground is. The surface's own plane hides nothing: its tilt is in the light's cosine already.
#include "lib/height.glsl"

#ifdef VERTEX
void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0), 0.0, 1.0); }
#endif

#ifdef FRAGMENT
uniform vec2 u_target;        // size of the map
uniform float u_steps[STEPS];  // in whole cells along the longer axis
out vec4 out_openness;

const float TAU = 6.2831853, QUARTER = 1.5707963;

// The cosine about the normal over one way's slice, from the zenith down to a horizon `down` radians below it, by the
// angle's own sine (Jimenez et al. 2016 do the same in screen space). `along` is the normal's part that way.
float slice(float down, float up, float along) {
    float sine = sin(down);
    return 0.5 * (up * sine * sine + along * (down - sine * cos(down)));
}

// The border goes on beyond the level, as the apron does nearby.
float height_clamped(ivec2 cell) {
    return texelFetch(u_height, clamp(cell, ivec2(0), textureSize(u_height, 0) - 1), 0).r;
}

// Where a way crosses a line of samples: between two of them, so that the way is kept to.
float height_across(ivec2 cell, vec2 off) {
    vec2 low = floor(off + 1e-4), f = max(off - low, 0.0);
    ivec2 one = cell + ivec2(low), other = one + ivec2(step(1e-3, f));
    return mix(height_clamped(one), height_clamped(other), max(f.x, f.y));
}

// Change of slope over two crossing ways at `radius_m`: the lesser of the two, as a share of the way.
float bend(ivec2 cell, float middle, vec2 way, float radius_m) {
    vec2 turned = vec2(-way.y, way.x);
    ivec2 a = ivec2(round(way * (radius_m / u_cell_m))), b = ivec2(round(turned * (radius_m / u_cell_m)));
    float one = height_clamped(cell + a) + height_clamped(cell - a), two = height_clamped(cell + b) + height_clamped(cell - b);
    return min(abs(one - 2.0 * middle), abs(two - 2.0 * middle)) / radius_m;
}

void main() {
    vec2 last = vec2(textureSize(u_height, 0) - 1);
    // snapped to a sample: between two a plain slope would seem bent
    ivec2 cell = ivec2(round((gl_FragCoord.xy - 0.5) / max(u_target - 1.0, 1.0) * last));
    float middle = height_clamped(cell);
    vec2 slope = vec2(height_clamped(cell + ivec2(1, 0)) - height_clamped(cell - ivec2(1, 0)),
                      height_clamped(cell + ivec2(0, 1)) - height_clamped(cell - ivec2(0, 1))) / (2.0 * u_cell_m);
    vec3 normal = normalize(vec3(-slope, 1.0)), bent = vec3(0.0);
    float seen = 0.0, all = 0.0;
    for (int k = 0; k < WAYS; ++k) {
        float angle = (float(k) + 0.25) * TAU / float(WAYS);
        vec2 way = vec2(cos(angle), sin(angle)), longer = way / max(abs(way.x), abs(way.y));
        float rise = 0.0;  // over the plane
        for (int i = 0; i < STEPS; ++i) {
            vec2 off = longer * u_steps[i], there = off * u_cell_m;
            rise = max(rise, (height_across(cell, off) - middle - dot(slope, there)) / length(there));
        }
        float plane = max(dot(slope, way), 0.0), along = dot(normal.xy, way);
        float free = QUARTER - atan(max(plane, dot(slope, way) + rise)), plain = QUARTER - atan(plane);
        seen += slice(free, normal.z, along);
        all += slice(plain, normal.z, along);
        bent += vec3(way * 0.5 * (free - sin(free) * cos(free)), 0.5 * sin(free) * sin(free));
    }
    // over three times the way broken rock bends a good half as much a metre
    float rough = min(bend(cell, middle, vec2(1.0, 0.0), 2.5), 1.6 * bend(cell, middle, vec2(0.7071), 8.0));
    bent = normalize(bent + vec3(0.0, 0.0, 1e-4));
    out_openness = vec4(clamp(seen / max(all, 1e-4), 0.0, 1.0), min(2.0 * rough, 1.0), bent.xy * 0.5 + 0.5);
}
#endif
