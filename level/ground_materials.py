"""The eight ground materials (L05): what each is like, whatever its textures."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Material:
    """`amplitude_m` is the height that 0 … 1 spans, `relief_m` what of it becomes geometry near the camera.

    `steepest` is the slope, in heights a tile, that the texture's ±1 stands for.
    """

    name: str
    tile_m: float
    amplitude_m: float
    relief_m: float
    steepest: float
    roughness: float
    colour: tuple[float, float, float]  # of the named view, not of the ground


MATERIALS = (
    Material("sand", 3.6, 0.036, 0.020, 60.0, 0.90, (0.85, 0.72, 0.45)),
    Material("shingle", 2.3, 0.060, 0.060, 90.0, 0.75, (0.55, 0.55, 0.60)),
    Material("strata", 6.1, 0.180, 0.120, 100.0, 0.82, (0.60, 0.30, 0.20)),
    Material("reef", 5.7, 0.160, 0.120, 90.0, 0.80, (0.30, 0.22, 0.30)),
    Material("grass", 3.1, 0.045, 0.050, 90.0, 0.93, (0.20, 0.60, 0.15)),
    Material("dune grass", 4.3, 0.060, 0.050, 90.0, 0.92, (0.65, 0.75, 0.25)),
    Material("sea floor", 5.3, 0.075, 0.020, 40.0, 0.90, (0.30, 0.65, 0.75)),
    Material("weed", 3.3, 0.090, 0.050, 120.0, 0.85, (0.10, 0.35, 0.30)),
)
