// How far the sheet runs up the sand (D10, H20). The twin is level/shore_swash.py; shore.glsl has the uniforms.

// How far along its way up and back a wave is at phase q: 0 at the still water line, 1 where it turns. It goes up with the
// speed of its front, and gravity stops it.
vec3 swash_run(vec3 q) {
    if (q.x >= u_shore_uprush) return d_const(1.0) - d_step(u_shore_uprush, 1.0, q);
    vec3 u = q / u_shore_uprush;
    return vec3(u.x * (1.0 + u.x * (1.0 - u.x)), (1.0 + u.x * (2.0 - 3.0 * u.x)) * u.yz);
}

// Where the wave of this number turns, against the run-up limit.
vec3 swash_reach(vec2 xy, int wave) { return d_const(1.0) - wave_noise(xy, wave) * u_shore_runup_variety; }

// Part of the run-up limit that waves reach at all, by the slope of the beach; a dual.
vec3 slope_reach(vec2 xy) {
#ifdef TRAVEL_TIME
    if (u_shore_runup_by_slope <= 0.0) return d_const(1.0);
    vec3 part = breaks_at(xy).runup_m / max(u_shore_range_m * u_shore_runup, 1e-3);
    part = part.x < 1.0 ? part : d_const(1.0);
    return d_const(1.0) + (part - d_const(1.0)) * (u_shore_runup_by_slope * u_arrival_share);
#else
    return d_const(1.0);
#endif
}

// How far the swash has run, 0 at the still water line, 1 at the run-up limit.
vec3 shore_swash(vec2 xy, vec3 arrived) {
    int wave = u_shore_cycle * u_shore_count + int(floor(arrived.x));
    return d_mul(swash_run(vec3(fract(arrived.x), arrived.yz)), swash_reach(xy, wave));
}
