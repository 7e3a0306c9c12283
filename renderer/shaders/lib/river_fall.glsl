// White water that hangs on a fall (D16). Included by lib/river.glsl, which has Stream and the mixing of copies.
const float WAYS = 48.0;  // directions that a curtain's strands may hang in, so that none slants with the map's last digit

// Noise and foam of a curtain hung in one of them: across it in metres, down it in time of fall, which draws strands out
// as they speed up. Two copies as in river_phases; a cycle long in time, so neither ever jumps.
void strands(vec2 xy, float which, float fall_s, float lod, out vec4 noise, out vec4 foam, out vec4 still) {
    float angle = 6.28318530718 * which / WAYS, across = dot(xy, vec2(-sin(angle), cos(angle))) / u_river_strand_m;
    float moved = u_river_cycle.z > 0.0 ? u_river_cycle.x : 0.0, a = moved - fall_s / max(u_river_cycle.z, 1.0), b = a + 0.5;
    vec2 number = floor(vec2(a, b)) + u_river_cycle.y + 64.0;
    if (u_river_turns > 0.0) number = mod(number, u_river_turns);
    float weight = abs(2.0 * fract(a) - 1.0);
    vec2 first = vec2(across + JUMP.x * number.x, -a), second = vec2(across + JUMP.y * number.y + OTHER.x, -b);
    noise = river_mixed(textureLod(u_noise, first, lod), textureLod(u_noise, second, lod), weight, vec4(0.5));
    foam = river_mixed(textureLod(u_foam, first * vec2(1.0, 2.0), lod + 1.0), textureLod(u_foam, second * vec2(1.0, 2.0), lod + 1.0),
                       weight, vec4(0.5, 0.5, 0.5, 0.35));
    still = textureLod(u_noise, vec2(0.37 * across, 0.11 * fall_s), lod);
}

// A fall (D16): clear over its lip, then strands that break up where they will, white further down.
Foam curtain_foam(Stream s, vec2 xy, float pixel_m) {
    float fall_s = sqrt(2.0 * s.fallen / EARTH_G), lod = max(log2(pixel_m * NOISE_TEXELS / u_river_strand_m), 0.0);
    float which = atan(s.way.y, s.way.x) * WAYS / 6.28318530718, part = smoothstep(0.3, 0.7, fract(which));
    vec4 noise, foam, still;
    strands(xy, floor(which) + step(0.5, part), fall_s, lod, noise, foam, still);
    if (part > 0.02 && part < 0.98) {
        vec4 n, f, k;
        strands(xy, floor(which) + step(part, 0.5), fall_s, lod, n, f, k);
        float other = min(part, 1.0 - part);
        noise = river_mixed(noise, n, other, vec4(0.5));
        foam = river_mixed(foam, f, other, vec4(0.5, 0.5, 0.5, 0.35));
        still = river_mixed(still, k, other, vec4(0.5));
    }
    float clear_m = u_river_fall_clear_m * (0.25 + 1.5 * smoothstep(0.25, 0.75, still.g));
    float broken = smoothstep(0.35 * clear_m, clear_m + 0.9, s.fallen), low = smoothstep(1.5, 6.0, s.fallen);
    // rock that stands behind parts the water
    float parted = smoothstep(0.55, 0.78, still.b) * (1.0 - 0.6 * low);
    float thread = clamp(0.5 + 2.1 * (0.42 * noise.g + 0.28 * noise.b + 0.3 * foam.g - 0.5), 0.0, 1.0);
    float amount = broken * mix(0.56, 0.84, low) * (1.0 - 0.6 * parted) + 0.1 * (1.0 - broken);
    float cover = smoothstep(-0.26, 0.26, thread - (1.0 - amount)) * mix(0.72, 0.96, low) * mix(0.45, 1.0, broken);
    return Foam(cover, amount, 0.45 * broken, saturate(1.6 * (thread - 0.55) + 0.45), 0.6);
}

Foam mixed_foam(Foam a, Foam b, float t) {
    return Foam(mix(a.cover, b.cover, t), mix(a.amount, b.amount, t), mix(a.bubbles, b.bubbles, t),
                mix(a.relief, b.relief, t), mix(a.fresh, b.fresh, t));
}
