// Foam that rides the sheet up the beach and back with it (H20): two copies half a wave apart, φ and φ + ½ of the shore's
// own phase, with weights 1 − |2φ − 1|, so that each starts again elsewhere while nobody sees it.

vec3 beach_ride = vec3(0.0);     // φ, number of the wave, share of the foam that rides
float beach_turns = 0.0;         // after so many waves the same ones come again; 0: never
vec2 beach_carried = vec2(0.0);  // where the sheet has carried it from the still water line, m

// Where each copy is read, in tiles, and the weight of the second.
void beach_places(vec2 xy, float tile_m, vec2 jump, vec2 other, out vec2 first, out vec2 second, out float weight) {
    vec2 at = (xy - beach_carried) / tile_m;
    float number = mod(beach_ride.y, 600.0);  // the jumps come round
    first = at + jump * number;
    float next = number + step(0.5, beach_ride.x);
    if (beach_turns > 0.0) next = mod(next, beach_turns);
    second = at + other + jump.yx * next;
    weight = abs(2.0 * beach_ride.x - 1.0);
}
