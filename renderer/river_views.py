"""Rows of VIEWS that show rivers: how they flow, their two layers of foam, where foam comes from (D14 to D16)."""

from __future__ import annotations

from .view_row import View

_AT = "sea, s.before, s.eye_depth * u_pixel_angle"

RIVER_VIEWS = (
    View("river_raw_flow", "River: flow", "The current of rivers, 2 m/s to full: red east, green north; grey is none.",
         f"on_sea * raw_flow({_AT})", "direct", ids="D14"),
    View("river_curl", "River: curl", "Eddies that are blended into it, likewise.",
         f"on_sea * curl_shown({_AT})", "direct", ids="D14"),
    View("river_flow_sum", "River: sum", "Flow and eddies together, likewise.",
         f"on_sea * flow_sum({_AT})", "direct", ids="D14"),
    View("river_stagnant", "River: stagnant foam", "The stagnant layer alone, before its mask.",
         f"vec3(on_sea * stagnant_shown({_AT}))", ids="D14"),
    View("river_turbulent", "River: turbulent foam", "The turbulent layer alone, before its mask.",
         f"vec3(on_sea * turbulent_shown({_AT}))", ids="D14"),
    View("river_masked", "River: foam", "Both layers under their masks: stagnant green, turbulent white.",
         f"on_sea * masked_shown({_AT})", "direct", ids="D14 D19"),
    View("river_normal_foam", "River: falls", "White where a river's level leans so far that its foam is full.",
         f"vec3(on_sea * fall_shown({_AT}))", ids="D16"),
)  # fmt: skip
