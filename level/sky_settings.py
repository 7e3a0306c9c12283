"""Clouds, weather and what falls from them; sections of `param` rows (Horizon Zero Dawn talk, Z01 to Z25)."""

from __future__ import annotations

from itertools import pairwise

from pydantic import field_validator

from .params import Section, param

Curve = tuple[float, ...]  # height in the shell and density by turns, 0 … 1 each


def curve_points(curve: Curve) -> tuple[tuple[float, float], ...]:
    """The points (height, density) of a curve."""
    return tuple(zip(curve[::2], curve[1::2], strict=True))


class Clouds(Section):
    """How clouds are shaped and lit: noises, height curves, march and light (Z01 to Z17)."""

    on: bool = param(False, doc="Draw clouds in volume; they take the place of the layer of light.cloud_cover.")
    base_m: float = param(1500.0, 100, 8000, "m", "Height of the shell's inner side.", soft=(500, 3000))
    top_m: float = param(4000.0, 200, 16_000, "m", "Height of its outer side.", soft=(2000, 8000))
    planet_km: float = param(
        6371.0, 50, 100_000, "km", "Radius of the planet: a smaller one brings the horizon nearer.", soft=(500, 6371)
    )
    extinction: float = param(0.08, 0.001, 1, "1/m", "Extinction of the densest cloud.", soft=(0.04, 0.12))
    scale_m: float = param(7200.0, 500, 60_000, "m", "Size of a tile of the noise that shapes clouds.",
                           soft=(3000, 16_000))  # fmt: skip
    detail_m: float = param(1500.0, 50, 10_000, "m", "Size of a tile of the noise that erodes their edges.",
                            soft=(400, 3000))  # fmt: skip
    erosion: float = param(0.45, 0, 1, "", "How deep the edges are eroded.")
    curl: float = param(0.35, 0, 2, "", "How far turbulence bends that noise, in tiles.", soft=(0, 1))
    curl_m: float = param(3800.0, 100, 40_000, "m", "Size of a tile of that turbulence.", soft=(1000, 10_000))
    thin: float = param(0.6, 0, 1, "", "How much thinner clouds are at their base.")
    anvil: float = param(0.5, 0, 1, "", "How far thunderheads spread at their top.")
    shear_m: float = param(500.0, 0, 5000, "m", "How far tops are ahead of the base in the wind.", soft=(0, 1500))
    turn_deg: float = param(15.0, -90, 90, "°", "How far the wind has turned, clockwise, at the shell's outer side.")
    rise_mps: float = param(1.2, -20, 20, "m/s", "How fast small shapes rise within a cloud.", soft=(0, 5))
    stratus: Curve = param(
        (0.0, 0.0, 0.04, 1.0, 0.14, 1.0, 0.26, 0.0), doc="Density of stratus by height in the shell."
    )
    cumulus: Curve = param(
        (0.0, 0.0, 0.06, 0.85, 0.18, 1.0, 0.36, 0.72, 0.62, 0.0), doc="Density of cumulus by height in the shell."
    )
    cumulonimbus: Curve = param(
        (0.0, 0.0, 0.05, 1.0, 0.3, 0.92, 0.6, 0.75, 0.85, 0.62, 1.0, 0.0),
        doc="Density of cumulonimbus by height in the shell.",
    )
    forward: float = param(0.8, 0, 0.99, "", "Asymmetry of the bright forward lobe: the silver lining.")
    backward: float = param(0.2, 0, 0.9, "", "Asymmetry of the broad lobe.")
    silver: float = param(0.35, 0, 1, "", "Share of light in the forward lobe.")
    spread: float = param(0.5, 0, 1, "", "Light scattered many times: how white thick clouds are in the sun.")
    powder: float = param(0.7, 0, 1, "", "How dark edges are seen from the sun's side.")
    rain_absorption: float = param(0.35, 0, 1, "", "Share of light that rain clouds swallow.")
    ambient: float = param(1.0, 0, 4, "×", "Light from the sky and the ground.", soft=(0, 2))
    shadows: float = param(0.85, 0, 1, "", "How dark the shadows of clouds are on land and sea.")
    cirrus: float = param(0.25, 0, 1, "", "Cover of the high veils of ice.")
    alto: float = param(0.12, 0, 1, "", "Cover of the small high heaps.")
    high_m: float = param(7500.0, 1000, 20_000, "m", "Height of those layers.", soft=(4000, 12_000))
    high_mps: float = param(22.0, -100, 100, "m/s", "Wind up there.", soft=(0, 60))

    @field_validator("stratus", "cumulus", "cumulonimbus")
    @classmethod
    def _is_curve(cls, curve: Curve) -> Curve:
        """Two to sixteen points, heights rising, all from 0 to 1."""
        if len(curve) % 2 or not 4 <= len(curve) <= 32:
            raise ValueError("a height curve is 2 to 16 pairs of height and density")
        heights = curve[::2]
        if not all(0 <= value <= 1 for value in curve) or any(b <= a for a, b in pairwise(heights)):
            raise ValueError("a height curve takes numbers from 0 to 1, its heights rising")
        return curve


class CloudTerms(Section):
    """Each term of a cloud's shape and light, to be switched off and looked at (Z21)."""

    height: bool = param(True, doc="Density follows the height curve of the type.")
    coverage: bool = param(True, doc="Coverage decides where clouds are.")
    thin: bool = param(True, doc="Bases are thinner.")
    erode: bool = param(True, doc="Edges are eroded by the detail noise.")
    inverted: bool = param(True, doc="That noise is inverted at the base: wisps.")
    curl: bool = param(True, doc="It is bent by turbulence.")
    cone: bool = param(True, doc="Five samples towards the sun.")
    far: bool = param(True, doc="A sixth one far away.")
    beer: bool = param(True, doc="Beer's law.")
    phase: bool = param(True, doc="Light is scattered forward (Henyey-Greenstein).")
    powder: bool = param(True, doc="Dark edges away from the sun.")
    rain: bool = param(True, doc="Rain clouds swallow light.")
    ambient: bool = param(True, doc="Light of sky and ground.")
    cheap_steps: bool = param(True, doc="Long cheap steps until a cloud is met (Z14).")
    cheap_light: bool = param(True, doc="Light without detail noise from opacity 0.3 on (Z15).")
    evolve: bool = param(True, doc="Outlines evolve with time (Z22).")


class Weather(Section):
    """The weather map and what makes it: simulation, paint, horizon, wind (Z04 to Z07)."""

    coverage: float = param(0.45, 0, 1, "", "How much cloud the simulation tends to.")
    precipitation: float = param(0.0, 0, 1, "", "Share of the sky that rains.")
    type: float = param(0.6, 0, 1, "", "Which type it tends to: 0 stratus, 1 cumulus.")
    variety: float = param(0.7, 0, 1, "", "How different places are.")
    growth_s: float = param(
        1500.0, 20, 1e6, "s", "Time in which clouds grow and decay; the smaller, the quicker.", soft=(200, 6000)
    )
    evolve: bool = param(True, doc="The simulation runs with the clock; off, it stands and only drifts.")
    wind_mps: float = param(11.0, 0, 100, "m/s", "Wind that moves the clouds.", soft=(0, 40))
    heading_deg: float = param(55.0, 0, 360, "°", "Where it blows to.")
    painted: bool = param(True, doc="The painted sky counts.")
    paint_drifts: bool = param(True, doc="The painted sky moves with the wind; off, it stays where it was painted.")
    east_m: float = param(0.0, -1e6, 1e6, "m", "East of the level's corner, the middle of the map.", soft=(-35e3, 35e3))
    north_m: float = param(0.0, -1e6, 1e6, "m", "North of it.", soft=(-35e3, 35e3))
    horizon_start_m: float = param(
        15_000.0, 100, 34_000, "m", "Distance from the camera at which the horizon's own sky begins."
    )
    horizon_end_m: float = param(35_000.0, 200, 35_000, "m", "Distance from which on there is nothing else.")
    horizon_coverage: float = param(0.5, 0, 1, "", "Coverage of the horizon's sky.")
    horizon_type: float = param(1.0, 0, 1, "", "Its type: 0 stratus, 1 cumulus.")
    temperature_c: float = param(14.0, -40, 45, "°C", "Temperature at sea level; 6.5 °C less each kilometre up.")
    snow_below_c: float = param(1.0, -20, 10, "°C", "Under this it snows instead of raining.")
    rain_mm_h: float = param(14.0, 0, 200, "mm/h", "How much falls where precipitation is 1.", soft=(0, 60))


class Rain(Section):
    """How rain and snow are drawn, and what they do to water (Z18, Z24, D17)."""

    shafts: float = param(1.0, 0, 4, "×", "How thick the curtains under rainy clouds are.", soft=(0, 2))
    streaks: float = param(1.0, 0, 4, "×", "How many drops and flakes are seen near the camera.", soft=(0, 2))
    fall_mps: float = param(8.0, 1, 20, "m/s", "How fast drops fall.", soft=(6, 10))
    flake_mps: float = param(1.2, 0.1, 5, "m/s", "How fast flakes fall.", soft=(0.8, 2))
    shutter_s: float = param(0.03, 0.002, 0.2, "s", "How long a drop leaves its trace.", soft=(0.01, 0.06))
    drop_m: float = param(0.0025, 0.0005, 0.02, "m", "How thick a drop's trace is.", soft=(0.001, 0.005))
    flake_m: float = param(0.014, 0.002, 0.1, "m", "How big flakes are.", soft=(0.005, 0.03))
    ripples: float = param(1.0, 0, 4, "×", "Rings of drops on the water: how steep (D17).", soft=(0, 2))
    ring_m: float = param(0.44, 0.05, 5, "m", "How wide the widest of them get.", soft=(0.2, 1))


class Storm(Section):
    """A storm on demand: it forms upwind and comes with the wind (Z23)."""

    chance: float = param(0.0, 0, 1, "", "Chance of precipitation behind its front.")
    start_s: float = param(0.0, 0, 1e7, "s", "When it sets out.", soft=(0, 600))
    distance_m: float = param(20_000.0, 0, 34_000, "m", "How far upwind of the map's middle it forms.")
    depth_m: float = param(16_000.0, 500, 60_000, "m", "How long it is along the wind.", soft=(2000, 35_000))
    ragged_m: float = param(2500.0, 0, 20_000, "m", "How uneven its front is.", soft=(0, 8000))
