// What the current carries, read in two copies half a cycle apart (D05; Vlachos, SIGGRAPH 2010).

uniform float u_foam_tile_m;
uniform vec3 u_foam_cycle;       // part of a cycle of moving foam, number of whole ones, seconds a cycle; 0 s: it stands
uniform float u_foam_turns;      // after so many cycles the same ones come again; 0: never

const float STILL_MPS = 1e-3;  // slower water stands still, and so does what lies on it
// a copy that starts again starts elsewhere, never the same way twice in a row, or the eye finds the rhythm
const vec2 JUMP = vec2(0.24, 0.2083333), OTHER = vec2(0.37, 0.61);

bool flow_moves(vec2 flow) { return u_foam_cycle.z > 0.0 && dot(flow, flow) >= STILL_MPS * STILL_MPS; }

// Where each copy is read, in tiles, and the weight of the second, which is whole when the first starts again; `early`: by
// how many cycles this place begins before others.
void flow_places(vec2 xy, vec2 flow, float early, out vec2 first, out vec2 second, out float weight) {
    first = xy / u_foam_tile_m;
    second = first + OTHER;
    weight = 0.0;
    if (!flow_moves(flow)) return;
    float a = u_foam_cycle.x + early, b = a + 0.5;
    vec2 number = floor(vec2(a, b)) + u_foam_cycle.y;
    if (u_foam_turns > 0.0) number = mod(number, u_foam_turns);
    vec2 way = flow * (u_foam_cycle.z / u_foam_tile_m);
    first += JUMP * number.x - way * (fract(a) - 0.5);
    second += JUMP.yx * number.y - way * (fract(b) - 0.5);
    weight = abs(2.0 * fract(a) - 1.0);
}
