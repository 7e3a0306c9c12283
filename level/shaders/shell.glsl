// The shell of clouds round the planet (Z12), in forms that lose no digits at Earth's radius: heights are those over the
// sea, places are relative to the camera. level/pick_sky.py has the same forms.

uniform float u_clouds_base_m, u_clouds_top_m, u_planet_m;
uniform float u_eye_m;  // height of the camera over the sea

const float NEVER = -1.0;

// Height over the sea of a place relative to the camera.
float altitude_of(vec3 p) {
    float z = p.z + u_eye_m;
    float square = dot(p.xy, p.xy) + z * z;
    return (2.0 * u_planet_m * z + square) / (sqrt(square + 2.0 * u_planet_m * z + u_planet_m * u_planet_m) + u_planet_m);
}

// Distances at which a ray from the camera enters and leaves the sphere of a height; NEVER where it misses it.
vec2 sphere_hits(vec3 dir, float height) {
    float b = (u_planet_m + u_eye_m) * dir.z;
    float c = (u_eye_m - height) * (2.0 * u_planet_m + u_eye_m + height);
    float inner = b * b - c;
    if (inner < 0.0) return vec2(NEVER);
    float q = -(b + (b < 0.0 ? -1.0 : 1.0) * sqrt(inner));
    float one = q, other = abs(q) > 0.0 ? c / q : 0.0;
    return vec2(min(one, other), max(one, other));
}

// From where to where a ray is inside the shell, first time; x > y where it isn't.
vec2 shell_span(vec3 dir) {
    vec2 ground = sphere_hits(dir, min(0.0, u_eye_m - 1.0)), base = sphere_hits(dir, u_clouds_base_m), top = sphere_hits(dir, u_clouds_top_m);
    bool down = ground.x > 0.0;  // the planet is in the way
    vec2 span = vec2(1.0, 0.0);
    if (u_eye_m < u_clouds_base_m) {
        if (!down) span = vec2(base.y, top.y);
    } else if (u_eye_m <= u_clouds_top_m) span = vec2(0.0, base.x > 0.0 ? base.x : top.y);
    else if (top.x > 0.0) span = vec2(top.x, base.x > 0.0 ? base.x : top.y);
    return span;
}
