"""Rows of VIEWS that show where rivers run, how high they stand, and what comes into them of the sea (D13, D35)."""

from __future__ import annotations

from .view_row import View

MOUTH_VIEWS = (
    View("river_flow", "River: heading and speed", "Where the current goes as hue, east red, north green; how fast as "
         "brightness, 2 m/s to full.", "on_sea * river_flow_shown(s.before)", "direct", ids="D13 D06"),
    View("river_level", "River: level", "How high water that isn't the sea stands, 10 m over the mean sea to white.",
         "vec3(on_sea * river_level_shown(sea))", "grey", 0, 10, ids="D13"),
    View("mouth", "Mouth", "Waves of the sea that come there: red swell, green chop, at sea half bright; blue where "
         "the current holds them up.", "on_sea * mouth_shown(sea)", "direct", ids="D35"),
    View("plume", "Plume", "Red a river's water out to sea, green foam along its sides, blue that of chop which the "
         "current stops.", "on_sea * plume_shown(sea, s.before, s.eye_depth * u_pixel_angle)", "direct", ids="D35"),
)  # fmt: skip
