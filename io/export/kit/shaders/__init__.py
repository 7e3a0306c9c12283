"""The kit's own GLSL: what games ask for, and what reads textures by hand in place of `level/shaders` of that name."""
