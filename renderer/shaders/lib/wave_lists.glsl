// Wave objects and regions of swell as colours, for the view of them: how many reach each hectare, their weight (H08).
const float HECTARE_M = 100.0;

vec3 wave_objects_colour(vec2 xy, float pixel_m) {
    const vec3 COUNTS[5] = vec3[5](vec3(0.05, 0.08, 0.14), vec3(0.08, 0.22, 0.45), vec3(0.08, 0.45, 0.40),
                                   vec3(0.75, 0.55, 0.15), vec3(0.75, 0.20, 0.10));
    vec2 low = floor(xy / HECTARE_M) * HECTARE_M;
    int count = 0;
    float weight = 0.0, region = 0.0;
#ifdef WAVE_OBJECTS
    for (int i = 0; i < u_wave_ends.y; ++i) {
        vec4 place = u_wave_place[i];
        count += distance(clamp(place.xy, low, low + HECTARE_M), place.xy) < place.w ? 1 : 0;
        weight = max(weight, circle_weight(place, xy).x);
    }
#endif
#ifdef WAVE_REGIONS
    for (int i = 0; i < u_region_count; ++i) region = max(region, region_weight(i, xy).x);
#endif
    vec2 coarse = abs(fract(xy / HECTARE_M + 0.5) - 0.5) * HECTARE_M;
    float far = 1.0 - smoothstep(0.05, 0.2, pixel_m / HECTARE_M);
    float line = 0.4 * far * (1.0 - smoothstep(0.5 * pixel_m, 2.0 * pixel_m + 0.3, min(coarse.x, coarse.y)));
    vec3 colour = mix(mix(COUNTS[min(count, 4)], vec3(0.6, 0.2, 0.7), 0.7 * region), vec3(1.0), 0.75 * weight);
    return mix(colour, vec3(0.9), line);
}
