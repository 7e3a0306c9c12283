// The wind that roughens the water (L07); renderer/look.py.

uniform vec2 u_wind_way;     // horizontal unit vector, where it goes to
uniform vec2 u_wind_spread;  // share of the ripples' mean square slope along and across it; sum 1
