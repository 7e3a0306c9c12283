// The wet shore (L06): damp sand up to the run-up limit, and the film that mirrors the sky behind the draining sheet.
#include "lib/swash.glsl"
#include "lib/noise.glsl"

struct Wet {
    float damp;  // 1 wet through
    float film;  // 1 covered by a film of water
};

// `height` over the still sea. Stateless: where the sheet stood follows from the clock (level/shore.glsl).
Wet shore_wet(vec2 xy, float height, float pixel_m) {
    float top = u_shore_range_m * u_shore_runup;
    if (height > 1.5 * top + 0.4) return Wet(0.0, 0.0);
    float sea = bed_at(xy).sea.x;
    float moving = u_shore_on * u_shore_vertex * sea;
    vec4 noise = noise_at(xy, 31.0, pixel_m);
    float ragged = 0.16 * (noise.g - 0.5) + 0.07 * (noise.b - 0.5);
    float reach = height / max(top, 0.05);  // 0 at the still sea, 1 at the run-up limit
    // wet through below, drying towards the line the last waves reached
    float damp = (1.0 - smoothstep(0.60, 1.18, reach + ragged)) * max(moving, 1.0 - smoothstep(0.0, 0.1, height));
    vec3 early = swash_early(xy);
    float q = swash_phase(early);
    // while the next wave runs up, the film is what the last one left
    float stood = q < u_shore_uprush ? 0.0 : shore_swash(early).x;
    float left = q < u_shore_uprush ? 1.0 - 0.5 * q / u_shore_uprush : 1.0;
    float film = (1.0 - smoothstep(0.0, 0.65, reach - stood + 0.5 * ragged)) * left * moving;
    film *= 1.0 - smoothstep(0.85, 1.0, reach + ragged);
    return Wet(damp, film);
}
