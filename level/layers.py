"""LAYERS: every map a level can carry, one row each, and the array behind a row.

Author in float, make 8 bits only in an exporter. A layer's array exists once something is written to it, and only the
128² tiles that were written count: the others are neither saved, uploaded nor kept for undo.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .grid import TILE, Grid, Rect

# 70 km round the middle of the weather map, in metres of the moving air (weather.py)
WEATHER_GRID = Grid(512, 512, 70_000 / 512, origin_m=(-35_000.0, -35_000.0), wraps=True)


@dataclass(frozen=True)
class Layer:
    """A row: `half` layers lie as float16 on the graphics card, and in a file where that says every sample exactly.

    In memory all are float32: strokes too soft for a half float (under 1/4096 near 1) add up over any number of them.

    Paint keeps between `low` and `high`.
    """

    name: str
    label: str
    channels: tuple[str, ...]
    unit: str
    doc: str
    half: bool = True
    grid: str = "level"
    low: float = 0.0
    high: float = 1.0


LAYERS: dict[str, Layer] = {
    row.name: row
    for row in (
        Layer(
            "height",
            "Height",
            ("height",),
            "m",
            "Ground: the imported base plus what was sculpted.",
            half=False,
            low=-12_000.0,
            high=12_000.0,
        ),
        Layer(
            "flow",
            "Flow",
            ("east", "north"),
            "m/s",
            "Painted current, added to the procedural one.",
            half=False,
            low=-20.0,
            high=20.0,
        ),
        Layer("foam", "Foam", ("transient", "constant"), "", "Painted foam: with the waves, and always."),
        Layer(
            "river_surface",
            "River surface",
            ("height",),
            "m",
            "Surface of water that isn't the sea.",
            half=False,
            low=-12_000.0,
            high=12_000.0,
        ),
        Layer("river_mask", "River mask", ("mask",), "", "Where that water is."),
        Layer("river_foam", "River foam", ("stagnant", "turbulent"), "", "Painted foam on rivers."),
        Layer(
            "mouth",
            "Waves in rivers",
            ("waves",),
            "",
            "Waves of the sea that come into rivers and their mouths, −1 none, 1 all of them.",
            low=-1.0,
        ),
        Layer("cover", "Cover", ("sand", "rock", "grass", "always_wet"), "", "Ground painted over the rules."),
        Layer(
            "scatter",
            "Scatter",
            ("rocks", "driftwood", "grass"),
            "",
            "Things added to the rules, −1 none … 1 many.",
            low=-1.0,
        ),
        Layer("puddle_keepout", "No puddles", ("mask",), "", "Where no puddle forms."),
        Layer("shelter", "Shelter", ("mask",), "", "Where no rain falls."),
        Layer("snow", "Snow", ("depth",), "", "Painted snow."),
        Layer("ice", "Ice", ("mask",), "", "Painted ice."),
        Layer("corruption", "Corruption", ("mask",), "", "Where the corruption strikes."),
        Layer("yielding", "Yielding ground", ("mask",), "", "Ground that takes trails."),
        Layer("quiet", "Quiet", ("mask",), "", "Play area in which effects are held down."),
        Layer(
            "weather",
            "Weather map",
            (
                "coverage",
                "precipitation",
                "type",
                "coverage_weight",
                "precipitation_weight",
                "type_weight",
            ),
            "",
            "Painted sky on its own wrapping grid, and how much each channel counts over the simulation.",
            grid="weather",
        ),
    )
}


class LayerData:
    """The samples of one layer: float32 `(rows, cols)` or `(rows, cols, channels)`, zero where never written."""

    def __init__(self, row: Layer, grid: Grid) -> None:
        self.row = row
        self.grid = grid
        self.written = np.zeros(grid.tile_shape, bool)
        self._array: np.ndarray | None = None

    @property
    def shape(self) -> tuple[int, ...]:
        channels = len(self.row.channels)
        return self.grid.shape if channels == 1 else (*self.grid.shape, channels)

    @property
    def neutral(self) -> bool:
        """True while nothing was ever written."""
        return not self.written.any()

    @property
    def array(self) -> np.ndarray:
        """The live samples; untouched pages of a fresh zero array take no memory."""
        if self._array is None:
            self._array = np.zeros(self.shape, np.float32)
        return self._array

    def read(self, rect: Rect) -> np.ndarray:
        """A view of the samples in `rect` (zeros that cost nothing while the layer is neutral)."""
        if self._array is None:
            return np.broadcast_to(np.float32(0), rect.shape + self.shape[2:])
        return self._array[rect.slices]

    # A tile is saved before its first write, settled when the stroke is released, swapped by undo and redo.

    def tile(self, tile: tuple[int, int]) -> np.ndarray | None:
        """A copy of a tile as stored, None where it was never written."""
        return self.array[self.grid.tile_rect(tile).slices].copy() if self.written[tile] else None

    def put_tile(self, tile: tuple[int, int], values: np.ndarray | None) -> None:
        self.array[self.grid.tile_rect(tile).slices] = 0 if values is None else values
        self.written[tile] = values is not None

    def snapshot(self, tile: tuple[int, int]) -> tuple[np.ndarray | None, np.ndarray | None]:
        """(stored, live) copies of a tile, taken before a stroke first writes to it."""
        return self.tile(tile), None

    def settle(self, tile: tuple[int, int], snapshot: tuple) -> None:
        """Make what a stroke left in the live array the stored tile."""
        self.written[tile] = True

    def restore(self, tile: tuple[int, int], snapshot: tuple) -> None:
        """Put a tile back as the snapshot had it."""
        self.put_tile(tile, snapshot[0])

    @property
    def bytes(self) -> int:
        """Bytes of the tiles that count."""
        return int(self.written.sum()) * TILE * TILE * 4 * len(self.row.channels)


class HeightData(LayerData):
    """Height = base (import or generator) + one sparse sculpt layer; `array` is the sum, kept by tile.

    What is stored, saved and undone is the sculpt layer, so that a re-import under it keeps the artist's work.
    """

    def __init__(self, row: Layer, grid: Grid, base: np.ndarray) -> None:
        super().__init__(row, grid)
        self.base = np.ascontiguousarray(base, np.float32).view()
        self.base.flags.writeable = False  # replaced by `Level.reset`, never changed in place: files rely on it
        self._sculpt: np.ndarray | None = None

    @property
    def sculpt(self) -> np.ndarray:
        if self._sculpt is None:
            self._sculpt = np.zeros(self.grid.shape, np.float32)
        return self._sculpt

    @property
    def array(self) -> np.ndarray:
        """The ground, float32 `(rows, cols)`: the base itself until something is sculpted."""
        if self._array is None:
            self._array = self.base.copy()
        return self._array

    def read(self, rect: Rect) -> np.ndarray:
        return (self.base if self._array is None else self._array)[rect.slices]

    def tile(self, tile: tuple[int, int]) -> np.ndarray | None:
        return self.sculpt[self.grid.tile_rect(tile).slices].copy() if self.written[tile] else None

    def put_tile(self, tile: tuple[int, int], values: np.ndarray | None) -> None:
        where = self.grid.tile_rect(tile).slices
        if values is not None or self._sculpt is not None:
            self.sculpt[where] = 0 if values is None else values
        self.array[where] = self.base[where] if values is None else self.base[where] + values
        self.written[tile] = values is not None

    def snapshot(self, tile: tuple[int, int]) -> tuple[np.ndarray | None, np.ndarray]:
        return self.tile(tile), self.array[self.grid.tile_rect(tile).slices].copy()

    def settle(self, tile: tuple[int, int], snapshot: tuple) -> None:
        where = self.grid.tile_rect(tile).slices
        self.sculpt[where] += self.array[where] - snapshot[1]
        self.array[where] = self.base[where] + self.sculpt[where]
        self.written[tile] = True
