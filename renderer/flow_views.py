"""Rows of VIEWS that show the current as engines get it, decoded from the exporters' own bytes (T02)."""

from __future__ import annotations

from .view_row import View

FLOW_VIEWS = (
    View("flow_exported", "Flow: exported", "Foam that the exported 8-bit map moves, as a game shows it; orange where "
         "the map is at its end.", "mix(vec3(0.04), flow_exported(s.before, s.eye_depth * u_pixel_angle), on_sea)",
         "direct", ids="T02"),
    View("flow_lost", "Flow: lost", "How far the exported map is off the current, four of its steps to white; "
         "rounding is half a one.",
         "vec3(on_sea * flow_lost(s.before))", "grey", 0, 4, ids="T02"),
)  # fmt: skip
