"""The timing of a level as files (T06), described in docs/timing.md: maps as EXR, lines as GeoJSON, lists as JSON."""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import asdict
from pathlib import Path

import numpy as np

from ..level import Level
from ..level.crests import Line
from ..level.hot_spots import HotSpot
from .images import encode

MILLIMETRES = 3  # decimals of every number in a text


def write_map(path: Path, values: np.ndarray) -> None:
    """A float32 map `(rows, cols)`, row 0 south, as EXR with channel Y, north row first."""
    encode(path, np.ascontiguousarray(values[::-1], np.float32), data=True)


def write_lines(path: Path, level: Level, lines: Iterable[Line], name: str, facts: dict) -> None:
    """Lines as GeoJSON in level metres (x east, y north); `name` is the property that a line's value becomes."""
    features = [
        {
            "type": "Feature",
            "properties": {name: _number(line.value), **facts},
            "geometry": {"type": "LineString", "coordinates": np.round(line.points, MILLIMETRES).tolist()},
        }
        for line in lines
        if len(line.points) > 1
    ]
    about = {"units": "level metres, x east, y north of the level's south-west corner"}
    if level.georeference:
        about["georeference"] = level.georeference
    write_json(path, {"type": "FeatureCollection", "properties": about, "features": features})


def write_hot_spots(path: Path, spots: list[HotSpot], facts: dict) -> None:
    rows = [{key: _number(v) if isinstance(v, float) else v for key, v in asdict(spot).items()} for spot in spots]
    write_json(path, {**facts, "hot_spots": rows})


def write_json(path: Path, data: dict) -> None:
    path.write_text(json.dumps(data, indent=1, ensure_ascii=False, allow_nan=False) + "\n", encoding="utf-8")


def _number(value: float) -> float:
    return round(float(value), MILLIMETRES) + 0.0
