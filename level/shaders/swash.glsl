// When the last sheet came and how far it has drained, from the shore clock alone: water, sand and foam agree (D03).
#include "level/shore.glsl"

// 0 when a wave meets the still water line, 1 when the next one does; it runs up until u_shore_uprush.
float swash_phase(ShoreMasks m) { return fract(m.arrived); }

// 0 while the sheet runs up, growing to 1 while it drains.
float swash_drained(float phase) { return clamp((phase - u_shore_uprush) / max(1.0 - u_shore_uprush, 1e-3), 0.0, 1.0); }
