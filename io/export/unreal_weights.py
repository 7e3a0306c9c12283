"""Weight maps for Unreal's landscape import: one grey picture of 8 bits a material, as large as the height map.

Landscape > Import takes PNG of 8 bits or `.r8` for each layer (research, files 1). Of tiled landscapes there are none.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np

from ...level import Level
from ...level.beat import beat
from ...level.ground_materials import MATERIALS
from .layout import Layout
from .map_ground import MAKING, TOP, ground_weights, shared_out
from .map_makers import MapRow, Rows, Samples, spooled
from .maps import row_slices
from .records import Channel

NAMES = tuple(f"weight_{row.name.replace(' ', '_')}" for row in MATERIALS)
DOC = "Weight of {} for Landscape's layer of that name, at the size of the height map; all eight sum to 255."


def weight_rows(layout: Layout | None) -> dict[str, MapRow]:
    """A row of maps for each material; None for a check, which makes none."""

    @cache
    def all_of(level: Level) -> Samples:
        return _on_landscape(level, layout)

    def row(index: int, name: str, label: str) -> MapRow:
        def make(level: Level) -> Samples | None:
            if layout is None or layout.tiled:
                return None
            whole = all_of(level)
            rows, cols, _ = whole.values.shape
            part = Rows((rows, cols, 1), lambda *at: whole.values.read(*at)[..., index : index + 1])
            return Samples(part, whole.cell_m, numbers=whole.numbers)

        return MapRow(
            name, DOC.format(label), (Channel(name="weight", meaning=f"weight of {label}", unit=""),), make, bits=8
        )

    return {name: row(index, name, of.name) for index, (name, of) in enumerate(zip(NAMES, MATERIALS, strict=True))}


def _on_landscape(level: Level, layout: Layout) -> Samples:
    """All weights at the landscape's samples, row 0 south; beyond the level its edge goes on."""
    made = ground_weights(level)
    rows, cols, _ = made.values.shape
    stride = made.cell_m / level.grid.cell_m
    row_at, row_part = _split(layout.rows_at[::-1] / stride, rows)
    col_at, col_part = _split(layout.cols_at / stride, cols)

    def blocks() -> Iterator[np.ndarray]:
        for block in row_slices(len(row_at), len(MATERIALS) * len(col_at)):
            beat(MAKING * block.stop / len(row_at))
            first, last = int(row_at[block].min()), int(row_at[block].max()) + 2
            near = made.values[first:last].astype(np.float64)
            south, north = near[row_at[block] - first], near[row_at[block] - first + 1]
            along = south + (north - south) * row_part[block, None, None]
            left = along[:, col_at]
            yield shared_out(left + (along[:, col_at + 1] - left) * col_part[:, None])

    values = spooled((len(row_at), len(col_at), len(MATERIALS)), blocks(), TOP)
    return Samples(values, layout.spacing_m, numbers={"row_0_y_m": level.grid.extent_m[1]})


def _split(positions: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Whole index, so that there is a next one, and remainder; held at the ends."""
    held = np.clip(positions, 0, count - 1)
    whole = np.minimum(held.astype(np.intp), count - 2)
    return whole, held - whole
