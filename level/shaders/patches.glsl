// Overridden hectares of the sea (H27). The twin is level/patches.py. Without any (no PATCHED) it costs nothing.
#include "level/dual.glsl"

#ifdef PATCHED
uniform vec4 u_patch_rects[32];  // west, south, east, north in world metres: open ones, coastal ones, removed ones
uniform ivec3 u_patch_ends;      // where each of these kinds ends

const float PATCH_FADE_M = 20.0;

// 0 in the first `end` rectangles, 1 from PATCH_FADE_M beside them on; a dual.
vec3 patch_beside(vec2 xy, int end) {
    vec3 best = vec3(1e9, 0.0, 0.0);
    for (int i = 0; i < end; ++i) {
        vec2 off = xy - clamp(xy, u_patch_rects[i].xy, u_patch_rects[i].zw);
        float away = length(off);
        if (away < best.x) best = vec3(away, off / max(away, 1e-6));
    }
    return d_step(0.0, PATCH_FADE_M, best);
}

// Share of the shore waves: 0 where a patch is overridden as open; a dual.
vec3 patch_shore(vec2 xy) { return patch_beside(xy, u_patch_ends.x); }

// Share of the sheet's contact with the beach (H10): 0 where it is overridden as open or coastal; a dual.
vec3 beach_contact(vec2 xy) { return patch_beside(xy, u_patch_ends.y); }

bool patch_removed(vec2 xy) {
    for (int i = u_patch_ends.y; i < u_patch_ends.z; ++i)
        if (all(greaterThanEqual(xy, u_patch_rects[i].xy)) && all(lessThan(xy, u_patch_rects[i].zw))) return true;
    return false;
}
#else
vec3 patch_shore(vec2 xy) { return d_const(1.0); }
vec3 beach_contact(vec2 xy) { return d_const(1.0); }
bool patch_removed(vec2 xy) { return false; }
#endif
