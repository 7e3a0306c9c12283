// Rings on the water (H19): slopes alone, no vertex moves. level/rings.py says where they come from and has the source.
uniform int u_ring_count;
uniform vec4 u_ring_place[16];  // world xy, age s (below 0: a floating thing), reach m
uniform vec4 u_ring_wave[16];   // wave number 1/m, slope, fading m, phase
const float RING_GRAVITY = 9.81;
const float RING_BAND = 2.7;  // log2 of the wave number's bell: so narrow that a few crests show

// Slope that rings add, and in z the slope² of those too short for a pixel.
vec3 ring_slope(vec2 xy, float pixel_m) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < u_ring_count; ++i) {
        vec4 place = u_ring_place[i], wave = u_ring_wave[i];
        vec2 off = xy - place.xy;
        float r = length(off);
        if (r >= place.w || r < 1e-3) continue;
        float k = wave.x, slope = wave.y;
        if (place.z >= 0.0) {
            float middle = 0.5 * sqrt(RING_GRAVITY / k) * place.z, octaves = log2(middle / r);
            slope *= exp2(-RING_BAND * octaves * octaves) * sqrt(wave.z / (r + wave.z));
            slope *= sin(k * middle * middle / r);
            k *= (middle / r) * (middle / r);
        } else {
            // from a hand's breadth round the thing on; to nothing at the reach
            float rim = 1.0 - r / place.w;
            slope *= smoothstep(0.4, 2.0, k * r) * exp(-r / wave.z) * inversesqrt(1.0 + 0.25 * k * r) * min(4.0 * rim, 1.0);
            slope *= sin(k * r - wave.w);
        }
        float turn = 0.4 * k * pixel_m, shown = 1.0 / (1.0 + turn * turn * turn * turn);
        sum.xy += off / r * (slope * shown);
        sum.z += slope * slope * (1.0 - shown * shown);
    }
    return sum;
}
