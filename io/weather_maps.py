"""Weather maps from and to images: channels by name or swizzle, any size, 8 bits to float, linear (Z04, T04).

Row 0 of an image is its top, which is north. A map of 512² is taken sample for sample, so that a round trip loses what
the file's bits lose and nothing else. Peers' layouts: Unity HDRP's volumetric clouds (their Cloud Map: coverage, rain,
type; import it without sRGB and without compression, its +u is +x and its +v, up in the picture, +z), three-clouds of
takram, the Godot cloud demo of clayjohn.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..level import BadInput, Level
from ..level.sky_maps import (
    CELL_M,
    SEAM,
    SIDE,
    STAGES,
    TILE_M,
    placed,
    resampled,
    seam_ratio,
    sky_map,
    unpulled,
    wrap_blended,
)  # fmt: skip
from ..level.weather import pulled
from .images import load_image, write_image
from .swizzle import parse, picked

MOST = 8192  # samples a side
SLACK = 1e-3  # how far floats may leave 0 … 1: filters and half floats do
BITS = {".png": (8, 16), ".tif": (8, 16, 32), ".tiff": (8, 16, 32), ".exr": (16, 32)}


@dataclass(frozen=True)
class WeatherLayout:
    """A row: `swizzle` reads it, "" for one that is only written; `stage` is what it is written of, "" for never.

    `pulled` files hold what precipitation made of the sky, and type as gradient coordinate (Z03).
    """

    name: str
    label: str
    doc: str
    swizzle: str
    stage: str = ""
    pulled: bool = False


WEATHER_LAYOUTS: dict[str, WeatherLayout] = {
    row.name: row
    for row in (
        WeatherLayout("ours", "Shorewright", "Red coverage, green precipitation, blue type: 0 stratus, 1 cumulus.",
                      "r,g,b", "painted"),
        WeatherLayout("weighted", "Shorewright with weight", "The same, and in alpha how much the paint counts.",
                      "r,g,b,a", "paint"),
        WeatherLayout("weights", "Weights", "Red, green, blue: how much the paint of each channel counts.",
                      "", "paint"),
        WeatherLayout("hdrp", "Unity HDRP cloud map", "Red coverage, green rain, blue the place along the cloud lookup "
                      "table: 0 stratus, 0.5 cumulus, 1 cumulonimbus. Import it there without sRGB.",
                      "r,g,b", "final", pulled=True),
        WeatherLayout("takram", "three-clouds", "Red coverage of the lowest layer; cumulus everywhere.", "r,0,0.6"),
        WeatherLayout("clayjohn", "Godot cloud demo", "Blue coverage, red type.", "b,0,r"),
    )
}  # fmt: skip


def find_layout(name: str) -> WeatherLayout:
    """The row of a layout; BadInput names the list."""
    if name not in WEATHER_LAYOUTS:
        raise BadInput(f"no layout of weather maps is called {name!r}; there are: {', '.join(WEATHER_LAYOUTS)}")
    return WEATHER_LAYOUTS[name]


def read_weather_map(
    path: Path | str,
    *,
    layout: str = "ours",
    swizzle: str = "",
    weights: Path | str = "",
    wrap_blend_m: float = 0.0,
    feather_m: float = 0.0,
    extent_m: float = TILE_M,
    about_m: tuple[float, float] = (0.0, 0.0),
) -> tuple[np.ndarray, list[str]]:
    """(float32 `(512, 512, 6)` as the layer `weather` holds it, what is worth telling) of an image.

    `weights` is a second image of three weights; `extent_m` how much it covers, about `about_m` of the painted map.
    Without a weight of its own a map counts wholly where it lies. BadInput for what cannot be a weather map.
    """
    row, notes = find_layout(layout), []
    if not 2 * CELL_M <= extent_m <= TILE_M:
        raise BadInput(f"a weather map of {extent_m:g} m a side is outside {2 * CELL_M:.0f} to {TILE_M:.0f} m")
    if not (swizzle or row.swizzle):
        raise BadInput(f"the layout {layout!r} holds weights alone: give its file as the weights of another one")
    terms = parse(swizzle or row.swizzle)
    values = _read(Path(path), terms, notes)
    if weights:
        values = np.concatenate([values[..., :3], _weights(Path(weights), values.shape[:2])], -1)
    if extent_m == TILE_M:
        values = _mended(values, Path(path).name, wrap_blend_m, notes)
    elif wrap_blend_m:
        raise BadInput(f"only a map of all {TILE_M:.0f} m wraps round: use a feather for one of {extent_m:g} m")
    sky, share = placed(values, extent_m, about_m, feather_m)
    kept = np.array([not term.kept for term in terms[:3]], np.float32)
    weight = (sky[..., 3:] if values.shape[-1] == 6 else 1.0) * share[..., None] * kept
    seen = unpulled(sky[..., :3]) if row.pulled and not swizzle else sky[..., :3]
    return np.concatenate([seen, weight], -1).astype(np.float32), notes


def _weights(path: Path, shape: tuple[int, int]) -> np.ndarray:
    """The three weights in another image; BadInput when it has another size."""
    found = _read(path, parse("r,g,b"), [])
    if found.shape[:2] != shape:
        raise BadInput(f"{path} has {found.shape[1]} × {found.shape[0]} samples, the map {shape[1]} × {shape[0]}")
    return found


def _read(path: Path, terms, notes: list[str]) -> np.ndarray:
    """float32 `(rows, cols, 3 or 6)`, row 0 south, all 0 … 1."""
    header, pixels = load_image(path)
    rows, cols = pixels.shape[:2]
    if not (2 <= rows <= MOST and 2 <= cols <= MOST):
        raise BadInput(f"{path} has {cols} × {rows} samples; a weather map has 2 to {MOST} a side")
    values = picked(pixels, header.channels, terms, path.name)[::-1]
    low, high = float(values.min()), float(values.max())  # NaN comes through both
    if not (np.isfinite(low) and np.isfinite(high)):
        bad = int((~np.isfinite(values)).any(axis=-1).sum())
        raise BadInput(f"{path} holds {bad} samples that are not numbers, so it cannot be a weather map")
    if low < -SLACK or high > 1 + SLACK:
        raise BadInput(f"{path} holds numbers from {low:.4g} to {high:.4g}; a weather map takes 0 to 1: scale it first")
    if rows != cols:
        notes.append(f"{path.name} has {cols} × {rows} samples: it was stretched to a square")
    elif rows != SIDE:
        notes.append(f"{path.name} has {cols} × {rows} samples: {'averaged' if rows > SIDE else 'interpolated'}")
    return np.clip(values, 0, 1, out=values)


def _mended(values: np.ndarray, name: str, blend_m: float, notes: list[str]) -> np.ndarray:
    """The map with its edges cross-faded when asked; what its seam is, told."""
    if not 0 <= blend_m <= TILE_M / 2:
        raise BadInput(f"a wrap blend of {blend_m:g} m is outside 0 to {TILE_M / 2:.0f} m")
    ratio = seam_ratio(values[..., :3])
    if blend_m:
        return wrap_blended(values, *(max(round(blend_m / TILE_M * count), 1) for count in values.shape[:2]))
    if ratio > SEAM:
        told = "has a hard edge" if np.isinf(ratio) else f"has steps across its edge {ratio:.1f} times those inside"
        notes.append(f"{name} does not tile: it {told}; a wrap blend of some 5000 m mends that")
    return values


def layout_values(level: Level, layout: str, stage: str = "", time_s: float = 0.0) -> tuple[np.ndarray, list[str]]:
    """(float32 `(512, 512, 3 or 4)` as a layout writes a level's sky, what is worth telling)."""
    row = find_layout(layout)
    if not row.stage:
        raise BadInput(f"the layout {layout!r} is only read: export {', '.join(exportable())}")
    stage = stage or row.stage
    if stage not in STAGES or (layout == "weights" and stage != "paint"):
        raise BadInput(f"the layout {layout!r} has no stage {stage!r}; there are: {', '.join(STAGES)}")
    sky, notes = sky_map(level, stage, time_s), []
    if stage == "paint" and not sky[..., 3:].any():
        notes.append("nothing is painted on this sky, so the map is empty")
    if layout == "weights":
        return sky[..., 3:], notes
    if row.pulled and stage != "final":
        sky = np.concatenate([pulled(sky[..., :3]), sky[..., 3:]], -1).astype(np.float32)
    elif stage == "final" and not row.pulled:
        notes.append("type is the gradient coordinate here: 0 stratus, 0.5 cumulus, 1 cumulonimbus")
    if layout != "weighted":
        return sky[..., :3], notes
    weights = sky[..., 3:]
    if np.ptp(weights, axis=-1).any():
        notes.append("the weights of the three channels differ, and alpha holds the largest: the layout weights is all")
    return np.concatenate([sky[..., :3], weights.max(axis=-1, keepdims=True)], -1), notes


def exportable() -> list[str]:
    """Names of the layouts that are written."""
    return [row.name for row in WEATHER_LAYOUTS.values() if row.stage]


def write_weather_map(path: Path | str, sky: np.ndarray, *, bits: int = 8, side: int = SIDE) -> Path:
    """Write float32 `(512, 512, 3 or 4)` samples of 0 … 1, row 0 south, as an image of `side`², linear.

    8 or 16 bits in PNG or TIFF, 16 (half) or 32 in EXR. BadInput for a size, number of bits or name that won't do.
    """
    path = Path(path)
    fits = BITS.get(path.suffix.lower())
    if fits is None:
        raise BadInput(f"{path.name} is no weather map that can be written: end it in {', '.join(BITS)}")
    if bits not in fits:
        raise BadInput(f"{path.suffix} files hold {' or '.join(map(str, fits))} bits, not {bits}")
    if not 2 <= side <= MOST:
        raise BadInput(f"a weather map of {side} samples a side is outside 2 to {MOST}")
    values = np.clip(sky if side == len(sky) else resampled(sky, side), 0, 1)[::-1]
    if path.suffix.lower() != ".exr" and bits < 32:
        top = (1 << bits) - 1
        values = np.rint(values.astype(np.float64) * top).astype(np.uint8 if bits == 8 else np.uint16)
    return write_image(path, np.ascontiguousarray(values), half=bits == 16, data=True)
