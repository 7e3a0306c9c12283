// The sky's mirror image for every roughness (L02): octahedral maps of the whole sphere, one below the other, each with a
// border of one texel so that filtering may cross the seams. passes/lobes.py has the same table.

const int LOBES = 6;
const float LOBE_SIZE[6] = float[6](192.0, 64.0, 32.0, 32.0, 16.0, 16.0);
const float LOBE_FROM[6] = float[6](0.0, 192.0, 256.0, 288.0, 320.0, 336.0);
const float LOBE_ROUGHNESS[6] = float[6](0.0, 0.2, 0.35, 0.5, 0.7, 1.0);
const vec2 LOBE_ATLAS = vec2(192.0, 352.0);

vec2 oct_encode(vec3 dir) {
    vec2 p = dir.xy / (abs(dir.x) + abs(dir.y) + abs(dir.z));
    vec2 side = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    if (dir.z < 0.0) p = (1.0 - abs(p.yx)) * side;
    return p * 0.5 + 0.5;
}

// Also for places a little outside 0 … 1: there the map goes on across its seam.
vec3 oct_decode(vec2 uv) {
    vec2 p = uv * 2.0 - 1.0;
    if (abs(p.x) > 1.0) p = vec2(sign(p.x) * (2.0 - abs(p.x)), -p.y);
    if (abs(p.y) > 1.0) p = vec2(-p.x, sign(p.y) * (2.0 - abs(p.y)));
    vec3 dir = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    vec2 side = vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    if (dir.z < 0.0) dir.xy = (1.0 - abs(p.yx)) * side;
    return normalize(dir);
}

#ifndef MAKE_LOBES
uniform sampler2D u_lobes;
uniform vec3 u_lobes_gone_on;  // the sky's light now over that which they were made in, where a day runs

vec3 lobe_at(vec2 oct, int level) {
    float inner = LOBE_SIZE[level] - 2.0;
    return textureLod(u_lobes, (oct * inner + 1.0 + vec2(0.0, LOBE_FROM[level])) / LOBE_ATLAS, 0.0).rgb;
}

// Radiance of sky and ground round a direction, averaged over the lobe of a roughness.
vec3 sky_lobe(vec3 dir, float roughness) {
    vec2 oct = oct_encode(dir);
    int level = 0;
    while (level < LOBES - 2 && roughness > LOBE_ROUGHNESS[level + 1]) ++level;
    float low = LOBE_ROUGHNESS[level], high = LOBE_ROUGHNESS[level + 1];
    vec3 lobe = mix(lobe_at(oct, level), lobe_at(oct, level + 1), clamp((roughness - low) / (high - low), 0.0, 1.0));
    return lobe * u_lobes_gone_on;
}
#endif
