"""The eight ground materials (L05): tiling height, slope, roughness and albedo, made from a seed at any resolution.

ground_materials.py says what each is like; `ground_textures` makes two arrays that the renderer's `lib/ground.glsl`
reads.
"""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache

import numpy as np

from .ground_materials import MATERIALS
from .tiling import cells, comb, ripples, smooth, waves

SPAN = 6.0  # deviations of height that 0 … 1 holds


def mix(a, b, t: np.ndarray) -> np.ndarray:
    """Linear colours or fields `(rows, cols, 3)` between a and b."""
    return np.asarray(a) + (np.asarray(b) - np.asarray(a)) * np.clip(t, 0, 1)[..., None]


def _warp(size: int, seed: int, amount: float) -> tuple[np.ndarray, np.ndarray]:
    return tuple(waves(size, seed + i, 1.9, 2, 60) * amount for i in (0, 1))


def _sand(size: int, seed: int):
    grain = waves(size, seed, 0.1, 80)
    hollow = waves(size, seed + 1, 2.0, 1, 40)
    combed = smooth(-1.3, 1.1, waves(size, seed + 2, 1.8, 1, 8))
    wind = ripples(size, seed + 3, 31, 5.0, 0.9)
    fine = ripples(size, seed + 4, 52, 6.0, 0.8)
    height = (0.25 + 0.75 * combed) * wind + 0.22 * (1 - combed) * fine + 0.5 * hollow + 0.05 * grain
    # heavy dark grains gather in the troughs, shell and pale quartz lie scattered
    tint = 0.5 + 0.16 * grain + 0.14 * wind * (0.3 + 0.7 * combed) + 0.10 * hollow
    albedo = mix((0.375, 0.305, 0.215), (0.50, 0.435, 0.335), tint)
    specks = cells(size, 83, 83, seed + 5, jitter=1.0)
    speck = (1 - smooth(0.05, 0.2, specks.first - 0.1 * specks.other)) * (specks.number > 0.82)
    dark = specks.other[..., None] < 0.55
    albedo = mix(albedo, np.where(dark, (0.14, 0.11, 0.09), (0.72, 0.67, 0.58)), 0.75 * speck)
    return height, albedo, 0.9 - 0.05 * speck


def _stones(size: int, count: int, seed: int, part: float, warp):
    """Domes of one size, `part` of the cells filled: height 0 … 1 (0 where none lies), numbers."""
    stone = cells(size, count, count, seed, warp, 0.75)
    radius = 0.36 + 0.14 * stone.other
    angle = stone.number * 41.0
    along = stone.dx * np.cos(angle) + stone.dy * np.sin(angle)
    across = stone.dy * np.cos(angle) - stone.dx * np.sin(angle)
    away = np.minimum(np.hypot(along * 0.86, across * 1.22) / radius, 1.0 + 0 * along)
    inside = np.minimum(smooth(0.0, 0.16, stone.border), 1.0)
    dome = np.sqrt(np.maximum(1 - away**2.4, 0)) * inside
    return dome * (stone.number < part), stone.number / part, stone.other


def _shingle(size: int, seed: int):
    warp = _warp(size, seed, 0.004)
    height = 0.10 * waves(size, seed + 2, 1.6, 2, 60)
    colour = np.broadcast_to((0.235, 0.205, 0.165), (size, size, 3)).copy()
    colour *= (1 + 0.2 * waves(size, seed + 3, 0.2, 60))[..., None]
    grey, buff = (0.205, 0.200, 0.190), (0.36, 0.30, 0.225)
    for count, part, lift in ((62, 0.95, 0.35), (34, 0.8, 0.62), (17, 0.5, 1.15)):
        dome, number, other = _stones(size, count, seed + count, part, warp)
        top = dome * lift + 0.12 * lift
        over = (dome > 0.02) & (top > height)
        tint = mix(mix(grey, buff, number), (0.44, 0.42, 0.39), smooth(0.86, 0.92, other))
        tint = mix(tint, (0.26, 0.14, 0.09), 0.8 * smooth(0.16, 0.10, other))
        tint = tint * (0.75 + 0.4 * ((number * 17.3) % 1))[..., None]
        edge = smooth(0.02, 0.35, dome)
        colour = np.where(over[..., None], tint * (0.55 + 0.45 * edge)[..., None], colour)
        height = np.where(over, top, height)
    vein = 1 + 0.10 * waves(size, seed + 9, 0.6, 20, 400)
    return height + 0.015 * waves(size, seed + 8, 0.4, 60), colour * vein[..., None], np.full_like(height, 0.72)


def _beds(size: int, seed: int, count: int, warp: np.ndarray):
    """Layers of rock over y: how far each stands out (0 … 1), its number, the way down from its top edge (0 … 1)."""
    rng = np.random.default_rng(seed)
    thick = rng.uniform(0.35, 1.0, count) ** 2
    edges = np.concatenate([[0], np.cumsum(thick) / thick.sum()])
    hard, number = rng.random(count), rng.random(count)
    y = (np.arange(size)[:, None] / size + warp) % 1.0
    at = np.clip(np.searchsorted(edges, y.ravel(), "right").reshape(y.shape) - 1, 0, count - 1)
    within = (y - edges[at]) / (edges[at + 1] - edges[at])
    return hard[at], number[at], within


def _strata(size: int, seed: int):
    bent = 0.012 * waves(size, seed, 1.7, 1, 20) + 0.0016 * waves(size, seed + 1, 0.9, 20, 200)
    hard, number, within = _beds(size, seed + 2, 15, bent)
    thin, shade, inner = _beds(size, seed + 3, 58, bent)
    warp = _warp(size, seed + 4, 0.010)
    blocks = cells(size, 9, 19, seed + 6, warp)
    chips = cells(size, 22, 40, seed + 7, warp)
    rough = waves(size, seed + 8, 1.15, 5, 400)
    groove = 1 - np.minimum(smooth(0.0, 0.10, within), smooth(1.0, 0.86, within))
    line = 1 - np.minimum(smooth(0.0, 0.2, inner), smooth(1.0, 0.75, inner))
    joint = (1 - smooth(0.0, 0.08, blocks.border + 0.03 * rough)) * (blocks.other > 0.38)
    crack = 1 - smooth(0.0, 0.12, chips.border)
    height = 0.9 * hard + 0.22 * thin + 0.55 * blocks.number + 0.22 * chips.number + 0.26 * rough
    height -= 0.75 * groove * (1 - 0.5 * hard) + 0.14 * line + 0.6 * joint + 0.12 * crack
    albedo = mix((0.165, 0.145, 0.12), (0.335, 0.29, 0.23), 0.25 + 0.45 * number + 0.2 * shade + 0.15 * rough)
    albedo = mix(albedo, (0.33, 0.215, 0.13), 0.5 * smooth(0.72, 0.9, number) + 0.3 * smooth(0.9, 1.0, shade))
    dirt = np.clip(0.55 * groove * (1 - hard) + 0.75 * joint + 0.2 * crack + 0.12 * line, 0, 1)
    return height, mix(albedo, (0.08, 0.07, 0.058), 0.85 * dirt), 0.82 + 0.1 * dirt


def _reef(size: int, seed: int):
    warp = _warp(size, seed, 0.016)
    plates = cells(size, 5, 7, seed + 2, warp)
    lumps = cells(size, 13, 13, seed + 3, warp)
    pits = cells(size, 34, 34, seed + 4, _warp(size, seed + 5, 0.004))
    rough = waves(size, seed + 7, 1.25, 4, 400)
    crevice = 1 - smooth(0.0, 0.13, plates.border + 0.03 * rough)
    crack = 1 - smooth(0.0, 0.14, lumps.border + 0.04 * rough)
    hollow = (1 - smooth(0.16, 0.44, pits.first)) * (pits.number > 0.68)
    height = 0.7 * plates.number + 0.5 * lumps.number * (1 - lumps.first) + 0.28 * rough
    height -= 0.95 * crevice + 0.32 * crack + 0.28 * hollow
    albedo = mix((0.125, 0.115, 0.10), (0.265, 0.235, 0.19), 0.42 + 0.25 * rough + 0.3 * (lumps.number - 0.5))
    crust = smooth(0.5, 1.3, waves(size, seed + 8, 1.0, 8, 120) + 0.4 * rough)
    albedo = mix(albedo, (0.34, 0.325, 0.285), 0.5 * crust)  # barnacles
    dirt = np.clip(0.75 * crevice + 0.4 * crack + 0.25 * hollow, 0, 1)
    return height, mix(albedo, (0.085, 0.078, 0.068), 0.75 * dirt), 0.8 + 0.1 * dirt - 0.1 * hollow


def _strands(size: int, seed: int, count: int, length: float, sway: float, fine: int):
    """Blades that lean out of `count`² tufts: strands of deviation 1, the tufts' cells."""
    tuft = cells(size, count, count, seed, _warp(size, seed + 1, 0.01))
    angle = np.arctan2(tuft.dy, tuft.dx) + sway * (tuft.number - 0.5) + 0.5 * waves(size, seed + 3, 1.2, 4, 40)
    seeds = waves(size, seed + 4, -0.2, fine // 3, fine)
    return comb(seeds, np.cos(angle), np.sin(angle), length), tuft


def _grass(size: int, seed: int):
    blades, tuft = _strands(size, seed, 21, 0.016, 1.5, 260)
    under, low = _strands(size, seed + 20, 37, 0.010, 1.5, 300)
    clump = waves(size, seed + 40, 1.5, 2, 30)
    dome = np.maximum(1 - 1.2 * tuft.first, 0) * (0.35 + tuft.number)
    height = 1.5 * dome + 0.26 * blades + 0.5 * (1 - low.first) + 0.12 * under + 0.35 * clump
    tint = 0.45 + 0.20 * blades + 0.10 * under + 0.22 * (tuft.other - 0.5) + 0.25 * (dome - 0.3)
    albedo = mix((0.058, 0.066, 0.034), (0.166, 0.177, 0.100), tint)
    straw = smooth(0.9, 1.9, blades + 1.2 * (low.other - 0.5) + 0.4 * clump)
    albedo = mix(albedo, (0.30, 0.255, 0.14), 0.65 * straw)
    return height, albedo, np.full_like(height, 0.93)


def _dune(size: int, seed: int):
    blades, tuft = _strands(size, seed, 11, 0.034, 1.6, 200)
    clump = waves(size, seed + 40, 1.4, 2, 20)
    reach = 0.61 + 0.30 * (tuft.number - 0.5) + 0.10 * clump
    cover = smooth(0.12, -0.12, tuft.first - reach + 0.13 * blades)
    sand = 0.12 * ripples(size, seed + 41, 30, 5.0, 0.9) + 0.08 * waves(size, seed + 42, 1.5, 2, 60)
    height = sand + cover * (0.9 + 1.3 * np.maximum(0.7 - tuft.first, 0) + 0.36 * blades)
    ground = mix((0.375, 0.305, 0.215), (0.50, 0.435, 0.335), 0.45 + 0.15 * waves(size, seed + 43, 0.3, 40))
    green = mix((0.062, 0.072, 0.040), (0.228, 0.234, 0.130), 0.42 + 0.30 * blades + 0.3 * (tuft.other - 0.5))
    shade = smooth(0.30, 0.0, tuft.first - reach) * 0.25 * (1 - cover)
    return height, mix(ground * (1 - shade)[..., None], green, cover), 0.9 + 0.02 * cover


def _floor(size: int, seed: int):
    bars = ripples(size, seed, 17, 3.6, 1.1)
    hollow = waves(size, seed + 1, 1.8, 1, 30)
    grain = waves(size, seed + 2, 0.3, 40)
    height = bars + 0.45 * hollow + 0.05 * grain
    tint = 0.5 + 0.22 * bars + 0.12 * hollow + 0.10 * grain
    albedo = mix((0.345, 0.29, 0.21), (0.48, 0.425, 0.33), tint)
    shells = cells(size, 41, 41, seed + 3, _warp(size, seed + 4, 0.004), 1.0)
    shell = (1 - smooth(0.03, 0.17, shells.first - 0.12 * shells.other)) * (shells.number > 0.86)
    tone = np.where(shells.other[..., None] < 0.4, (0.14, 0.12, 0.10), (0.62, 0.58, 0.50))
    return height, mix(albedo, tone, 0.7 * shell), np.full_like(height, 0.9)


def _weed(size: int, seed: int):
    turn = 0.5 + 0.8 * waves(size, seed, 1.8, 1, 12)
    fronds = comb(waves(size, seed + 1, -0.2, 30, 110), np.cos(turn), np.sin(turn), 0.055, 14)
    clump = waves(size, seed + 2, 1.3, 2, 30)
    height = fronds + 0.9 * clump
    albedo = mix((0.038, 0.040, 0.018), (0.150, 0.130, 0.050), 0.42 + 0.24 * fronds + 0.12 * clump)
    return height, mix(albedo, (0.055, 0.10, 0.035), 0.5 * smooth(0.3, 1.4, clump)), np.full_like(height, 0.6)


MAKERS = (_sand, _shingle, _strata, _reef, _grass, _dune, _floor, _weed)


def material(index: int, size: int, seed: int = 7) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A layer's height (mean 0, deviation 1, which is amplitude / SPAN metres), linear albedo, roughness."""
    height, albedo, roughness = MAKERS[index](size, 1000 * seed + 100 * index)
    height = height - height.mean()
    return height / max(height.std(), 1e-9), np.clip(albedo, 0.01, 0.9), roughness


def encode(albedo: np.ndarray) -> np.ndarray:
    """Linear colour as sRGB, 0 … 1."""
    low = np.clip(albedo, 0, 1)
    return np.where(low <= 0.0031308, 12.92 * low, 1.055 * low ** (1 / 2.4) - 0.055)


@lru_cache(maxsize=1)
def ground_textures(size: int, seed: int = 7) -> np.ndarray:
    """uint8 `(2, 8, size, size, 4)`: slope east, slope north, height, roughness; and sRGB albedo, slope² / 2.

    Slopes are ±`steepest` about 0.5; slope² is their sum of squares, so that a mip level's mean of it less the square
    of its mean slope is the variance that the level lost (LEAN mapping, Olano & Baker 2010; L04).
    """
    with ThreadPoolExecutor(2) as pool:
        layers = list(pool.map(lambda index: _packed(index, size, seed), range(len(MATERIALS))))
    return np.stack(layers, 1)


def _packed(index: int, size: int, seed: int) -> np.ndarray:
    """One layer of both arrays, uint8 `(2, size, size, 4)`."""
    steepest = MATERIALS[index].steepest
    height, albedo, roughness = material(index, size, seed)
    height = np.clip(0.5 + height / SPAN, 0, 1)
    step = 2 * steepest / size
    east = np.clip((np.roll(height, -1, 1) - np.roll(height, 1, 1)) / step, -1, 1)
    north = np.clip((np.roll(height, -1, 0) - np.roll(height, 1, 0)) / step, -1, 1)
    shape = np.stack([0.5 + 0.5 * east, 0.5 + 0.5 * north, height, roughness], -1)
    colour = np.concatenate([encode(albedo), (east**2 + north**2)[..., None] / 2], -1)
    return np.round(np.clip([shape, colour], 0, 1) * 255).astype(np.uint8)
