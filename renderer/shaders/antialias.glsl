// Edges of the finished picture smoothed (FXAA, T. Lottes 2009): where the light jumps, each pixel takes from across the
// edge as much as the edge's slope covers of it.
#include "lib/frame.glsl"

#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif

#ifdef FRAGMENT
uniform sampler2D shown;
out vec4 out_display;

const float LEAST_JUMP = 0.04, LEAST_SHARE = 0.12;  // of the light, and of the brightest neighbour
const float SINGLE = 0.6;                           // how much lone bright pixels give to their neighbours
const int REACH = 10;

vec3 colour_at(ivec2 pixel) { return texelFetch(shown, clamp(pixel, ivec2(0), textureSize(shown, 0) - 1), 0).rgb; }
float light_at(ivec2 pixel) { return dot(colour_at(pixel), vec3(0.299, 0.587, 0.114)); }

// Mean light of the two sides of an edge, `at` on one of them and `across` to the other.
float edge_light(ivec2 at, ivec2 across) { return 0.5 * (light_at(at) + light_at(at + across)); }

void main() {
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec3 here = colour_at(p);
    const ivec2 E = ivec2(1, 0), N = ivec2(0, 1);
    float m = light_at(p), n = light_at(p + N), s = light_at(p - N), e = light_at(p + E), w = light_at(p - E);
    float most = max(m, max(max(n, s), max(e, w))), least = min(m, min(min(n, s), min(e, w)));
    out_display = vec4(here, 1.0);
    if (most - least < max(LEAST_JUMP, LEAST_SHARE * most)) return;

    float ne = light_at(p + N + E), nw = light_at(p + N - E), se = light_at(p - N + E), sw = light_at(p - N - E);
    float flat_edge = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
    float upright = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
    bool level = flat_edge >= upright;
    ivec2 across = level ? N : E, along = level ? E : N;
    float plus = abs((level ? n : e) - m), minus = abs((level ? s : w) - m);
    if (minus > plus) across = -across;
    float jump = max(plus, minus), mean = edge_light(p, across);

    // to both ends of the edge
    int way[2] = int[2](REACH, REACH);
    float end[2] = float[2](0.0, 0.0);
    for (int side = 0; side < 2; ++side) {
        for (int i = 1; i <= REACH; ++i) {
            end[side] = edge_light(p + (side == 0 ? i : -i) * along, across) - mean;
            if (abs(end[side]) >= 0.25 * jump) {
                way[side] = i;
                break;
            }
        }
    }
    int near = way[0] < way[1] ? 0 : 1;
    float share = 0.5 - float(way[near]) / float(way[0] + way[1]);
    share = (end[near] < 0.0) == (m < mean) ? 0.0 : share;
    float around = (2.0 * (n + s + e + w) + ne + nw + se + sw) / 12.0;
    float alone = smoothstep(0.0, 1.0, abs(around - m) / (most - least));
    out_display.rgb = mix(here, colour_at(p + across), max(share, SINGLE * alone * alone));
}
#endif
