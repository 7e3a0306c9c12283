"""A contact sheet: pictures in rows and columns with thin gutters, names over columns and before rows (L08)."""

from __future__ import annotations

import numpy as np

from ..io.labels import text_mask

GUTTER_PX = 4
PAPER, INK = (24, 25, 27), (214, 214, 210)
LINES = 2  # of text before a row


def text_px(cell: tuple[int, int]) -> int:
    """Height of the text beside cells of (width, height)."""
    return int(np.clip(cell[1] // 13, 9, 26))


def sheet_size(cell: tuple[int, int], rows: list[str], columns: list[str]) -> tuple[int, int]:
    """(width, height) in pixels of the sheet that `compose` makes."""
    left, top = _margins(cell, rows)
    return (left + len(columns) * (cell[0] + GUTTER_PX), top + len(rows) * (cell[1] + GUTTER_PX))


def compose(cells: list[list[np.ndarray]], rows: list[str], columns: list[str]) -> np.ndarray:
    """The sheet of uint8 pictures `(height, width, 3)` of one size, by row and column; a row's name may have two lines.

    Names that are wider than their place are cut at its edge.
    """
    height, width = cells[0][0].shape[:2]
    (left, top), size_px = _margins((width, height), rows), text_px((width, height))
    across, down = sheet_size((width, height), rows, columns)
    sheet = np.empty((down, across, 3), np.uint8)
    sheet[:] = PAPER
    for number, name in enumerate(columns):
        x = left + number * (width + GUTTER_PX)
        _write(sheet[GUTTER_PX:top, x : x + width], name, size_px)
    for number, name in enumerate(rows):
        y = top + number * (height + GUTTER_PX)
        for line, text in enumerate(name.split("\n")[:LINES]):
            _write(sheet[y + round(1.4 * line * size_px) : y + height, GUTTER_PX : left - GUTTER_PX], text, size_px)
        for column, picture in enumerate(cells[number]):
            x = left + column * (width + GUTTER_PX)
            sheet[y : y + height, x : x + width] = picture
    return sheet


def _margins(cell: tuple[int, int], rows: list[str]) -> tuple[int, int]:
    """Pixels left of the first column and above the first row."""
    size_px = text_px(cell)
    lines = [line for name in rows for line in name.split("\n")]
    widest = max(text_mask(line, size_px).shape[1] for line in lines)
    return min(widest, cell[0]) + 2 * GUTTER_PX, round(1.3 * size_px) + 2 * GUTTER_PX


def _write(place: np.ndarray, text: str, size_px: int) -> None:
    """Lay text into the upper left of a part of the sheet."""
    mask = text_mask(text, size_px)[: place.shape[0], : place.shape[1], None]
    part = place[: mask.shape[0], : mask.shape[1]]
    part[:] = np.rint(part + (np.array(INK, np.float32) - part) * mask)
