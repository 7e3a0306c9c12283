"""What lies on, under and in the sea besides its waves: light, current, foam, push, quiet; sections of `param` rows."""

from __future__ import annotations

from .params import Section, param


class Caustics(Section):
    """Bright lines that waves draw on whatever lies under water (D08, H13)."""

    on: bool = param(True, doc="Caustics.")
    strength: float = param(0.7, 0, 4, "×", "How bright the lines are.", soft=(0, 2))
    tile_m: float = param(5.6, 0.5, 100, "m", "Size of one tile of them.", soft=(2, 15))
    bend: float = param(1.0, 0, 4, "×", "How far they sway.", soft=(0, 2))
    depth_m: float = param(3.0, 0.1, 100, "m", "Depth by which they have faded to a third.", soft=(1, 20))


class Flow(Section):
    """Currents that carry foam: what follows from the coast and from flow points, plus what is painted (D05, D06)."""

    on: bool = param(True, doc="Foam and ripples move with the water; off, they stand still while masks travel.")
    shore_mps: float = param(0.25, 0, 5, "m/s", "Current towards the shore, where nothing else is said.", soft=(0, 1))
    points: float = param(1.0, 0, 4, "×", "Strength of flow points.", soft=(0, 2))
    painted: float = param(1.0, 0, 4, "×", "Strength of the painted current.", soft=(0, 2))
    rivers: float = param(1.0, 0, 4, "×", "Speed of rivers against that of their points, and of their jets at sea.",
                          soft=(0, 2))  # fmt: skip
    interval_s: float = param(5.0, 0.3, 60, "s", "Time after which moving foam starts again, unseen.", soft=(1, 10))
    noise: float = param(0.7, 0, 2, "", "How differently in time places start again, in cycles.", soft=(0, 1))
    noise_m: float = param(14.0, 1, 500, "m", "Size of that difference.", soft=(5, 40))
    export_mps: float = param(0.0, 0, 1000, "m/s", "What an exported 8-bit map holds either way; 0: the smallest power "
                              "of two that holds all.", soft=(0, 8))  # fmt: skip
    streamlines: int = param(72, 8, 240, "", "Streamlines beside each other along the level's longer side (T02).",
                             soft=(24, 144))  # fmt: skip


class Foam(Section):
    """Where the sea is white besides its breaking waves (D07, H18), and the shade that foam throws (D21)."""

    shore: float = param(0.35, 0, 1, "", "Constant foam along the shoreline.")
    shore_near_m: float = param(1.0, -50, 150, "m", "Distance to the shore up to which it is whole.", soft=(0, 20))
    shore_far_m: float = param(12.0, -50, 150, "m", "Distance at which it has thinned away.", soft=(2, 60))
    height: float = param(0.5, 0, 1, "", "Foam on the highest water of a sea that isn't flat.")
    height_low: float = param(0.13, -1, 1, "", "Height at which it begins, against the largest possible.", soft=(0, 1))
    height_high: float = param(0.33, -1, 1.5, "", "Height at which it is whole.", soft=(0, 1.2))
    transient: float = param(1.0, 0, 2, "×", "Painted foam that comes and goes with the waves.")
    constant: float = param(1.0, 0, 2, "×", "Painted foam that is always there.")
    albedo: float = param(1.0, 0, 1, "", "How white foam is; 0 leaves its roughness alone (D09).")
    roughness: bool = param(True, doc="Foam scatters light; off, it is as smooth as the water (D09).")
    shadow: float = param(0.6, 0, 1, "", "How dark the shade of foam is on what lies below.")
    shadow_limit_m: float = param(2.5, 0, 20, "m", "How far from the foam it falls at most.", soft=(0, 6))


class Glare(Section):
    """The sun's highlight moved out of the player's way (D20); reflections and refraction keep the true surface."""

    specular: float = param(1.0, 0, 2, "×", "How bright the water's highlight is.", soft=(0, 1))
    yaw_deg: float = param(0.0, -60, 60, "°", "How far the highlight is turned, positive to the right of the picture.")
    pitch_deg: float = param(0.0, -60, 60, "°", "How far it is turned, positive towards the lower edge.")


class Force(Section):
    """The water pushed about by what moves in it: a small simulation round the camera (D18)."""

    on: bool = param(True, doc="Run it.")
    strength: float = param(1.0, 0, 4, "×", "How much it moves surface, flow and foam.", soft=(0, 2))
    limit_m: float = param(0.25, 0.01, 3, "m", "Highest it lifts the surface.", soft=(0.05, 1))
    decay_s: float = param(2.5, 0.1, 60, "s", "Time in which the push fades to a third.", soft=(0.5, 10))
    spread: float = param(0.35, 0, 1, "", "How fast it spreads.")
    foam: float = param(1.0, 0, 4, "×", "Foam it makes.", soft=(0, 2))
    cell_m: float = param(0.5, 0.1, 4, "m", "Size of its cells; it has 128 a side.", soft=(0.25, 2))


class Quiet(Section):
    """The quiet play area: where the layer `quiet` is painted, effects are held down (D39)."""

    foam: float = param(0.8, 0, 1, "", "How much foam is held down there.")
    flow: float = param(0.6, 0, 1, "", "How much the flow is held down there.")
    force: float = param(0.8, 0, 1, "", "How much what wades and bursts is held down there.")
    highlight: float = param(0.8, 0, 1, "", "How much the highlight is held down there and in a quiet middle.")
    centre: float = param(0.0, 0, 1, "", "How strongly the middle of the picture is kept free of highlight.")
    centre_size: float = param(0.33, 0.05, 1, "", "Share of the picture's sides that counts as its middle.")


class Things(Section):
    """Props that stand or float in the level, and the rings drawn on the water (D12, H19)."""

    on: bool = param(True, doc="Draw props.")
    drag: float = param(0.35, 0, 4, "1/s", "How fast a floating thing takes on the speed of the water.", soft=(0, 2))
    rings: float = param(1.0, 0, 4, "×", "Strength of the rings that hits and floating things draw.", soft=(0, 2))
    ring_s: float = param(3.0, 0.2, 30, "s", "Time in which a ring fades to a third.", soft=(0.5, 8))
