"""The land lit before the water is drawn, and kept at half width and half height: what is seen through it (H12).

Plate A is the left half of one atlas, with caustics in it; plate B, the right half, is A blurred. The sea reads both
with views bent by its waves. The light pass then has only the sea left to light.
"""

from __future__ import annotations

from ...level.river_map import has_rivers
from ..below import low_m, lowest_rows, water_rows
from ..frame import Frame
from . import reflections
from .lamps import draw_under
from .sea import water_shown


def in_use(frame: Frame) -> bool:
    """Whether the sea is seen through plates in this picture; scenes of their own keep the one order of D01."""
    if not water_shown(frame) or frame.view.scene:
        return False
    if frame.view.name.startswith("plate_"):
        return True
    return frame.tier.name != "low" and frame.level.settings.water.model == "plate"


def land_first(frame: Frame) -> bool:
    """Whether the land is lit before the sea: for the plates, or to be mirrored."""
    return in_use(frame) or reflections.in_use(frame)


def draw(frame: Frame) -> None:
    if not land_first(frame):
        return
    targets = frame.targets
    frame.uniforms["u_low_m"] = low_m(frame)
    targets.hdr.use()
    targets.hdr.clear()
    frame.shader("light.glsl", LAND_FIRST="").fullscreen()
    if not in_use(frame):
        return
    width, height = targets.plate_size
    rows = water_rows(frame, height)
    plates = targets.plates
    plates.viewport = (0, 0, 2 * width, height)
    plates.clear()
    plates.viewport = (0, 0, width, height)
    with lowest_rows(plates, rows):
        rivers = {"RIVERS": ""} if has_rivers(frame.level) else {}
        frame.shader("plate.glsl", DOWN="", **rivers).fullscreen()
        # what lamps light may be any number of times as bright as the day makes white
        frame.uniforms["u_bed_most"] = 1e5 if draw_under(frame) else 3.0
    with lowest_rows(targets.plate_half, rows):
        frame.shader("plate.glsl", ALONG="").fullscreen()
    plates.viewport = (width, 0, width, height)
    with lowest_rows(plates, rows):
        frame.shader("plate.glsl", ACROSS="").fullscreen()
