// The one display transform (L01): linear scene light in kcd/m² to linear display light, then sRGB, then dither.

// EV100 to the factor on kcd/m²: 1 is where a sensor of ISO 100 saturates (Lagarde & de Rousiers 2014, 4.1.2).
float exposure_scale(float ev100) { return 1000.0 / (1.2 * exp2(ev100)); }

// AgX's idea (Sobotka): pull colours together, a sigmoid per channel in log space, push them apart again. Own curve and
// matrix: grey is kept exactly, because the pull goes along a weighted mean whose weights sum to 1.
const vec3 AGX_MEAN = vec3(0.27, 0.47, 0.26);
const float AGX_PULL = 0.11, AGX_PUSH = 0.335;
const float AGX_DARK = -9.5, AGX_LIGHT = 5.0;   // stops round middle grey

float agx_sigmoid(float stops) {
    const float grey = 0.4695;                     // 0.18 through a gamma of 2.2667, lifted a little
    const float slope = 0.156;                    // display units a stop at the pivot
    float side = stops > 0.0 ? 1.0 - grey : grey;
    float reach = stops > 0.0 ? AGX_LIGHT : -AGX_DARK;
    float power = stops > 0.0 ? 1.9 : 1.9;
    // x / (1 + (x / c)^p)^(1/p) with c such that the end of the range lands on the end of the display
    float x = slope * abs(stops), end = slope * reach;
    float c = side * end / pow(pow(end, power) - pow(min(side, end * 0.999), power), 1.0 / power);
    float y = x / pow(1.0 + pow(x / c, power), 1.0 / power);
    return clamp(grey + sign(stops) * y, 0.0, 1.0);
}

vec3 agx(vec3 c) {
    c = mix(c, vec3(dot(c, AGX_MEAN)), AGX_PULL);
    vec3 stops = clamp(log2(max(c, vec3(1e-10)) / 0.18), AGX_DARK, AGX_LIGHT);
    c = pow(vec3(agx_sigmoid(stops.r), agx_sigmoid(stops.g), agx_sigmoid(stops.b)), vec3(2.2667));
    c = (c - AGX_PUSH * dot(c, AGX_MEAN)) / (1.0 - AGX_PUSH);
    return clamp(c, 0.0, 1.0);
}

// Fit of the ACES reference and output transforms by S. Hill; rows divided by their sums so that grey stays grey.
vec3 aces(vec3 c) {
    c = vec3(dot(c, vec3(0.59719, 0.35458, 0.04823)), dot(c, vec3(0.07600, 0.90834, 0.01566)) ,
             dot(c, vec3(0.02840, 0.13383, 0.83777)));
    c *= 1.7;                                     // brings middle grey to where the others have it
    c = (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081);
    c = vec3(dot(c, vec3(1.60475, -0.53108, -0.07367)), dot(c, vec3(-0.10208, 1.10813, -0.00605)),
             dot(c, vec3(-0.00327, -0.07276, 1.07602)) / 0.99999);
    return clamp(c, 0.0, 1.0);
}

// Khronos PBR neutral (published specification): colours are kept up to a knee, then compressed towards white.
vec3 neutral(vec3 c) {
    const float knee = 0.8 - 0.04, fade = 0.15;
    float low = min(c.r, min(c.g, c.b));
    c -= low < 0.08 ? low - 6.25 * low * low : 0.04;
    float peak = max(c.r, max(c.g, c.b));
    if (peak < knee) return clamp(c, 0.0, 1.0);
    float room = 1.0 - knee;
    float pressed = 1.0 - room * room / (peak + room - knee);
    c *= pressed / peak;
    float white = 1.0 - 1.0 / (fade * (peak - pressed) + 1.0);
    return clamp(mix(c, vec3(pressed), white), 0.0, 1.0);
}

// transform: 0 AgX-like, 1 ACES fitted, 2 neutral, 3 raw. `exposure` is exposure_scale(EV100). Linear display light.
vec3 display_transform(vec3 linear_radiance, float exposure, int transform) {
    vec3 c = max(linear_radiance, vec3(0.0)) * exposure;
    if (transform == 0) return agx(c);
    if (transform == 1) return aces(c);
    if (transform == 2) return neutral(c);
    return clamp(c, 0.0, 1.0);
}

vec3 srgb_encode(vec3 c) {
    c = clamp(c, 0.0, 1.0);
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// ±½ of an 8-bit step, spread by interleaved gradient noise (Jimenez 2014).
vec3 dither(vec2 pixel) {
    vec3 n = fract(52.9829189 * fract(vec3(dot(pixel, vec2(0.06711056, 0.00583715)),
                                           dot(pixel + 47.0, vec2(0.06711056, 0.00583715)),
                                           dot(pixel + 101.0, vec2(0.06711056, 0.00583715)))));
    return (n - 0.5) / 255.0;
}
