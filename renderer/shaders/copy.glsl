// One texture to the target, times a factor: sums of jittered frames.
#ifdef VERTEX
void main() {
    gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0), 0.0, 1.0);
}
#endif

#ifdef FRAGMENT
uniform sampler2D u_source;
uniform float u_factor;
out vec4 out_colour;

void main() { out_colour = texelFetch(u_source, ivec2(gl_FragCoord.xy), 0) * u_factor; }
#endif
