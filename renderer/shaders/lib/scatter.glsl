// An instance of a scattered thing: its mesh turned, tilted to the ground, bent by the wind (L09).

in vec3 in_position;  // the mesh: z up from the ground, unit size
in vec3 in_normal;
in float in_sway;     // 0 at the root … 1 at the tip
in vec4 in_place;     // foot relative to the eye, size in metres as drawn
in vec4 in_turn;      // cosine and sine of the yaw, normal xy
in vec4 in_look;      // tint, open sky, phase, size before it shrinks with distance

// East-like, north-like and up-like axes of an instance.
mat3 instance_axes() {
    vec3 up = vec3(in_turn.zw, sqrt(max(1.0 - dot(in_turn.zw, in_turn.zw), 0.0)));
    vec3 east = vec3(in_turn.xy, 0.0);
    east = normalize(east - up * dot(east, up));
    return mat3(east, cross(up, east), up);
}
