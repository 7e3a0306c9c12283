"""NAME_settings.json: every setting of a level, and the presets by name with what they set."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, Field

from ...level import Level
from ...level.environments import ENVIRONMENTS, environment_of
from ...level.environments import TOUCHED as ENVIRONMENT
from ...level.presets import Preset
from ...level.settings import Settings
from ...level.weather_presets import TOUCHED as WEATHER
from ...level.weather_presets import WEATHERS, weather_of
from .data_axes import Frame
from .data_models import DataFile, Record, in_sections, some_settings

EnvironmentValues = some_settings("EnvironmentValues", ENVIRONMENT, "All that an environment sets.")
WeatherValues = some_settings("WeatherValues", WEATHER, "All that a weather sets.")


class _Named(Record):
    name: str
    label: str
    doc: str


class EnvironmentPreset(_Named):
    """Named light and air: put `settings` over those of the level."""

    settings: EnvironmentValues


class WeatherPreset(_Named):
    """A named weather: put `settings` over those of the level."""

    settings: WeatherValues


class SettingsFile(DataFile):
    """All settings of a level by section, in the level's own metres and degrees, and its presets."""

    environment: str = Field(description="The environment that the settings are exactly under; empty: none.")
    weather: str = Field(description="The weather that they are exactly under; empty: none.")
    settings: Settings
    environments: list[EnvironmentPreset]
    weathers: list[WeatherPreset]


def make(level: Level, frame: Frame) -> dict[str, Any]:
    settings = level.settings
    return {
        "environment": environment_of(settings),
        "weather": weather_of(settings),
        "settings": settings.model_dump(),
        "environments": [_row(row) for row in ENVIRONMENTS.values()],
        "weathers": [_row(row) for row in WEATHERS.values()],
    }


def _row(row: Preset) -> dict[str, Any]:
    return {"name": row.name, "label": row.label, "doc": row.doc, "settings": in_sections(row.values)}


def off(level: Level, file: BaseModel) -> float:
    """0 when the file's settings are the level's, else inf."""
    return 0.0 if file.settings == level.settings else float("inf")


def check(file: SettingsFile, others: dict[str, BaseModel], manifest) -> list[str]:
    """Findings: what the manifest says of waves and sea, and that a preset which is named does hold."""
    settings, waves = file.settings, manifest.waves
    findings = []
    told = {"sea": waves.sea, "shore": waves.shore, "seed": waves.seed, "sea level": manifest.world.sea_level_m}
    here = {
        "sea": settings.sea.model_dump(mode="json"), "shore": settings.shore.model_dump(mode="json"),
        "seed": settings.level.seed, "sea level": settings.level.sea_level_m,
    }  # fmt: skip
    findings += [f"says another {name} than the manifest" for name, value in here.items() if value != told[name]]
    for kind, name, rows in (
        ("environment", file.environment, file.environments), ("weather", file.weather, file.weathers)
    ):  # fmt: skip
        row = next((row for row in rows if row.name == name), None)
        if name and (row is None or not _holds(row.settings, settings)):
            findings.append(f"its settings are not those of the {kind} {name!r}")
    return findings


def _holds(values: BaseModel, settings: Settings) -> bool:
    every = settings.model_dump()
    return all(every[s][key] == value for s, section in values.model_dump().items() for key, value in section.items())
