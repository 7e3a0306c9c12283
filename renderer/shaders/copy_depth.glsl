// A depth texture into another of its size.
#ifdef VERTEX
void main() {
    gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0), 0.0, 1.0);
}
#endif

#ifdef FRAGMENT
uniform sampler2D u_source;
void main() { gl_FragDepth = texelFetch(u_source, ivec2(gl_FragCoord.xy), 0).r; }
#endif
