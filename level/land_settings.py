"""What the land is made of, how it gets wet, what lies on it, where one can walk: sections of `param` rows."""

from __future__ import annotations

from .params import Section, param


class Ground(Section):
    """What the ground is made of, by slope, height, curvature and distance to the water (L05)."""

    sand_top_m: float = param(3.2, -10, 500, "m", "Height above the sea up to which sand lies.", soft=(0, 20))
    rock_slope_deg: float = param(33.0, 1, 89, "°", "Slope from which rock shows.", soft=(15, 60))
    grass_slope_deg: float = param(27.0, 1, 89, "°", "Slope up to which grass grows.", soft=(10, 45))
    shingle: float = param(0.35, 0, 1, "", "How much of the swash zone is pebbles.")
    weed: float = param(0.5, 0, 1, "", "How much weed grows under water.")
    macro: float = param(1.0, 0, 2, "", "Broad change of colour that keeps tiles from being seen.", soft=(0, 1.5))
    detail: float = param(1.0, 0, 2, "", "Strength of the materials' relief in the light.", soft=(0, 1.5))
    relief: float = param(1.0, 0, 3, "", "Height of the relief that near ground is given as geometry.", soft=(0, 2))


class Wet(Section):
    """The wet shore behind the waves (L06)."""

    dry_s: float = param(45.0, 1, 3600, "s", "Time in which sand that the sheet left dries to a third.", soft=(5, 120))
    film: float = param(1.0, 0, 1, "", "How clearly the film behind the sheet mirrors the sky.")
    film_s: float = param(4.0, 0.1, 60, "s", "Time in which that film sinks into the sand.", soft=(0.5, 10))
    lace: float = param(1.0, 0, 2, "", "Foam that the sheet leaves as lace at the line of its run-up.", soft=(0, 1.5))
    lace_s: float = param(6.0, 0.1, 60, "s", "Time in which that lace tears and is gone.", soft=(1, 20))
    splash_m: float = param(1.2, 0, 30, "m", "Height over the run-up that splash keeps rock dark.", soft=(0, 5))


class Scatter(Section):
    """Rocks, driftwood and grass tufts placed by rule; the scatter layer adds and takes away (L09)."""

    on: bool = param(True, doc="Draw scattered things.")
    rocks: float = param(0.5, 0, 4, "×", "How many rocks.", soft=(0, 2))
    driftwood: float = param(0.5, 0, 4, "×", "How much driftwood lies at the tide line.", soft=(0, 2))
    grass: float = param(0.7, 0, 4, "×", "How many grass tufts.", soft=(0, 2))
    size: float = param(1.0, 0.1, 10, "×", "Size of scattered things.", soft=(0.5, 2))
    sway: float = param(1.0, 0, 5, "×", "How far the wind moves the grass.", soft=(0, 2))
    distance_m: float = param(
        160.0, 5, 400, "m", "How far off dune grass is drawn; large things farther, small ones never beyond 240 m.",
        soft=(30, 300),
    )  # fmt: skip


class Walk(Section):
    """Where the player can go (the talk's navmesh view, D31)."""

    depth_m: float = param(0.7, 0, 10, "m", "Deepest water the player wades through.", soft=(0, 2))
    slope_deg: float = param(40.0, 1, 89, "°", "Steepest ground the player walks on.", soft=(15, 60))
