// An instance of a mesh from a file (D12): its scaled axes, and in their last parts its place relative to the eye.

in vec3 in_position;
in vec3 in_normal;
in vec3 in_colour;  // linear albedo
in vec4 in_east, in_north, in_up;
in vec4 in_mark;    // colour of the view of props, height of the water line in metres over the mesh's origin

vec3 prop_turned(vec3 v) { return in_east.xyz * v.x + in_north.xyz * v.y + in_up.xyz * v.z; }

vec3 prop_relative() { return vec3(in_east.w, in_north.w, in_up.w) + prop_turned(in_position); }
