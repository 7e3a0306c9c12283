"""A level: its grid, layers, objects and settings, and what changed since when.

CPU arrays are the truth. Every change bumps `revision`; readers such as the renderer ask `changed_since` for the
rectangles newer than what they hold, so nobody is told and nobody is forgotten.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from .errors import BadInput
from .grid import Grid, Rect
from .layers import LAYERS, WEATHER_GRID, HeightData, LayerData
from .objects import Camera
from .params import replace
from .settings import Settings

if TYPE_CHECKING:
    from .arrival import Solver
    from .meshes import Mesh

BAND = 32  # rows of a level that are looked at together when the changed part of it is put into rectangles
LOGGED = 256  # changes of a layer that are remembered one by one


class Level:
    """A coast: `base` is float32 `(rows, cols)` metres, row 0 south."""

    def __init__(
        self, grid: Grid, base: np.ndarray, settings: Settings | None = None, georeference: dict | None = None
    ):
        self.settings = settings or Settings()
        self.undated: Settings | None = None  # its own ones, in a copy that stands for a moment (weather_keys.py)
        self.tide_m = 0.0  # of the sea over its mean level, in such a copy (tide.py)
        self.objects: dict[str, object] = {}
        self.meshes: dict[
            str, Mesh
        ] = {}  # by name (meshes.py); kept while the level is open, saved where a prop names it
        self.skies: dict[str, np.ndarray] = {}  # of shots, likewise (shots.py)
        self.georeference = georeference or {}
        self.solver: Solver | None = None  # lent by an editor, so that no window waits for an arrival map (arrival.py)
        self.revision = 0
        self.settings_revision = 0
        self.objects_revision = 0
        self.live = False  # True while a step is open: derived maps may then answer from the changed window alone
        self.reset(grid, base)

    def reset(self, grid: Grid, base: np.ndarray) -> None:
        """Take another grid and base; all layers become neutral (import, resize and crop refill them)."""
        if base.shape != grid.shape:
            raise BadInput(f"a height map of {base.shape} does not fit a grid of {grid.shape}")
        self.grid = grid
        self.layers: dict[str, LayerData] = {}
        for name, row in LAYERS.items():
            own = WEATHER_GRID if row.grid == "weather" else grid
            self.layers[name] = HeightData(row, own, base) if name == "height" else LayerData(row, own)
        self._log: dict[str, list[tuple[int, Rect]]] = {name: [] for name in LAYERS}
        self.sector_revisions = {n: np.zeros(data.grid.sector_shape, np.int64) for n, data in self.layers.items()}
        # caches of what follows from the level, keyed by their owners; another one, for copies may read the old
        self.derived: dict = {}
        for name in LAYERS:
            self.mark(name, self.layers[name].grid.rect)

    # What is read all the time

    @property
    def height(self) -> np.ndarray:
        """The ground, float32 `(rows, cols)` metres; read it, write through a stroke or `write`."""
        return self.layers["height"].read(self.grid.rect)

    @property
    def sea_level_m(self) -> float:
        """Height of the still sea at the moment that the level stands for; its mean where it stands for none."""
        return self.settings.level.sea_level_m + self.tide_m

    @property
    def mean_sea_m(self) -> float:
        """Height of the sea without the tide: what maps are made for."""
        return self.settings.level.sea_level_m

    def camera(self, name: str) -> Camera:
        camera = self.objects.get(name)
        if not isinstance(camera, Camera):
            known = ", ".join(sorted(o.id for o in self.objects.values() if isinstance(o, Camera))) or "none"
            raise BadInput(f"this level has no camera {name!r}; it has: {known}")
        return camera

    # Changes

    def mark(self, layer: str, rect: Rect) -> None:
        """Note that the samples of a layer in `rect` changed."""
        rect = self.layers[layer].grid.clip(rect)
        if rect.empty:
            return
        self.revision += 1
        self.sector_revisions[layer][self.layers[layer].grid.sectors_at(rect)] = self.revision
        log = self._log[layer]
        log.append((self.revision, rect))
        if len(log) == LOGGED:
            self._shorten(log, self.layers[layer].grid.rect)

    @staticmethod
    def _shorten(log: list[tuple[int, Rect]], whole: Rect) -> None:
        """Put the older half of a log into few rectangles: who asks about it gets a little more than it has to."""
        old = log[: len(log) // 2]
        at = max((i for i, (_, rect) in enumerate(old) if rect == whole), default=-1)  # nothing before counts any more
        rects = cover(rect for _, rect in old[at + 1 :])
        log[: len(old)] = old[max(at, 0) : at + 1] + [(old[-1][0], rect) for rect in rects]

    def changed_since(self, layer: str, revision: int) -> list[Rect]:
        """Disjoint rectangles that hold what changed of a layer after `revision`, and little else; [] when none did."""
        return cover(rect for at, rect in self._log[layer] if at > revision)

    def layer_revision(self, layer: str) -> int:
        """The revision at which a layer last changed."""
        log = self._log[layer]
        return log[-1][0] if log else 0

    def set_settings(self, settings: Settings) -> None:
        self.settings = settings
        self.revision += 1
        self.settings_revision = self.revision

    def set(self, path: str, value: object) -> None:
        """Change one setting without an undo step (the session wraps it in one); BadInput out of range."""
        self.set_settings(replace(self.settings, path, value))

    def put_object(self, name: str, thing: object | None) -> None:
        """Place, replace or (None) remove an object."""
        if thing is None:
            self.objects.pop(name, None)
        else:
            self.objects[name] = thing
        self.revision += 1
        self.objects_revision = self.revision

    def put_mesh(self, name: str, mesh: Mesh) -> None:
        """Hold a mesh, for props to name. What it is follows from its name, so undo needs no step."""
        self.meshes[name] = mesh
        self.revision += 1
        self.objects_revision = self.revision

    def put_sky(self, name: str, sky: np.ndarray) -> None:
        """Hold a sky, for shots to name, as `put_mesh` does a mesh."""
        self.skies[name] = sky
        self.revision += 1
        self.objects_revision = self.revision

    def write(self, layer: str, rect: Rect, values: np.ndarray) -> None:
        """Overwrite samples outside any stroke: scripts, generators, importers. No undo step.

        `values` broadcasts to `(rows, cols[, channels])` of `rect`; for height they are ground metres.
        """
        data = self.layers[layer]
        rect = data.grid.clip(rect)
        tiles = list(data.grid.tiles(rect))
        before = {tile: data.snapshot(tile) for tile in tiles}
        data.array[rect.slices] = values
        for tile in tiles:
            data.settle(tile, before[tile])
        self.mark(layer, rect)


def cover(rects: Iterable[Rect], most: int = 64, spare: float = 0.1) -> list[Rect]:
    """Disjoint rectangles, at most `most`, that hold all of `rects` and, along a slanting stroke, not its bounding box.

    Rows are cut into bands; in each, columns that meet are joined. Bands are stacked again where their union is at most
    `spare` larger than what they hold.
    """
    parts = sorted({rect for rect in rects if not rect.empty})
    if len(parts) <= 1:
        return parts
    span = max(rect.row1 for rect in parts) - parts[0].row0
    band = BAND * math.ceil(span / (most * BAND))
    while band <= span:
        pieces = _banded(parts, band)
        stacked = _stacked(pieces, spare) if len(pieces) <= 4 * most else pieces
        if len(stacked) <= most:
            return stacked
        band *= 2
    return merge(parts, most)


def _stacked(pieces: list[Rect], spare: float) -> list[Rect]:
    """Disjoint rectangles over disjoint pieces sorted from south to north, joined where that adds few cells."""
    stacked: list[Rect] = []
    held: list[int] = []  # cells of the pieces in each
    for number, piece in enumerate(pieces):
        for at, below in enumerate(stacked):
            if below.row1 != piece.row0:
                continue
            union, cells = below.union(piece), held[at] + piece.cells
            if union.cells > (1 + spare) * cells:
                continue
            if all(union.intersect(r).empty for r in (*stacked, *pieces[number + 1 :]) if r != below):
                stacked[at], held[at] = union, cells
                break
        else:
            stacked.append(piece)
            held.append(piece.cells)
    return stacked


def _banded(parts: list[Rect], band: int) -> list[Rect]:
    """Pieces of sorted rectangles, one band of rows after another, from west to east; disjoint."""
    bands: dict[int, list[Rect]] = {}
    for rect in parts:
        for number in range(rect.row0 // band, (rect.row1 - 1) // band + 1):
            rows = max(rect.row0, number * band), min(rect.row1, (number + 1) * band)
            bands.setdefault(number, []).append(Rect(rows[0], rect.col0, rows[1], rect.col1))
    pieces = []
    for number in sorted(bands):
        joined: list[Rect] = []
        for rect in sorted(bands[number], key=lambda r: r.col0):
            if joined and rect.col0 <= joined[-1].col1:
                joined[-1] = joined[-1].union(rect)
            else:
                joined.append(rect)
        pieces += joined
    return pieces


def merge(rects: Iterable[Rect], most: int = 16) -> list[Rect]:
    """Join rectangles that overlap; past `most` of them, or when joining costs little, their union."""
    merged: list[Rect] = []
    for rect in rects:
        while True:
            hit = next((other for other in merged if not rect.intersect(other).empty), None)
            if hit is None:
                break
            merged.remove(hit)
            rect = rect.union(hit)
        merged.append(rect)
    if len(merged) > most:
        union = merged[0]
        for rect in merged[1:]:
            union = union.union(rect)
        return [union]
    return merged
