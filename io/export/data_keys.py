"""NAME_keys.json: what happens by the clock (weather, shots, marks, tide, day), as keys and as sampled tracks.

Between two rows of a track everything is linear, and rows stand where something bends: at the ends of every fade and
every point of the tide's curve, with PARTS between. A game needs neither our fades nor our tide's curve.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, Field, create_model

from ...level import Level
from ...level.loop import looped
from ...level.params import get
from ...level.sun import day_runs, moon_shines, sun_place
from ...level.tide import tide_m
from ...level.weather_keys import KEYED, level_at, points_change, run_m, whole_keys
from .data_axes import Frame, clean
from .data_models import DataFile, EngineAxes, Record, Vector, in_sections, some_settings, vector
from .data_objects import NEAR_M, away_m, listed, pairs, rows_of

PARTS = 32  # rows from one bend to the next: linear between them is off by 0.08 % of a fade or less
DAY_PARTS = 96  # rows of a day
WIND = "weather.wind_mps"

WeatherNow = some_settings(
    "WeatherNow",
    (*KEYED, "flow.points", "storm.start_s"),
    "What weather keys make of the settings at a moment; all others stay as they are. `storm.start_s` jumps: take "
    "that of the next row.",
)


class WeatherMoment(Record):
    time_s: float
    settings: WeatherNow
    wind_run_m: float = Field(description="How far the air with its clouds has gone since time 0.")


class TideMoment(Record):
    time_s: float
    tide_m: float = Field(description="Sea over its mean level.")
    sea_level_m: float = Field(description="The same in the level.")


class SunMoment(Record):
    """Where the sun is; the full moon stands opposite."""

    time_s: float
    azimuth_deg: float = Field(description="Clockwise from north; not to be interpolated past 360.")
    elevation_deg: float
    to_sun: Vector = Field(description="Unit vector to the sun, in the engine's axes; interpolate, then make unit.")
    shines: Literal["sun", "moon"]


class _Keys(DataFile):
    engine: EngineAxes


KeysFile = create_model(
    "KeysFile",
    __base__=_Keys,
    __module__=__name__,
    __doc__="What happens by the clock: the keys as they were set, and tracks of what they give, linear between rows.",
    **rows_of(True),
    weather_track=(
        list[WeatherMoment],
        Field(description="From 0 till the last key has come; then it stays. None: no key acts everywhere."),
    ),
    tide_track=(list[TideMoment], Field(description="One period from time 0. None: the sea stands still.")),
    tide_period_s=(float, Field(description="After it the tide's track begins again; 0: there is none.")),
    sun_track=(list[SunMoment], Field(description="One day from time 0. None: the sun stands still.")),
    day_s=(float, Field(description="Length of a day on the clock; 0: it stands still.")),
)


def make(level: Level, frame: Frame) -> dict[str, Any] | None:
    """None where nothing changes by the clock."""
    keys = listed(level, frame, True)
    tracks = {
        "weather_track": weather_track(level),
        "tide_track": tide_track(level),
        "sun_track": sun_track(level, frame),
    }
    if not any([*keys.values(), *tracks.values()]):
        return None
    periods = {"tide_period_s": tide_period_s(level), "day_s": day_s(level)}
    return {"engine": EngineAxes.of(frame).model_dump(), **keys, **tracks, **periods}


def between(bends: list[float], parts: Callable[[float, float], int]) -> list[float]:
    """Moments at some bends and between them; `parts` says how many pieces there are from one to the next."""
    bends = sorted(set(bends))
    inner = [a + (b - a) * n / parts(a, b) for a, b in pairwise(bends) for n in range(parts(a, b))]
    return [*inner, *bends[-1:]]


def weather_track(level: Level) -> list[dict[str, Any]]:
    keys = whole_keys(level)
    if not keys:
        return []
    ends = [0.0, *(end for key in keys for end in (key.time_s, key.time_s + key.fade_s))]

    def parts(low: float, high: float) -> int:
        return PARTS if any(key.time_s < high and key.time_s + key.fade_s > low for key in keys) else 1

    return [weather_at(level, t) for t in between(ends, parts)]


def weather_at(level: Level, t: float) -> dict[str, Any]:
    settings = level_at(level, t).settings
    values = {path: float(clean(get(settings, path))) for path in (*KEYED, "storm.start_s")}
    values["flow.points"] = float(clean(level.settings.flow.points + points_change(level, t)))
    return {"time_s": t, "settings": in_sections(values), "wind_run_m": float(clean(run_m(level, t, WIND)))}


def tide_period_s(level: Level) -> float:
    """0 where it stands: without a tide, and in a loop that is shorter than it."""
    tide, loop_s = level.settings.tide, level.settings.time.loop_s
    if not tide.on or 0 < loop_s < tide.period_s:
        return 0.0
    return looped(tide.period_s, loop_s)


def tide_track(level: Level) -> list[dict[str, float]]:
    """Rows over a period; one where it stands off its mean level."""
    period_s, tide = tide_period_s(level), level.settings.tide
    if not tide.on:
        return []
    points = [(tide.high_s + part * period_s) % period_s for part in tide.curve[::2]] if period_s else []
    times = between([0.0, *points, period_s], lambda low, high: PARTS)
    rows = clean(tide_m(level.settings, np.array(times)))
    mean_m = level.mean_sea_m
    return [
        {"time_s": t, "tide_m": float(rise), "sea_level_m": float(clean(mean_m + rise))}
        for t, rise in zip(times, rows, strict=True)
    ]


def day_s(level: Level) -> float:
    light = level.settings.light
    return 3600 * light.day_h / light.day_rate if day_runs(light) else 0.0


def sun_track(level: Level, frame: Frame) -> list[dict[str, Any]]:
    day = day_s(level)
    return [sun_at(level, frame, t) for t in between([0.0, day], lambda low, high: DAY_PARTS)] if day else []


def sun_at(level: Level, frame: Frame, t: float) -> dict[str, Any]:
    light = level.settings.light
    azimuth, elevation = sun_place(light, t)
    east, up = np.radians(azimuth), np.radians(elevation)
    way = np.array([np.sin(east) * np.cos(up), np.cos(east) * np.cos(up), np.sin(up)])
    return {
        "time_s": t,
        "azimuth_deg": float(clean(azimuth)),
        "elevation_deg": float(clean(elevation)),
        "to_sun": vector(frame.direction(way)),
        "shines": "moon" if moon_shines(light, elevation) else "sun",
    }


# What is lost between rows


def off(level: Level, file: BaseModel) -> float:
    """How far the tide's track, linear between rows, is off the level's own sea at most, cm; inf where a key isn't."""
    frame = Frame(file.engine.target, file.engine.north_m, file.engine.sea_level_m)
    for kind, rows in listed(level, frame, True).items():
        if [row.model_dump() for row in getattr(file, kind)] != [_checked(file, kind, row) for row in rows]:
            return float("inf")
    return 100 * max((abs(row.tide_m - tide_m(level.settings, t)) for t, row in _halfway(file.tide_track)), default=0.0)


def _checked(file: BaseModel, kind: str, row: dict[str, Any]) -> dict[str, Any]:
    model = type(file).model_fields[kind].annotation.__args__[0]
    return model.model_validate(row).model_dump()


def _halfway(rows: list[TideMoment]):
    """Moments between rows, and what linear interpolation has there."""
    for a, b in pairwise(rows):
        yield 0.5 * (a.time_s + b.time_s), a.model_copy(update={"tide_m": 0.5 * (a.tide_m + b.tide_m)})


def numbers(level: Level, file: BaseModel) -> dict[str, float]:
    """What a track loses between rows, for the manifest: the weather in shares of a setting's range over the keys."""
    rows = [_flat(row.settings) for row in file.weather_track]
    if len(rows) < 2:
        return {}
    span = np.ptp(rows, axis=0)
    span[span == 0] = 1.0
    worst = 0.0
    for n, (a, b) in enumerate(pairwise(file.weather_track)):
        truth = WeatherNow.model_validate(weather_at(level, 0.5 * (a.time_s + b.time_s))["settings"])
        worst = max(worst, float(np.max(np.abs(_flat(truth) - 0.5 * (rows[n] + rows[n + 1])) / span)))
    return {"weather_track_error_share": float(clean(worst))}


def _flat(settings: BaseModel) -> np.ndarray:
    """All but when the storm starts, which jumps."""
    sections = settings.model_dump()
    sections["storm"].pop("start_s")
    return np.array([value for section in sections.values() for value in section.values()])


def check(file, others: dict[str, BaseModel], manifest) -> list[str]:
    """Findings: rows in order, the sea's level that of the tide, the tide that of the settings if they are here."""
    frame = Frame.told(manifest)
    if file.engine != EngineAxes.of(frame):
        return ["its axes are not those of the manifest"]
    findings = []
    for name in ("weather_track", "tide_track", "sun_track"):
        times = [row.time_s for row in getattr(file, name)]
        if any(b <= a for a, b in pairwise(times)):
            findings.append(f"the rows of {name} are not in order")
    sea_m = manifest.world.sea_level_m
    if any(abs(row.sea_level_m - row.tide_m - sea_m) > NEAR_M for row in file.tide_track):
        findings.append("its tide and its sea level do not fit each other")
    if any(not away_m(frame, pair) < NEAR_M for kind in rows_of(True) for pair in pairs(getattr(file, kind))):
        findings.append("place and engine of a key are two places")
    settings = others.get("settings")
    if settings is not None:
        rows = [(row.tide_m, tide_m(settings.settings, row.time_s)) for row in file.tide_track]
        if any(abs(here - truth) > NEAR_M for here, truth in rows):
            findings.append("its tide is not that of the settings")
    return findings
