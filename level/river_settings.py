"""Rivers and other water that isn't the sea (D13 to D17): a section of `param` rows."""

from __future__ import annotations

from .params import Section, param


class RiverLook(Section):
    """How water runs inland."""

    on: bool = param(True, doc="Rivers, lakes and ponds.")
    wave_m: float = param(0.06, 0, 1, "m", "Height of the waves that run down it where it is rough.", soft=(0, 0.3))
    wave_length_m: float = param(4.0, 0.3, 60, "m", "Their length.", soft=(1, 15))
    wave_speed: float = param(1.0, 0, 4, "×", "Their speed against deep-water dispersion.", soft=(0.25, 2))
