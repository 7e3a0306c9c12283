"""Rivers and other water that isn't the sea (D13 to D17, D19): a section of `param` rows."""

from __future__ import annotations

from .params import Section, param


class RiverLook(Section):
    """How water runs inland."""

    on: bool = param(True, doc="Rivers, lakes and ponds.")
    painted_mps: float = param(
        0.7, 0, 20, "m/s", "Mean speed of painted water whose level falls, without a river's line; 0: it stands.",
        soft=(0, 3),
    )  # fmt: skip
    wave_m: float = param(0.06, 0, 1, "m", "Height of the waves that run down it where it is rough.", soft=(0, 0.3))
    wave_length_m: float = param(4.0, 0.3, 60, "m", "Their length.", soft=(1, 15))
    wave_speed: float = param(1.0, 0, 4, "×", "Their speed against deep-water dispersion.", soft=(0.25, 2))
    silt: float = param(0.5, 0, 1000, "g/m³", "Fine mineral grains that it carries besides the sea's.", soft=(0, 30))
    humus: float = param(
        0.04, 0, 20, "1/m", "Absorption of blue light by what it washes out of the soil: yellow, then brown.",
        soft=(0, 4),
    )  # fmt: skip
    interval_s: float = param(
        1.6, 0.2, 30, "s", "Time after which its moving foam and ripples start again, unseen.", soft=(0.6, 5)
    )
    curl: float = param(
        0.35, 0, 20, "×", "Eddies blended into the flow, against its speed; many times it: extreme.", soft=(0, 4)
    )
    curl_m: float = param(2.5, 0.2, 100, "m", "Size of those eddies.", soft=(1, 12))
    ripple: float = param(0.16, 0, 2, "", "Slope of the ripples that run down it where it is fast.", soft=(0, 0.5))
    ripple_still: float = param(0.012, 0, 1, "", "Slope of those on water that stands.", soft=(0, 0.1))
    ripple_m: float = param(3.2, 0.2, 60, "m", "Size of one tile of them.", soft=(1, 10))
    speed_foam: float = param(0.62, 0, 1, "", "Foam where the water is fast.")
    speed_low_mps: float = param(1.5, 0, 20, "m/s", "Speed at which it begins.", soft=(0, 4))
    speed_high_mps: float = param(5.5, 0, 20, "m/s", "Speed at which it is whole.", soft=(0.5, 10))
    fall_foam: float = param(1.0, 0, 1, "", "Foam where the surface leans: on falls.")
    fall_clear_m: float = param(1.1, 0, 30, "m", "How far a fall comes down clear before it breaks up.", soft=(0, 4))
    strand_m: float = param(3.4, 0.2, 60, "m", "Width of one tile of a fall's strands.", soft=(1, 10))
    wake_foam: float = param(1.0, 0, 1, "", "Foam where the flow loses speed: behind boulders, under narrows.")
    fall_low_deg: float = param(7.0, 0, 89, "°", "Lean of the surface at which it begins.", soft=(0, 45))
    fall_high_deg: float = param(24.0, 0.1, 90, "°", "Lean at which it is whole.", soft=(1, 60))
    turbulent: float = param(1.0, 0, 2, "×", "Painted turbulent foam.")
    turbulent_tile_m: float = param(4.5, 0.3, 100, "m", "Size of a tile of turbulent foam.", soft=(1, 15))
    turbulent_albedo: float = param(1.0, 0, 1.2, "×", "How bright it is against the sea's foam.")
    streak_m: float = param(2.6, 0, 20, "m", "How long it is drawn out down the flow at 1 m/s.", soft=(0, 6))
    stagnant: float = param(1.0, 0, 2, "×", "Painted stagnant foam.")
    stagnant_still: float = param(0.18, 0, 1, "", "Stagnant foam that gathers by itself where water is slow.")
    stagnant_mps: float = param(0.25, 0.01, 5, "m/s", "Speed by which it has been carried off.", soft=(0.05, 1))
    stagnant_tile_m: float = param(7.0, 0.3, 100, "m", "Size of a tile of stagnant foam.", soft=(1, 20))
    stagnant_albedo: float = param(0.2, 0, 1, "", "How bright it is.")
    stagnant_algae: float = param(0.5, 0, 1, "", "Its colour: 0 scum, 1 green algae.")
    stagnant_shadow: float = param(0.6, 0, 1, "", "How dark its shade is on the bed.")
    cut_mps: float = param(
        0.25, 0.01, 10, "m/s", "Push of what wades and bursts from which it is cut; four times it: all.", soft=(0.05, 2)
    )
    wet_m: float = param(0.16, 0, 5, "m", "How far over its level the banks are wet.", soft=(0, 0.6))
