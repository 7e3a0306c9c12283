"""How far a kit's own code is from the twin: its functions run in float32 at the probes, with its files' numbers."""

from __future__ import annotations

from itertools import groupby

import numpy as np

from ....level.beat import beat
from .data import uniforms_at
from .files import Source
from .run import Run

DIGITS_M = 1e5  # told to a hundredth of a millimetre, rounded up: machines differ in the last digits


def measured(source: Source, probes: list[dict]) -> tuple[float, str]:
    """The largest difference at the probes and its unit; of the sea metres along an axis, of the sky a map's share.

    NaN where a function gives one.
    """
    worst = 0.0
    for t, group in groupby(probes, lambda probe: probe["time_s"]):
        beat()
        here = list(group)
        run = Run(source.unit, uniforms_at(source.data, t), source.data.maps, len(here))
        worst = np.maximum(worst, np.abs(off_by(run, here)).max())  # max() would drop a NaN
    return float(np.ceil(worst * DIGITS_M) / DIGITS_M), "m" if "position" in probes[0] else "of 1"


def off_by(run: Run, probes: list[dict]) -> np.ndarray:
    """What a part's function says at probes of one time, less what the twin does."""
    if "position" in probes[0]:
        sea = run.call("sea_surface", np.array([p["before"] for p in probes], np.float32))
        return sea["position"].astype(np.float64) - [p["position"] for p in probes]
    sky = run.call("weather_at", np.array([p["at"] for p in probes], np.float32))
    return sky.astype(np.float64) - [p["weather"] for p in probes]
