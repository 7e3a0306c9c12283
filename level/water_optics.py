"""What water takes from light and gives back, from what lives and drifts in it (L07). Arrays `(3,)`: red, green, blue.

Coefficients in 1/m at 650, 550 and 450 nm. Sources: absorption of pure water, Pope & Fry 1997; of plankton with what
comes with it, Morel 1991 after Prieur & Sathyendranath 1981; of mineral grains, Babin et al. 2003; scattering of pure
sea water, Morel 1974; of plankton, Gordon & Morel 1983 and, backwards, Morel 1988.
"""

from __future__ import annotations

import math

import numpy as np

from .river_settings import RiverLook
from .settings import Water

WAVELENGTH_NM = np.array([650.0, 550.0, 450.0])
PURE_ABSORPTION = np.array([0.340, 0.0565, 0.0092])
PURE_SCATTERING = 0.00288 * (WAVELENGTH_NM / 500.0) ** -4.32
CHLOROPHYLL_SHAPE = np.array([0.356, 0.357, 0.944])  # absorption of plankton against that at 440 nm
# a gram of fine mineral grains in a cubic metre
SILT_ABSORPTION = 0.041 * np.exp(-0.0123 * (WAVELENGTH_NM - 443.0))
SILT_SCATTERING = 0.5 * (550.0 / WAVELENGTH_NM) ** 0.5
SILT_BACKWARDS = 0.02
# `water.scatter` leans to blue as clear sea water does; shares of it that turn back
ADDED_BACKWARDS = np.array([0.16, 0.24, 0.30])


def absorption(water: Water) -> np.ndarray:
    """Absorption, 1/m: pure water, plankton with its yellow matter, silt, and what the artist adds."""
    plankton = 0.06 * CHLOROPHYLL_SHAPE * water.plankton**0.65
    yellow = 1 + (0.2 * np.exp(-0.014 * (WAVELENGTH_NM - 440.0)) if water.plankton > 0 else 0.0)
    added = np.array([water.absorb_red, water.absorb_green, water.absorb_blue])
    return (PURE_ABSORPTION + plankton) * yellow + SILT_ABSORPTION * water.silt + added


def backscatter(water: Water) -> np.ndarray:
    """Scattering that turns light back, 1/m."""
    back = 0.5 * PURE_SCATTERING + SILT_BACKWARDS * SILT_SCATTERING * water.silt + ADDED_BACKWARDS * water.scatter
    if water.plankton > 0:
        share = 0.002 + 0.02 * (0.5 - 0.25 * math.log10(water.plankton)) * 550.0 / WAVELENGTH_NM
        back = back + np.maximum(share, 0.002) * 0.30 * water.plankton**0.62
    return back


def river_added(river: RiverLook) -> tuple[np.ndarray, np.ndarray]:
    """Absorption and scattering that turns light back, 1/m, that a river's water has besides the sea's (D35).

    Dissolved humus takes blue light: exp(−0.014 (λ − 440 nm)) (Bricaud et al. 1981).
    """
    humus = river.humus * np.exp(-0.014 * (WAVELENGTH_NM - 440.0))
    return SILT_ABSORPTION * river.silt + humus, SILT_BACKWARDS * SILT_SCATTERING * river.silt
