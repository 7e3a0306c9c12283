// The unit that costs of passes are quoted in (Y): sixteen filtered fetches for every pixel of the picture.
#ifdef VERTEX
out vec2 v_uv;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    v_uv = corner * 0.5 + 0.5;
    gl_Position = vec4(corner, 0.0, 1.0);
}
#endif

#ifdef FRAGMENT
in vec2 v_uv;
uniform sampler2D u_noise;
out vec4 out_colour;
void main() {
    vec4 s = vec4(0.0);
    for (int i = 0; i < 16; ++i) s += texture(u_noise, v_uv * float(i));
    out_colour = s / 16.0;
}
#endif
