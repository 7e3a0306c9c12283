"""Alphas: grey pictures that shape a brush's dab (T03), from any image OpenImageIO reads."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..level import BadInput
from .images import load_image


def read_alpha(path: Path | str) -> np.ndarray:
    """A picture as `(rows, cols)` float32 0 to 1, row 0 on top; BadInput when it is none, or black everywhere.

    Colours give their mean; a picture of one colour with transparency gives its opacity. Floats over 1 are scaled down.
    """
    header, pixels = load_image(path)
    grey = pixels.astype(np.float32)
    if header.whole:
        grey /= np.float32(np.iinfo(pixels.dtype).max)
    grey = np.nan_to_num(grey, nan=0.0, posinf=0.0, neginf=0.0)
    names = [name.upper() for name in header.channels]
    opacity = grey[..., names.index("A")] if "A" in names and len(names) > 1 else None
    colours = [n for n, name in enumerate(names) if name != "A"] or [0]
    grey = grey[..., colours].mean(axis=-1)
    if opacity is not None:
        grey = opacity if np.ptp(grey) < 1 / 512 else grey * opacity
    grey = np.maximum(grey, 0) / max(float(grey.max()), 1.0)
    if grey.max() < 1 / 255:
        raise BadInput(f"{path} is black everywhere, so a brush of its shape would paint nothing")
    return grey
