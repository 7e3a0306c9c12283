"""The paint of `delta.shore`: standing water, and the ground of beds, banks and bars."""

from __future__ import annotations

import numpy as np
from delta import LAKE, OXBOW_M, SPRING
from noise_ops import fbm, smoothstep
from shorewright.level import Level

STEP = 1 / 64  # paint is kept in steps, for a small file


def paint(level: Level, maps: dict[str, np.ndarray], seed: int) -> None:
    """Write the layers, tile by tile where they are anything; `maps` are those that `delta.height` returns."""
    ground = level.height.astype(float)
    mask, surface = standing_water(maps, ground)
    write(level, "river_mask", mask)
    write(level, "river_surface", surface, mask > 0)
    write(level, "river_foam", foam(maps, mask, seed))
    write(level, "cover", cover(maps, ground, mask, seed))


def write(level: Level, layer: str, values: np.ndarray, where: np.ndarray | None = None) -> None:
    """The tiles of a layer that hold anything."""
    for tile in level.grid.tiles(level.grid.rect):
        rect = level.grid.tile_rect(tile)
        if (values if where is None else where)[rect.slices].max() > 0.01:
            level.write(layer, rect, np.round(values[rect.slices] / STEP) * STEP)


def standing_water(maps: dict[str, np.ndarray], ground: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mask and level of the spring's pool, the lake and the oxbow."""
    mask, surface = np.zeros(ground.shape), np.zeros(ground.shape)
    for near, level_m in (
        (maps["lake"] < 1.25, LAKE[4]),
        (maps["spring"] < 1.3, SPRING[4]),
        (maps["oxbow"] < 14, OXBOW_M),
    ):
        wet = near & (ground < level_m)
        mask, surface = np.where(wet, 1.0, mask), np.where(near, level_m, surface)
    return mask, surface


def foam(maps: dict[str, np.ndarray], mask: np.ndarray, seed: int) -> np.ndarray:
    """Stagnant, turbulent `(rows, cols, 2)`: algae on the oxbow and along the lake's shores, froth under the fall."""
    x, y = maps["x"], maps["y"]
    mats = smoothstep(-0.35, 0.35, fbm(x, y, 13, 4, seed + 5))
    still = (
        mats * np.where(maps["oxbow"] < 14, 0.9, 0.7 * smoothstep(0.72, 1.0, maps["lake"]) * (maps["off"] > 9)) * mask
    )
    under = smoothstep(11, 3, np.sqrt(np.square(x - 331) + np.square(y - 553.5)))
    step = smoothstep(7, 2, np.sqrt(np.square(x - 180.5) + np.square(y - 416)))
    froth = (
        np.maximum(under, 0.8 * step)
        * (0.7 + 0.4 * fbm(x, y, 4, 3, seed + 6))
        * smoothstep(1.05, 0.8, maps["off"] / maps["half"])
    )
    return np.clip(np.stack([still, froth], axis=-1), 0, 1)


def cover(maps: dict[str, np.ndarray], ground: np.ndarray, mask: np.ndarray, seed: int) -> np.ndarray:
    """Sand, rock, grass, always wet `(rows, cols, 4)`: gravel and rock beds, sandy bars inside bends, mud by pools."""
    x, y, level = (maps[name] for name in ("x", "y", "level"))
    bank = maps["off"] - maps["half"] + 0.8 * fbm(x, y, 7, 3, seed + 1)
    inner = np.maximum(maps["bend"], 0)
    upper = smoothstep(4.0, 7.0, level)  # rock above, sand below
    bed = smoothstep(1.0, -0.6, bank) * (ground > -0.6)
    bar = smoothstep(11.0, 4.0, bank + 9 * (1 - inner)) * (1 - upper) * (maps["inland"] > -6)
    stand = np.maximum(mask, 0) * smoothstep(-0.1, 0.4, fbm(x, y, 12, 3, seed + 2) + 0.6)
    sand = np.maximum(np.maximum(bed * (1 - upper), bar), stand)
    dry = smoothstep(0.35, 0.0, fbm(x, y, 14, 3, seed + 3))
    stony = smoothstep(2.2, 0.2, bank + 1.6 * fbm(x, y, 12, 3, seed + 4)) * upper * (0.3 + 0.6 * dry)
    rock = np.maximum(maps["stone"], stony) * (1 - stand)
    low = ground - np.where(mask > 0, ground, level)
    wet = smoothstep(2.2 - 1.4 * upper, 0.1, bank) * smoothstep(0.5, 0.05, low) * (ground > -0.6)
    near_fall = smoothstep(16, 7, np.sqrt(np.square(x - 335) + np.square(y - 555)))
    cover = np.stack(
        [0.95 * sand * (1 - maps["stone"]), 0.95 * rock, 0 * x, 0.8 * np.maximum(wet, 0.8 * near_fall)], axis=-1
    )
    return np.clip(cover, 0, 1)
