"""Small text for pictures, in the font that comes inside OpenImageIO."""

from __future__ import annotations

import numpy as np

from ..level import BadInput
from .images import error_of

FONT = "DroidSans"


def text_mask(text: str, size_px: int) -> np.ndarray:
    """How much of each pixel a line of text covers, float32 0 … 1 `(rows, cols)`, row 0 on top.

    Rows are the same for every text of a size, so that lines stand level.
    """
    import OpenImageIO

    algorithms = OpenImageIO.ImageBufAlgo
    extent = algorithms.text_size(text, size_px, FONT)
    cols = max(extent.xend, 1) if extent.defined else 1
    rows, baseline = round(1.3 * size_px), size_px
    picture = OpenImageIO.ImageBuf(OpenImageIO.ImageSpec(cols, rows, 1, "float"))
    algorithms.zero(picture)
    if text and not algorithms.render_text(picture, 0, baseline, text, size_px, FONT, (1.0,)):
        raise BadInput(f"this OpenImageIO draws no text ({error_of(picture)})")
    return np.clip(np.asarray(picture.get_pixels(OpenImageIO.FLOAT), np.float32).reshape(rows, cols), 0, 1)
