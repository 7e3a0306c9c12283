"""Rivers and lakes: what changes their line and the ground and water round them, each a step (part of the session)."""

from __future__ import annotations

import numpy as np

from ..level import BadInput
from ..level.grid import Rect
from ..level.lake import basin, brim_m
from ..level.objects import River
from ..level.river_bed import carved
from ..level.river_edit import deleted, extended, inserted, snapped
from ..level.river_trace import begun
from . import words
from .object_edits import Objects

FREEBOARD_M = 0.1  # a hollow filled without a level stays so far below its brim


class RiverEdits(Objects):
    """`river_point` is the point of the selected river in hand, −1 for none."""

    river_point: int = -1

    def river(self, name: str) -> River:
        """A river by its id; BadInput when it is none."""
        thing = self.object(name)
        if not isinstance(thing, River):
            raise BadInput(f"{name} is no river")
        return thing

    def river_begin(self, name: str, x: float, y: float) -> None:
        """A new river from a place on land, down the way that water would take to the sea or into other water."""
        self.place({"kind": "river", "id": name, "x": round(x, 2), "y": round(y, 2), **begun(self.level, x, y)})

    def river_insert(self, name: str, x: float, y: float) -> int:
        """A point more where a river comes nearest to a world place; returns its number, from 0."""
        points, n = inserted(self.river(name), x, y)
        self.alter(name, {"points": points})
        return n

    def river_extend(self, name: str, x: float, y: float) -> None:
        """Lead a river on from its last point."""
        self.alter(name, {"points": extended(self.level, self.river(name), x, y)})

    def river_delete(self, name: str, n: int) -> None:
        """Take point n (from 0) out of a river."""
        self.alter(name, {"points": deleted(self.river(name), n)})

    def river_snap(self, name: str) -> None:
        """Bring a river's levels down to the ground that it runs over."""
        self.alter(name, {"points": snapped(self.level, self.river(name))})

    def river_carve(self, name: str) -> None:
        """Carve the bed that a river needs, as one step (D13)."""
        river = self.river(name)
        self._end_stroke()
        with self._edit(words.CarveRiver(id=name)), self.journal.step(f"Carve {name}") as step:
            rect, ground = carved(self.level, river)
            self._put(step, "height", rect, ground)

    def fill_water(self, x: float, y: float, level_m: float | None = None, drain: bool = False) -> int:
        """Fill a hollow with water up to a level, or with `drain` take that water out; returns how many cells.

        Without a level almost to the brim; what is drained is what stands there.
        """
        if level_m is None:
            level_m = self._water_here(x, y) if drain else brim_m(self.level, x, y) - FREEBOARD_M
        word = words.checked(words.FillWater, at=(x, y), level_m=level_m, drain=drain)
        self._end_stroke()
        rect, inside = basin(self.level, x, y, level_m)
        with self._edit(word), self.journal.step("Drain" if drain else f"Fill to {level_m:.2f} m") as step:
            mask, surface = (self.level.layers[name].read(rect) for name in ("river_mask", "river_surface"))
            self._put(step, "river_mask", rect, np.where(inside, 0.0 if drain else 1.0, mask))
            if not drain:
                self._put(step, "river_surface", rect, np.where(inside, level_m, surface))
        return int(inside.sum())

    def _water_here(self, x: float, y: float) -> float:
        grid = self.level.grid
        row, col = grid.nearest(x, y)
        here = Rect(row, col, row + 1, col + 1)
        if self.level.layers["river_mask"].read(here)[0, 0] < 0.5:
            raise BadInput("here is no filled water to drain")
        return float(self.level.layers["river_surface"].read(here)[0, 0])

    def _put(self, step, layer: str, rect, values: np.ndarray) -> None:
        data = self.level.layers[layer]
        step.save(data, rect)
        data.array[rect.slices] = values
        self.level.mark(layer, rect)
