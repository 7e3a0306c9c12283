"""Coasts with one odd sample, and how what a client read of them is compared: corners, the odd one, then all."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from shorewright.io import import_height, read_level
from shorewright.level import Grid, Level
from shorewright.level.flow import current
from shorewright.level.grid import Rect

SAMPLES = Path(__file__).parents[2] / "sample_levels"
COSTS_MORE = 100  # a picture turned round is off by this many tolerances at least
# The odd sample's row (from the south) and column: on rock, and on every eighth line, so that thinned meshes keep it.
ODD = {"cove": (312, 840), "pyramid_rock": (328, 376)}


@dataclass(frozen=True)
class Coast:
    """A level whose sample `odd` (row, column) is 5 m higher than anything else in it."""

    name: str
    level: Level
    odd: tuple[int, int]

    @property
    def odd_place(self) -> np.ndarray:
        """Its x, y and height in metres."""
        row, col = self.odd
        return np.array([*self.level.grid.to_metres(row, col), self.level.height[row, col]], float)


def odd_coast(request) -> Coast:
    """The level that a fixture's parameter names: a sample level, or Pyramid Rock, which skips without its file."""
    name = request.param
    if name == "pyramid_rock":
        file = request.getfixturevalue("data_dir") / "coasts/pyramidrock_hi.celeris.txt"
        height = import_height(file, cell_m="2x1", rows="south-first").height
        level = Level(Grid(*height.shape, 1.0), height)
    else:
        level = read_level(SAMPLES / f"{name}.shore")
    row, col = ODD[name]
    level.write("height", Rect(row, col, row + 1, col + 1), level.height.max() + 5)
    return Coast(name, level, (row, col))


# Pictures


def decoded(record: dict, words: np.ndarray) -> np.ndarray:
    """Samples `(rows, cols, channels)` by the formula that stands in the manifest, with its numbers, north row first.

    A formula reads `name = expression, more words`; a map's low and high stand with its channels.
    """
    expression = re.match(r"[^=]+= ([^,;]+)", record["decode"]["formula"]).group(1)
    names = {"v": words.astype(np.float64), "value": words} | record["decode"]["numbers"]
    ends = [[channel[end] for channel in record["channels"]] for end in ("low", "high")]
    names |= {end: np.array(values, float) for end, values in zip(("low", "high"), ends, strict=True)}
    found = np.asarray(eval(expression, {"__builtins__": {}}, names))
    return found if record["row_0"] == "north" else found[::-1]


def truth(coast: Coast, target: str, record: dict) -> np.ndarray:
    """What a picture should hold, made from the level in the units and directions that its channels are told in."""
    level, channels = coast.level, record["channels"]
    if record["map"] == "height":
        height = level.height[::-1, :, None].astype(float)
        height -= 0 if target == "raw" else level.sea_level_m
        return height * (100 if channels[0]["unit"] == "cm" else 1)
    if record["map"] == "flow16":
        values = current(level).packed[..., :2].astype(float)
    else:
        north, east = np.gradient(level.height.astype(float), level.grid.cell_m)
        values = np.stack([-east, -north, np.ones_like(east)], -1) / np.sqrt(1 + east**2 + north**2)[..., None]
    south = "south" in channels[1]["meaning"]
    return values[::-1] * np.array([1, -1 if south else 1, 1])[: values.shape[-1]]


def same_picture(read: np.ndarray, wanted: np.ndarray, tolerance: float, odd: tuple[int, int] | None = None) -> None:
    """Corners first, then the odd sample, then all; `wanted` is such that no turned or mirrored copy would pass."""
    assert read.shape == wanted.shape
    for corner in ((0, 0), (0, -1), (-1, 0), (-1, -1)):
        np.testing.assert_allclose(read[corner], wanted[corner], atol=tolerance, rtol=0, err_msg=f"corner {corner}")
    if odd is not None:
        row, col = len(wanted) - 1 - odd[0], odd[1]
        assert np.unravel_index(read[..., 0].argmax(), read.shape[:2]) == (row, col)
        np.testing.assert_allclose(read[row, col], wanted[row, col], atol=tolerance, rtol=0)
    assert np.abs(read - wanted).max() <= tolerance
    for turned in (wanted[::-1], wanted[:, ::-1], wanted[::-1, ::-1]):
        assert np.abs(turned - wanted).max() > COSTS_MORE * tolerance
