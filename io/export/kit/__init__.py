"""The runtime kit (T09): the sea's own GLSL, and the same functions written in C, HLSL and Godot's language from it."""
