// What the water mirrors of the land (H17): the plane's mirror image (shaders/reflections.glsl), looked up where the wave
// sends the view to.
uniform sampler2D u_mirrored;      // radiance times share, share that is land; with mip levels
uniform sampler2D u_mirrored_way;  // one over the level metres from the eye to what is mirrored, share known
const float FRINGE = 0.03;         // of the picture's height: beyond its edge nothing is known
const int TAPS = 4;
const float TAP[TAPS] = float[TAPS](-1.15, -0.32, 0.32, 1.15);  // middles of quarters of a Gaussian bell

// Radiance times share, share; `known` is how far sky or land is certain at all. A rough surface mirrors a lobe that is
// long up and down: slopes turn a low view's height, hardly its side.
vec4 land_mirrored(vec3 relative, vec3 mirror, float roughness, out float known) {
    vec2 to_uv = 1.0 / (2.0 * vec2(textureSize(u_mirrored, 0)));
    float away = length(relative), level_m = length(relative.xy), fall = u_sea_now_m - u_camera.z;
    vec2 at = gl_FragCoord.xy;
    vec3 image = vec3(0.0);
    float m = 0.0;
    vec4 clip = vec4(0.0);
    for (int i = 0; i < 2; ++i) {
        m = min(textureLod(u_mirrored_way, at * to_uv, 0.0).r * level_m, 1.0);
        // the mirror image, below the plane, of what the ray meets, times m: it may be infinitely far
        image = m * relative + (1.0 - m) * away * vec3(mirror.xy, max(mirror.z, 0.0));
        image.z = min(2.0 * fall * m - image.z, -1e-4 * away);
        clip = u_view_projection * vec4(image, 0.0);
        if (clip.w <= 1e-6) break;
        at = (clip.xy / clip.w * 0.5 + 0.5) * u_size;
    }
    known = 0.0;
    if (clip.w <= 1e-6) return vec4(0.0);
    float spread = 2.0 * 0.7071 * roughness * roughness * (1.0 - m) * away;
    float pixels = spread / max(clip.w * u_pixel_angle, 1e-6);
    int taps = pixels < 2.0 ? 1 : TAPS;
    float lod = clamp(log2(max(0.2 * pixels, 1.0)), 0.0, 4.0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < taps; ++i) {
        vec3 turned = image;
        if (taps > 1) turned.z = min(image.z - spread * TAP[i], -1e-4 * away);
        vec4 there = u_view_projection * vec4(turned, 0.0);
        vec2 pixel = (there.xy / max(there.w, 1e-6) * 0.5 + 0.5) * u_size;
        vec2 off = max(max(-pixel, pixel - u_size), 0.0) / (FRINGE * u_size.y);
        float share = clamp(1.0 - max(off.x, off.y), 0.0, 1.0);
        vec2 way = textureLod(u_mirrored_way, pixel * to_uv, 0.0).rg;
        // land between the eye and the water is not before a ray that goes on beyond it
        float beyond = 1.0 - smoothstep(1.02, 1.1, way.r * level_m);
        sum += share * beyond * textureLod(u_mirrored, pixel * to_uv, lod);
        known += share * way.g;
    }
    known /= float(taps);
    sum /= float(taps);
    known = max(known, sum.a);
    return sum;
}
