"""ENVIRONMENTS: named light and air for a picture (L02), one row each; each sets all of what it touches, so that order
never matters. They set nothing that shapes waves: a sculpted shore keeps its timing.
"""

from __future__ import annotations

from .presets import Preset, applied, name_of, named
from .settings import Settings

TOUCHED = (
    "light.sun_from", "light.sun_azimuth_deg", "light.sun_elevation_deg", "light.body", "light.turbidity",
    "light.cloud_cover", "light.cloud_depth", "light.exposure_ev", "light.white_k",
    "fog.on", "fog.density", "fog.height_m", "sea.wind_mps",
    "weather.coverage", "weather.precipitation", "weather.type",
)  # fmt: skip


def _row(
    name: str, label: str, doc: str, sun: tuple[float, float], ev: float, turbidity: float = 2.6, body: str = "sun",
    clouds: tuple[float, float] = (0.0, 12.0), fog: tuple[float, float] = (0.00002, 350.0), white_k: float = 5600,
    wind_mps: float = 5.0, weather: tuple[float, float, float] = (0.38, 0.0, 0.9),
) -> Preset:  # fmt: skip
    """`clouds` is the layer without clouds in volume, `weather` what those are made of where they are on."""
    values = ("angles", *sun, body, turbidity, *clouds, ev, white_k, True, *fog, wind_mps, *weather)
    return Preset(name, label, doc, dict(zip(TOUCHED, values, strict=True)))


ENVIRONMENTS: dict[str, Preset] = {
    row.name: row
    for row in (
        _row("noon", "Noon", "High sun, clear air, a breeze.", (205.0, 56.0), 14.5),
        _row("golden_hour", "Golden hour", "The sun a hand above the sea, long shadows.", (252.0, 7.5), 12.0,
             turbidity=3.2, wind_mps=3.0),
        _row("overcast", "Overcast", "A closed sheet of cloud: soft light, no shadows.", (205.0, 48.0), 12.4,
             clouds=(1.0, 22.0), fog=(0.00005, 500.0), white_k=6000, wind_mps=7.0, weather=(0.97, 0.0, 0.2)),
        _row("storm", "Storm", "A dark sheet of cloud, haze, a hard wind.", (240.0, 24.0), 11.2, turbidity=3.5,
             clouds=(1.0, 70.0), fog=(0.00022, 700.0), white_k=5400, wind_mps=16.0,
             weather=(0.93, 0.6, 0.7)),
        _row("moonlit", "Moonlit", "The full moon over the bay.", (215.0, 32.0), -2.4, turbidity=2.2, body="moon",
             white_k=4200, wind_mps=3.0, weather=(0.3, 0.0, 0.8)),
        _row("fog", "Fog", "Morning fog on the water, the sun behind it.", (150.0, 20.0), 12.6, turbidity=3.5,
             fog=(0.0046, 62.0), wind_mps=2.0, weather=(0.25, 0.0, 0.3)),
    )
}  # fmt: skip


def environment_settings(settings: Settings, name: str) -> Settings:
    """The settings under an environment; BadInput lists them when there is none of that name."""
    return applied(settings, named(ENVIRONMENTS, name, "environment"))


def environment_of(settings: Settings) -> str:
    """The name of the environment that settings are exactly under, "" for none."""
    return name_of(ENVIRONMENTS, settings)
