"""The way of a stroke, cell by cell: a mean over the dabs that came by, in which the late ones count more."""

from __future__ import annotations

import numpy as np

from ...level.grid import TILE

FADES = np.float32(0.35)  # of what earlier dabs left, that a dab of weight 1 takes away


class Way:
    """Kept by tile, float32: unit way times weight (east, north), speed times weight, weight."""

    def __init__(self) -> None:
        self.tiles: dict[tuple[int, int], np.ndarray] = {}

    def over(self, piece, heading: np.ndarray, speed: np.float32) -> tuple[np.ndarray, np.ndarray]:
        """Water (east, north) in m/s under a piece after a dab that goes along `heading`."""
        row, col = piece.rect.row0 // TILE, piece.rect.col0 // TILE
        tile = self.tiles.get((row, col))
        if tile is None:
            tile = self.tiles[row, col] = np.zeros((4, TILE, TILE), np.float32)
        where = tile[
            :,
            piece.rect.row0 - row * TILE : piece.rect.row1 - row * TILE,
            piece.rect.col0 - col * TILE : piece.rect.col1 - col * TILE,
        ]
        where *= 1 - FADES * piece.weight
        for number, value in enumerate((*heading, speed, 1)):
            where[number] += np.float32(value) * piece.weight
        east, north, paced, weight = where
        length = np.hypot(east, north)
        scale = np.divide(paced, length * weight, out=np.zeros_like(length), where=length * weight > 0)
        return east * scale, north * scale
