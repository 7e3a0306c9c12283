// Rings on the water (H19): slopes alone, no vertex moves. level/rings.py says where they come from and has the source.
uniform int u_ring_hits, u_ring_count;  // hits come first, then what floats
uniform vec4 u_ring_place[16];          // world xy, radius of a hit's middle m, reach m
uniform vec4 u_ring_wave[16];           // wave number 1/m, slope, fading m, phase
const float RING_BAND = 2.7;            // log2 of the wave number's bell: so narrow that a few crests show

// 1 for waves longer than some pixels, 0 for shorter ones.
float ring_shown(float k, float pixel_m) {
    float turn = 0.16 * k * k * pixel_m * pixel_m;
    return 1.0 / (1.0 + turn * turn);
}

// Slope that rings add, and in z the slope² of those too short for a pixel.
vec3 ring_slope(vec2 xy, float pixel_m) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < u_ring_hits; ++i) {
        vec4 place = u_ring_place[i], wave = u_ring_wave[i];
        vec2 off = xy - place.xy;
        float r2 = max(dot(off, off), 1e-6), inverse = inversesqrt(r2);
        float part = place.z * inverse, octaves = log2(part);
        float slope = wave.y * exp2(-RING_BAND * octaves * octaves) * inversesqrt(1.0 + r2 * inverse / wave.z);
        slope *= r2 < place.w * place.w ? sin(wave.x * place.z * part) : 0.0;
        float shown = ring_shown(wave.x * part * part, pixel_m);
        sum += vec3(off * (inverse * slope * shown), slope * slope * (1.0 - shown * shown));
    }
    for (int i = u_ring_hits; i < u_ring_count; ++i) {
        vec4 place = u_ring_place[i], wave = u_ring_wave[i];
        vec2 off = xy - place.xy;
        float r = max(length(off), 1e-3), turns = wave.x * r;
        // from a hand's breadth round the thing on; to nothing at the reach
        float slope = wave.y * smoothstep(0.4, 2.0, turns) * exp(-r / wave.z) * inversesqrt(1.0 + 0.25 * turns);
        slope *= clamp(4.0 - 4.0 * r / place.w, 0.0, 1.0) * sin(turns - wave.w);
        float shown = ring_shown(wave.x, pixel_m);
        sum += vec3(off * (slope * shown / r), slope * slope * (1.0 - shown * shown));
    }
    return sum;
}
