"""Shadow map of the land: worked out when height, sun or size change, kept otherwise.

A change of the ground can only shade what lies behind it, seen from the sun: then a strip of the map is worked out
again, to the same bytes as all of it.
"""

from __future__ import annotations

import math
from functools import reduce

import numpy as np

from ...level import Rect
from ..frame import Frame

SUN_RADIUS_RAD = 0.00465
KEPT = 2  # maps of different sizes: what moves and what stands still may differ in tier
WHOLE = np.array([(-1, -1), (1, -1), (-1, 1), (1, 1)], np.float32)
WORTH = 0.6  # of the map's side: a wider strip isn't


class ShadowMap:
    """Three RG32F maps: the finished one and two that take turns."""

    def __init__(self, ctx, size: tuple[int, int]) -> None:
        self.size = size
        self.textures = [ctx.texture(size, 2, dtype="f4") for _ in range(3)]
        for texture in self.textures:
            texture.filter = ctx.LINEAR, ctx.LINEAR
            texture.repeat_x = texture.repeat_y = False
        self.framebuffers = [ctx.framebuffer([texture]) for texture in self.textures]
        self.key: tuple = ()
        self.revision = 0

    @property
    def texture(self):
        return self.textures[0]

    @property
    def rounds(self) -> int:
        """Doublings until a texel knows all of the map."""
        return max(math.ceil(math.log2(max(self.size))), 1)

    def release(self) -> None:
        for thing in (*self.framebuffers, *self.textures):
            thing.release()


def draw(frame: Frame) -> None:
    grid, light = frame.level.grid, frame.level.settings.light
    shadow = _map(frame)
    cell_m = grid.extent_m[0] / (shadow.size[0] - 1)
    sun = tuple(float(v) for v in frame.uniforms["u_sun_direction"])
    key = frame.renderer.uploader.wholes, sun
    if light.shadows:
        changed = frame.level.changed_since("height", shadow.revision) if shadow.key == key else [grid.rect]
        if changed:
            _march(frame, shadow, cell_m, reduce(Rect.union, changed))
        shadow.key, shadow.revision = key, frame.level.revision
    frame.textures["u_shadow"] = shadow.texture
    frame.uniforms["u_shadow_cell_m"] = cell_m
    frame.uniforms["u_shadow_spread"] = SUN_RADIUS_RAD / max(1.0 - sun[2] ** 2, 0.05)


def _map(frame: Frame) -> ShadowMap:
    """The map of this frame's size, made when there is none."""
    grid, kept = frame.level.grid, frame.renderer.kept.setdefault("shadows", {})
    scale = min(frame.tier.shadow_size / max(grid.cols, grid.rows), 1.0)
    size = max(round(grid.cols * scale), 2), max(round(grid.rows * scale), 2)
    shadow = kept.pop(size, None) or ShadowMap(frame.renderer.ctx, size)
    kept[size] = shadow  # the last one is the one used last
    for old in list(kept)[:-KEPT]:
        kept.pop(old).release()
    return shadow


def _march(frame: Frame, shadow: ShadowMap, cell_m: float, changed: Rect) -> None:
    extent = frame.level.grid.extent_m
    east, north, up = (float(v) for v in frame.uniforms["u_sun_direction"])
    flat = math.hypot(east, north)
    if flat < 1e-3:
        east, north, flat = 0.0, 1.0, 1e-3  # at the zenith nothing throws a shadow
    step = np.array([east / flat * cell_m / extent[0], north / flat * cell_m / extent[1]])
    outer, inner, share = _strip(shadow, frame.level.grid.shape, step, changed)
    for index in range(shadow.rounds + 1):
        reach = 1 if index == 0 else 2 ** (index - 1)
        last = index == shadow.rounds
        shader = frame.shader("shadow.glsl", **({"START": ""} if index == 0 else {"SPREAD": ""}))
        values = {
            "u_step_uv": tuple(step * reach),
            "u_step_m": cell_m * reach,
            "u_rise_m": cell_m * reach * float(up / flat),
        }
        for name, value in values.items():
            shader.program[name].value = value
        if index == 0:
            shader.program["u_target"].value = tuple(float(side) for side in shadow.size)
        shader.program["u_corners"].write((inner if last else outer).astype("f4").tobytes())
        target = 0 if last else 1 + index % 2
        shadow.framebuffers[target].use()
        shader.strip()
        frame.textures["u_shadow"] = shadow.textures[target]
    frame.stats["shadow_rounds"] = shadow.rounds + 1
    frame.stats["shadow_share"] = share


def _strip(shadow: ShadowMap, shape: tuple[int, int], step_uv: np.ndarray, changed: Rect):
    """Corners (4, 2) in clip space of what must be worked out and of what may differ; the share of the map's side.

    The outer strip runs along the sun's way over the whole map; the inner one begins at the change and leaves out
    the outer one's sides, which know too little: each round reads one texel beside the way.
    """
    size = np.array(shadow.size, np.float64)
    scale = (size - 1) / (np.array(shape[::-1]) - 1)
    low = np.array([changed.col0 - 1, changed.row0 - 1]) * scale
    high = np.array([changed.col1, changed.row1]) * scale
    corners = np.array([(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])])
    towards = step_uv * (size - 1)
    towards /= np.linalg.norm(towards)
    beside = np.array([-towards[1], towards[0]])
    pad = shadow.rounds + 3.0
    first, last = (corners @ beside).min() - pad, (corners @ beside).max() + pad
    begin, beyond = (corners @ towards).max() + pad, 2.0 * size.sum()
    if last - first + 2 * pad > WORTH * min(shadow.size):
        return WHOLE, WHOLE, 1.0

    def quad(left: float, right: float, near: float) -> np.ndarray:
        points = [near * towards + left * beside, near * towards + right * beside,
                  -beyond * towards + left * beside, -beyond * towards + right * beside]  # fmt: skip
        return (np.array(points) + 0.5) / size * 2 - 1

    return quad(first - pad, last + pad, beyond), quad(first, last, begin), (last - first + 2 * pad) / min(shadow.size)
