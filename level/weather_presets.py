"""WEATHERS: named weather, one row each; each sets all of what it touches, so that order never matters (D36).

It acts on waves, wind, clouds and what falls from them, and on flow points. Heading of wind and swell, and the shore's
waves, stay as the level has them: a sculpted shore keeps its timing.
"""

from __future__ import annotations

from .presets import Preset, applied, name_of, named
from .settings import Settings

WAVES = ("sea.swell_m", "sea.swell_length_m", "sea.chop_m", "sea.chop_length_m")
SKY = ("weather.coverage", "weather.type", "weather.precipitation")  # what may be another over an area
TOUCHED = (
    *WAVES, "sea.wind_mps", "weather.wind_mps", *SKY, "weather.variety", "weather.horizon_coverage",
    "weather.horizon_type", "weather.temperature_c", "weather.rain_mm_h", "storm.chance", "flow.points",
)  # fmt: skip


def _row(name: str, label: str, doc: str, waves: tuple, wind: tuple, sky: tuple, rest: tuple) -> Preset:
    """`wind` at sea and at the clouds; `rest`: variety, horizon (coverage, type), temperature, rate, storm, flow."""
    return Preset(name, label, doc, dict(zip(TOUCHED, (*waves, *wind, *sky, *rest), strict=True)))


WEATHERS: dict[str, Preset] = {
    row.name: row
    for row in (
        _row("calm", "Calm", "A glassy sea under a few small clouds.",
             (0.12, 30.0, 0.02, 4.0), (1.5, 4.0), (0.28, 0.85, 0.0), (0.8, 0.35, 1.0, 18.0, 6.0, 0.0, 0.6)),
        _row("breeze", "Breeze", "Fair-weather cumulus, a lively sea.",
             (0.45, 46.0, 0.09, 7.5), (5.0, 11.0), (0.45, 0.6, 0.0), (0.7, 0.5, 1.0, 14.0, 6.0, 0.0, 1.0)),
        _row("overcast", "Overcast", "A sheet of stratus from side to side, little wind.",
             (0.35, 52.0, 0.06, 6.0), (4.0, 8.0), (0.95, 0.15, 0.0), (0.1, 0.9, 0.3, 11.0, 3.0, 0.0, 0.8)),
        _row("drizzle", "Drizzle", "Low stratus that drizzles here and there.",
             (0.4, 48.0, 0.08, 6.5), (5.0, 10.0), (0.93, 0.2, 0.55), (0.2, 0.9, 0.3, 9.0, 1.5, 0.0, 1.0)),
        _row("gale", "Gale", "Torn clouds in a hard wind, showers, long waves.",
             (1.3, 85.0, 0.24, 12.0), (16.0, 26.0), (0.65, 0.7, 0.2), (0.6, 0.65, 1.0, 10.0, 10.0, 0.0, 1.5)),
        _row("storm", "Storm", "Thunderheads that come with the wind and pour down; the highest sea.",
             (2.2, 120.0, 0.35, 15.0), (22.0, 34.0), (0.75, 0.85, 0.35), (0.5, 0.75, 1.0, 12.0, 30.0, 1.0, 2.0)),
        _row("snow", "Snow", "Grey winter sky with snowfall, a short cold sea.",
             (0.5, 44.0, 0.1, 7.0), (6.0, 9.0), (0.92, 0.3, 0.6), (0.2, 0.9, 0.4, -3.0, 3.0, 0.0, 1.0)),
    )
}  # fmt: skip


def preset(name: str) -> Preset:
    """A row by its name; BadInput lists them when there is none."""
    return named(WEATHERS, name, "weather")


def weather_settings(settings: Settings, name: str) -> Settings:
    """The settings under a weather."""
    return applied(settings, preset(name))


def weather_of(settings: Settings) -> str:
    """The name of the weather that settings are exactly under, "" for none."""
    return name_of(WEATHERS, settings)
