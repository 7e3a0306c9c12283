"""The map of the open sky (L02, L03): how much of it each place sees, the mean way there, how broken the ground is.

Worked out when the ground changes and kept otherwise. A change reaches as far as the horizons are followed: then that
part of the map is worked out again, to the same bytes as all of it.
"""

from __future__ import annotations

from functools import reduce

import numpy as np

from ...level import Grid, Rect
from ...level.open_sky import STEPS, steps
from ..frame import Frame

KEPT = 2  # maps of different sizes: what moves and what stands still may differ in tier


class OpennessMap:
    """One RGBA8 map: open, rough, bent normal's east and north."""

    def __init__(self, ctx, size: tuple[int, int]) -> None:
        self.size = size
        self.texture = ctx.texture(size, 4)
        self.texture.filter = ctx.LINEAR, ctx.LINEAR
        self.texture.repeat_x = self.texture.repeat_y = False
        self.framebuffer = ctx.framebuffer([self.texture])
        self.key: tuple = ()
        self.revision = 0

    def release(self) -> None:
        self.framebuffer.release()
        self.texture.release()


def draw(frame: Frame) -> None:
    level = frame.level
    held = _map(frame)
    key = frame.renderer.uploader.wholes, level.mean_sea_m
    changed = level.changed_since("height", held.revision) if held.key == key else [level.grid.rect]
    if changed:
        _work_out(frame, held, reduce(Rect.union, changed))
    held.key, held.revision = key, level.revision
    frame.textures["u_openness"] = held.texture


def touched(size: tuple[int, int], grid: Grid, changed: Rect) -> tuple[int, int, int, int]:
    """First column, first row, columns and rows of the map that a change of these samples can reach."""
    reach = int(steps(grid.cell_m)[-1]) + 2
    area = grid.clip(changed.pad(reach))
    scale = (np.array(size) - 1) / (np.array([grid.cols, grid.rows]) - 1)
    first = np.maximum(np.floor(np.array([area.col0, area.row0]) * scale).astype(int) - 1, 0)
    last = np.minimum(np.ceil(np.array([area.col1, area.row1]) * scale).astype(int) + 1, size)
    return int(first[0]), int(first[1]), int(last[0] - first[0]), int(last[1] - first[1])


def _map(frame: Frame) -> OpennessMap:
    """The map of this frame's size, made when there is none."""
    grid, kept = frame.level.grid, frame.renderer.kept.setdefault("openness", {})
    scale = min(frame.tier.openness_size / max(grid.cols, grid.rows), 1.0)
    size = max(round(grid.cols * scale), 2), max(round(grid.rows * scale), 2)
    key = size, frame.tier.openness_ways
    held = kept.pop(key, None) or OpennessMap(frame.renderer.ctx, size)
    kept[key] = held  # the last one is the one used last
    for old in list(kept)[:-KEPT]:
        kept.pop(old).release()
    return held


def _work_out(frame: Frame, held: OpennessMap, changed: Rect) -> None:
    grid = frame.level.grid
    shader = frame.shader("openness.glsl", WAYS=str(frame.tier.openness_ways), STEPS=str(STEPS))
    shader.program["u_target"].value = tuple(float(side) for side in held.size)
    shader.program["u_steps"].write(steps(grid.cell_m).tobytes())
    area = touched(held.size, grid, changed)
    held.framebuffer.use()
    held.framebuffer.scissor = area
    shader.fullscreen()
    held.framebuffer.scissor = None
    frame.stats["openness_share"] = area[2] * area[3] / (held.size[0] * held.size[1])
