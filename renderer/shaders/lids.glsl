// Lids of hulls: depth only, so that the sea behind them is not drawn (D12).
#include "lib/frame.glsl"

#ifdef VERTEX
#include "lib/prop.glsl"
void main() { gl_Position = u_view_projection * vec4(prop_relative(), 1.0); }
#endif

#ifdef FRAGMENT
void main() {}
#endif
