"""What mouth.glsl asks for: the mouths of a level, and how far the eddies along their jets have gone (D35)."""

from __future__ import annotations

import numpy as np

from .level import Level
from .loop import looped, moment
from .river_flow import river_flow
from .river_jet import smooth
from .weather_keys import base_settings

MOST_MOUTHS = 16  # of a level, the widest: as many as mouth.glsl has room for
TILE_HALVES = 5.0  # half widths: a tile of eddies
EDDIES = 0.5  # of a jet's speed: what rolls between two waters goes with the mean of both
STILL_MPS, RUNS_MPS = 0.02, 0.3  # speed of a mouth from which on it has a plume, and has it whole


def mouth_uniforms(level: Level, t: float) -> dict[str, int | np.ndarray]:
    """Uniforms at a time: places and headings, then half width, reach, strength 0 … 1, tiles that eddies have gone."""
    place, jet = np.zeros((2, MOST_MOUTHS, 4), np.float32)
    flow, settings = river_flow(level), base_settings(level)
    mouths = () if flow is None else sorted(flow.mouths, key=lambda mouth: -mouth.half_m)[:MOST_MOUTHS]
    loop_s = settings.time.loop_s
    for i, mouth in enumerate(mouths):
        speed = mouth.speed_mps * settings.flow.rivers * settings.flow.on
        strength = settings.mouth.plume * float(smooth(STILL_MPS, RUNS_MPS, speed))
        gone = 0.0
        if speed > STILL_MPS:
            period_s = looped(TILE_HALVES * mouth.half_m / (EDDIES * speed), loop_s)
            gone = moment(t, loop_s) % period_s / period_s
        place[i] = mouth.x, mouth.y, mouth.east, mouth.north
        jet[i] = mouth.half_m, mouth.reach_m, strength, gone
    return {"u_mouths": len(mouths), "u_mouth_place": place, "u_mouth_jet": jet}
