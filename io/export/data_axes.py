"""AXES: how places and turns of the level are said in each target's world, as matrices; the manifest says it in words.

    frame = Frame("unreal", north_m=768.0, sea_m=0.0)
    frame.place(x, y, z)        # engine units
    frame.rotation(axes)        # quaternion x, y, z, w of a thing whose own axes these are

Directions are turned by the same matrix as places, mirrored ones too: a quaternion then turns the engine's own right,
ahead and up into the thing's, in left-handed coordinates by the same formula as in right-handed ones.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...level import Level
from .records import Manifest

DECIMALS = 6  # of a place in engine units: a micrometre, or a hundredth of one
TURN_DECIMALS = 9  # of directions: a millimetre at a thousand kilometres
OVER_SEA = "z - sea_level_m"


@dataclass(frozen=True)
class Axes:
    """A row: `turn` takes the level's x, y, z to the engine's axes, `formula` says it with the offset, by axis.

    `looks`: along which of the engine's axes right, ahead and up of a thing lie that is not turned.
    """

    units_per_m: float
    turn: tuple[tuple[int, int, int], ...]
    from_north: bool
    over_sea: bool
    looks: tuple[tuple[int, int, int], ...]
    formula: tuple[str, str, str]
    ahead: str


_EAST, _NORTH, _UP = (1, 0, 0), (0, 1, 0), (0, 0, 1)
_SOUTH = (0, -1, 0)
_GODOT = Axes(1.0, (_EAST, _UP, _SOUTH), True, True, ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
              ("x", OVER_SEA, "north_m - y"), "-Z")  # fmt: skip
AXES: dict[str, Axes] = {
    "raw": Axes(1.0, (_EAST, _NORTH, _UP), False, False, (_EAST, _NORTH, _UP), ("x", "y", "z"), "+Y"),
    "unreal": Axes(100.0, (_EAST, _SOUTH, _UP), True, True, ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
                   ("100 x", "100 (north_m - y)", f"100 ({OVER_SEA})"), "+X"),
    "unity": Axes(1.0, (_EAST, _UP, _NORTH), False, True, ((1, 0, 0), (0, 0, 1), (0, 1, 0)), ("x", OVER_SEA, "y"),
                  "+Z"),
    "godot": _GODOT,
    "godot-hterrain": _GODOT,
    "godot-project": _GODOT,
}  # fmt: skip


@dataclass(frozen=True)
class Frame:
    """A target's world for one level: `north_m` is the level's size to the north, `sea_m` its mean sea."""

    target: str
    north_m: float
    sea_m: float

    @classmethod
    def of(cls, level: Level, target: str) -> Frame:
        return cls(target, float(level.grid.extent_m[1]), float(level.mean_sea_m))

    @classmethod
    def told(cls, manifest: Manifest) -> Frame:
        """As an export's manifest tells it."""
        return cls(manifest.target, manifest.world.size_m[1], manifest.world.sea_level_m)

    @property
    def axes(self) -> Axes:
        return AXES[self.target]

    @property
    def _turn(self) -> np.ndarray:
        return np.array(self.axes.turn, float)

    @property
    def _offset(self) -> np.ndarray:
        """World metres that are added before the turn."""
        return np.array([0.0, -self.north_m * self.axes.from_north, -self.sea_m * self.axes.over_sea])

    def place(self, at) -> np.ndarray:
        """Engine units of world places `(…, 3)`."""
        return clean((np.asarray(at, float) + self._offset) @ self._turn.T * self.axes.units_per_m)

    def back(self, engine) -> np.ndarray:
        """World metres of places in engine units `(…, 3)`."""
        return np.asarray(engine, float) / self.axes.units_per_m @ self._turn - self._offset

    def direction(self, way) -> np.ndarray:
        """A direction `(…, 3)` in the engine's axes."""
        return clean(np.asarray(way, float) @ self._turn.T, TURN_DECIMALS)

    def rotation(self, axes: np.ndarray) -> np.ndarray:
        """Quaternion x, y, z, w, w ≥ 0, of a thing with its right, ahead and up as the columns of `axes`."""
        from scipy.spatial.transform import Rotation

        turned = self._turn @ axes @ np.array(self.axes.looks, float)
        return clean(Rotation.from_matrix(turned).as_quat(canonical=True), TURN_DECIMALS)


def clean(values, decimals: int = DECIMALS) -> np.ndarray:
    """Rounded, without a zero that is negative."""
    return np.round(np.asarray(values, float), decimals) + 0.0
