"""Lowest and highest ground of any rectangle, from a pyramid kept up to date by dirty rectangles."""

from __future__ import annotations

import numpy as np

from ..level import Rect

BLOCK = 8  # cells a side of a block of the pyramid's finest level


class HeightBounds:
    """`levels[k]` is float32 `(rows, cols, 2)`: lowest and highest sample of blocks of BLOCK · 2^k cells."""

    def __init__(self, height: np.ndarray) -> None:
        rows, cols = height.shape
        self.rows, self.cols = rows, cols
        shape = -(-(rows - 1) // BLOCK), -(-(cols - 1) // BLOCK)
        self.levels = [np.zeros((*shape, 2), np.float32)]
        while max(shape) > 1:
            shape = -(-shape[0] // 2), -(-shape[1] // 2)
            self.levels.append(np.zeros((*shape, 2), np.float32))
        self.update(height, Rect(0, 0, rows, cols))

    @property
    def range(self) -> tuple[float, float]:
        """Lowest and highest ground of the level."""
        return float(self.levels[-1][0, 0, 0]), float(self.levels[-1][0, 0, 1])

    def update(self, height: np.ndarray, rect: Rect) -> None:
        """Read again the blocks that samples in `rect` belong to (a block takes its closing row and column too)."""
        rows, cols = self.levels[0].shape[:2]
        row0, col0 = max((rect.row0 - 1) // BLOCK, 0), max((rect.col0 - 1) // BLOCK, 0)
        row1, col1 = min(-(-rect.row1 // BLOCK), rows), min(-(-rect.col1 // BLOCK), cols)
        if row1 <= row0 or col1 <= col0:
            return
        part = height[row0 * BLOCK : row1 * BLOCK + 1, col0 * BLOCK : col1 * BLOCK + 1]
        for channel, reduce in enumerate((np.minimum, np.maximum)):
            lines = _blocks(part, reduce, row1 - row0)
            self.levels[0][row0:row1, col0:col1, channel] = _blocks(lines.T, reduce, col1 - col0).T
        for below, level in zip(self.levels, self.levels[1:], strict=False):
            row0, col0, row1, col1 = row0 // 2, col0 // 2, -(-row1 // 2), -(-col1 // 2)
            source = below[row0 * 2 : row1 * 2, col0 * 2 : col1 * 2]
            low = _pairs(_pairs(source[..., 0], np.minimum).T, np.minimum).T
            high = _pairs(_pairs(source[..., 1], np.maximum).T, np.maximum).T
            level[row0:row1, col0:col1] = np.stack([low, high], -1)

    def query(self, row0, col0, row1, col1) -> tuple[np.ndarray, np.ndarray]:
        """Lowest and highest of rectangles (arrays of cells, clamped to the level); never too narrow."""
        rows, cols = self.levels[0].shape[:2]
        row0, row1 = (np.clip(v // BLOCK, 0, rows - 1) for v in (row0, row1))
        col0, col1 = (np.clip(v // BLOCK, 0, cols - 1) for v in (col0, col1))
        low, high = np.empty(len(row0), np.float32), np.empty(len(row0), np.float32)
        span = np.maximum(row1 - row0, col1 - col0)
        depth = np.ceil(np.log2(np.maximum(span, 1))).astype(int)  # at most 2 × 2 blocks there
        for k in np.unique(depth):
            here = np.flatnonzero(depth == k)
            table = self.levels[min(k, len(self.levels) - 1)]
            corners = [
                table[np.minimum(r[here] >> k, table.shape[0] - 1), np.minimum(c[here] >> k, table.shape[1] - 1)]
                for r in (row0, row1)
                for c in (col0, col1)
            ]
            low[here] = np.min([corner[:, 0] for corner in corners], axis=0)
            high[here] = np.max([corner[:, 1] for corner in corners], axis=0)
        return low, high


def _blocks(part: np.ndarray, reduce, count: int) -> np.ndarray:
    """Blocks of BLOCK + 1 overlapping lines along the first axis, reduced; the last block may be short."""
    starts = np.arange(count) * BLOCK
    inner = reduce.reduceat(part[: count * BLOCK], starts, axis=0)
    closing = part[np.minimum(starts + BLOCK, len(part) - 1)]
    return reduce(inner, closing)


def _pairs(lines: np.ndarray, reduce) -> np.ndarray:
    return reduce.reduceat(lines, np.arange(0, len(lines), 2), axis=0)
