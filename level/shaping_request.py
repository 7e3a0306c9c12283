"""What is asked of shaping when another process does it: a level as far as fronts know it, and a line (T07).

`answered` gives the bits that `shape_front` gives. What a drag needs is made once and kept, for the lines that follow.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .errors import BadInput
from .grid import Grid
from .level import Level
from .objects import Prop
from .request import Request
from .settings import Settings
from .shaping import Shaped, Shaping

LINE_BYTES = 1 << 16  # of the line in an answer, with what is left on it
MOVES_WATER = ("flow", "river_mask", "river_surface")  # layers that times of travel follow from
RIM = 16  # cells that a change may reach past the radius


@dataclass(frozen=True)
class ShapeRequest(Request[Shaped | None]):
    """A line at a moment; `quick` as under the hand.

    `height` may be None and `paint` empty when the last request had the same `drag`.
    """

    drag: int
    height: np.ndarray | None  # float32 (rows, cols), the ground at the press
    grid: Grid
    settings: Settings
    objects: tuple
    t: float
    at: tuple[float, float]
    radius_m: float
    wave: int | None
    slope_deg: float
    quick: bool = True
    line: np.ndarray | None = None  # None: nothing but get ready
    paint: tuple[tuple[str, np.ndarray], ...] = ()  # layers and their samples

    def kept(self) -> ShapeRequest:
        """Itself: its arrays are its own already."""
        return self

    @property
    def answer_bytes(self) -> int:
        side = int(2 * self.radius_m / self.grid.cell_m) + 2 * RIM
        return 4 * min(side, self.grid.rows + RIM) * min(side, self.grid.cols + RIM) + LINE_BYTES

    def answered(self) -> Shaped | None:
        """The change, worked out now; None where no line was given."""
        level, made = _of(self)
        if self.quick not in made or not self.quick:  # at rest nothing of earlier lines may count
            made[self.quick] = Shaping(
                level, self.t, self.at, self.radius_m, self.wave, self.slope_deg, quick=self.quick
            )
        return None if self.line is None else made[self.quick].shape(self.line)


_kept: dict[int, tuple[Level, dict[bool, Shaping]]] = {}  # of the drag that was asked about last


def shape_request(level: Level, drag: int, t: float, at, radius_m: float, wave: int, slope_deg: float) -> ShapeRequest:
    """A request about a level as it is, without a line; `drag` is a number that no other drag has."""
    things = tuple(thing for thing in level.objects.values() if not isinstance(thing, Prop))
    height = np.array(level.height, np.float32)
    names = [name for name in MOVES_WATER if level.settings.timing.travels and not level.layers[name].neutral]
    paint = tuple((name, np.array(level.layers[name].read(level.grid.rect))) for name in names)
    return ShapeRequest(drag, height, level.grid, level.settings, things, t, at, radius_m, wave, slope_deg, paint=paint)


def _of(request: ShapeRequest) -> tuple[Level, dict[bool, Shaping]]:
    if request.drag not in _kept:
        if request.height is None:
            raise BadInput("the ground of this drag is not known any more")
        _kept.clear()
        level = Level(request.grid, request.height, request.settings)
        level.objects = {thing.id: thing for thing in request.objects}
        for name, values in request.paint:
            level.write(name, level.grid.rect, values)
        _kept[request.drag] = level, {}
    return _kept[request.drag]
