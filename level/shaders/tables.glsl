// Small tables in one texture, for a program has 16 at most. The twin is level/tables.py.
uniform sampler2D u_tables;  // RGBA32F: two rows of the water table (H15), then the noise lattice in the first channel

const int TABLE_TEXELS = 1024, LATTICE_ROW = 2;
