"""What an importer found in a file, and what makes a height map of it: range, rows, holes, square cells.

Nothing is guessed silently: what the file does not state comes from a flag or a documented default that is put into
`notes`; what the file states and a flag contradicts is refused.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..level import BadInput
from ..level.earth import degrees_to_metres
from ..level.grid import MAX_SIDE

NORTH, SOUTH = "north-first", "south-first"
VOIDS = (-9999.0, -99999.0, -32768.0)  # what elevation files write for "no data" without saying so
FARTHEST_M = 1e6  # no height of this planet: an unnamed sentinel such as 3.4e38


@dataclass
class Found:
    """Samples as they lie in a file and what it says about them; None = it doesn't say.

    values: (rows, cols), NaN where there is no data. `full_scale` is the integer that means 1 in a normalised map;
    `maybe_normalised` marks floats that are metres unless all lie within 0 … 1.
    """

    values: np.ndarray
    cell_m: tuple[float, float] | None = None
    cell_deg: tuple[float, float] | None = None
    rows: str | None = None
    rows_why: str = ""
    full_scale: float | None = None
    maybe_normalised: bool = False
    fallback_cell: bool = False  # a format with 1 m for its documented default, even where it gives degrees
    latitude: float = 0.0
    georeference: dict = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)


def check_side(path: Path, rows: int, cols: int) -> None:
    """BadInput before memory is taken for more samples than a level can hold, or for none."""
    if rows > MAX_SIDE or cols > MAX_SIDE:
        raise BadInput(
            f"{path} holds {cols} × {rows} samples; a level has at most {MAX_SIDE} a side: crop the file first"
        )
    if rows < 2 or cols < 2:
        raise BadInput(f"{path} holds {cols} × {rows} samples; a height map needs at least 2 × 2")


def metres(found: Found, path: Path, height_range: tuple[float, float] | None) -> np.ndarray:
    """Samples in metres, float64 or float32; BadInput when the file doesn't say what they mean, or a flag disagrees."""
    values = found.values
    if height_range is not None:
        low, high = (float(end) for end in height_range)
        if not (math.isfinite(low) and math.isfinite(high) and low < high):
            raise BadInput(f"--height-range {low:g} {high:g} is no range: give the lower height first")
    span = _span(values)
    if found.full_scale:
        if height_range is None:
            raise BadInput(
                f"{path} holds whole numbers 0 to {found.full_scale:g} without a unit: say which heights in metres the "
                f"two ends mean with --height-range MIN MAX"
            )
        step = (high - low) / found.full_scale
        if found.full_scale <= 255:
            found.notes.append(
                f"8-bit heights: steps of {step:.3g} m will show as terraces; use a 16-bit or float file"
            )
        return low + values.astype(np.float64) * step
    if height_range is None:
        if found.maybe_normalised and span[0] >= 0 and span[1] <= 1:
            raise BadInput(
                f"all heights in {path} lie within 0 and 1, which may be metres or a normalised map: say which heights "
                f"0 and 1 mean with --height-range MIN MAX (0 1 for metres)"
            )
        return values
    if span[0] < 0 or span[1] > 1:
        raise BadInput(
            f"{path} holds {span[0]:g} to {span[1]:g}, which is metres and not 0 to 1: leave out --height-range"
        )
    return low + values.astype(np.float64) * (high - low)


def _span(values: np.ndarray) -> tuple[float, float]:
    with np.errstate(invalid="ignore"):
        return (float(np.fmin.reduce(values, axis=None)), float(np.fmax.reduce(values, axis=None)))


def mark_voids(found: Found, path: Path) -> None:
    """NaN for infinities and for what only a sentinel can be; BadInput when nothing is left."""
    values = found.values
    if values.dtype.kind != "f":
        if not any((values == void).any() for void in VOIDS):
            return
        found.values = values = values.astype(np.float64)
    with np.errstate(invalid="ignore"):
        wrong = ~(np.abs(values) < FARTHEST_M) & ~np.isnan(values)
        for void in VOIDS:
            hits = values == void
            if hits.any():
                found.notes.append(f"{int(hits.sum())} samples of {void:g} are taken for missing")
                wrong |= hits
    if wrong.any():
        found.values = values = np.where(wrong, np.nan, values)
    if np.isnan(values).all():
        raise BadInput(f"{path} holds no height at all: every sample is missing (NaN or no-data)")


def fill_holes(values: np.ndarray, fill_m: float | None, notes: list[str]) -> np.ndarray:
    """Missing samples from their nearest neighbours, smoothed, or a given height; the note says how many."""
    holes = np.isnan(values)
    count = int(holes.sum())
    if not count:
        return values
    share = f"{count} of {values.size} samples ({100 * count / values.size:.2g} %) are missing"
    if fill_m is not None:
        notes.append(f"{share}; filled with {fill_m:g} m")
        return np.where(holes, values.dtype.type(fill_m), values)
    from scipy import ndimage

    nearest = ndimage.distance_transform_edt(holes, return_distances=False, return_indices=True)
    full = values[tuple(nearest)]
    full[holes] = ndimage.gaussian_filter(full, 2.0, mode="nearest")[holes]
    advice = "; if they are sea, give its floor with --fill METRES" if count > 0.2 * values.size else ""
    notes.append(f"{share}; filled from their nearest neighbours, smoothed{advice}")
    return full


def settle_rows(found: Found, path: Path, rows: str | None) -> bool:
    """True when row 0 of the file is the north edge; BadInput when the flag contradicts the file."""
    if rows not in (None, NORTH, SOUTH):
        raise BadInput(f"--rows {rows} is unknown: use {NORTH} or {SOUTH}")
    if found.rows and rows and rows != found.rows:
        raise BadInput(f"{path} says that it is {found.rows} ({found.rows_why}): leave out --rows {rows}")
    if found.rows:
        if found.rows == SOUTH:
            found.notes.append(f"row 0 of the file is its south edge ({found.rows_why})")
        return found.rows == NORTH
    if rows is None:
        found.notes.append(
            f"the file doesn't say which way its rows run: row 0 is taken for the north edge (--rows {SOUTH})"
        )
    return rows != SOUTH


def settle_cell(found: Found, path: Path, cell_m: tuple[float, float] | None) -> tuple[float, float]:
    """(east, north) metres of a cell; BadInput for degrees without the flag, or a flag that contradicts the file."""
    if found.cell_m:
        if cell_m and any(abs(flag / stated - 1) > 1e-3 for flag, stated in zip(cell_m, found.cell_m)):
            raise BadInput(f"{path} says that its cells are {_by(found.cell_m)} m: leave out --cell-m {_by(cell_m)}")
        return found.cell_m
    if cell_m:
        return cell_m
    if found.cell_deg:
        hint = degrees_to_metres(found.cell_deg, found.latitude)
        told = f"cells of {_by(found.cell_deg)} degrees, about {_by(hint)} m here"
        if not found.fallback_cell:
            raise BadInput(f"{path} has {told}: give their size in metres with --cell-m {_by(hint, 'x')}")
        found.notes.append(f"the file has {told}, but 1 m is taken as for any such file (--cell-m {_by(hint, 'x')})")
    else:
        found.notes.append("the file doesn't say how large its cells are: 1 m is taken (--cell-m EASTxNORTH)")
    return 1.0, 1.0


def _by(pair: tuple[float, float], sign: str = " × ") -> str:
    return f"{pair[0]:.6g}{sign}{pair[1]:.6g}"


def square_cells(
    values: np.ndarray, cell_m: tuple[float, float], notes: list[str], path: Path
) -> tuple[np.ndarray, float]:
    """Resample the coarser axis to the finer spacing: exact wherever a new sample meets an old one.

    Monotone piecewise cubics (Fritsch & Butland 1984): no overshoot, even slopes survive. values: `(rows, cols)`.
    """
    fine = min(cell_m)
    if abs(cell_m[0] / cell_m[1] - 1) < 1e-6:
        return values, fine
    axis = 1 if cell_m[0] > cell_m[1] else 0
    ratio = max(cell_m) / fine
    old = values.shape[axis]
    count = math.floor((old - 1) * ratio + 1e-6) + 1
    check_side(path, *(count if a == axis else values.shape[a] for a in (0, 1)))
    whole = abs(ratio - round(ratio)) < 1e-6
    kept = "every original sample is kept" if whole else "originals are kept where the spacings meet"
    ways = ("south to north", "west to east")[axis]
    notes.append(
        f"cells of {_by(cell_m)} m (east × north) aren't square: resampled {ways} from {old} to {count} samples "
        f"of {fine:g} m; {kept}"
    )
    from scipy.interpolate import PchipInterpolator

    place = np.minimum(np.arange(count) / (round(ratio) if whole else ratio), old - 1)
    out = np.empty((count, values.shape[1]) if axis == 0 else (values.shape[0], count), np.float32)
    for start in range(0, values.shape[1 - axis], 512):  # a strip at a time: the cubics are float64
        strip = (slice(None), slice(start, start + 512)) if axis == 0 else (slice(start, start + 512), slice(None))
        out[strip] = PchipInterpolator(np.arange(old), values[strip].astype(np.float64), axis=axis)(place)
    return out, fine
