"""Shadow map of scattered things (L03): how high above a place the highest of them stands on the way to the sun.

The world is slid along the sun's rays onto a level plane, so a texel is a piece of ground whatever the sun's height,
and the map's grid is fixed to the world. The square moves in large steps: while the camera stays near, it is kept.
"""

from __future__ import annotations

import math

import numpy as np

from ...level.pick import ground_at
from ...level.scatter_kinds import SCATTER
from ..frame import Frame
from ..scatter import Batch, Eye, gather
from .scatter import held

SMALLEST_M = 64.0  # side of the square; twice that, and twice again, for cameras farther off
LARGEST_M = 512.0
STEPS = 16  # parts of its side by which the square moves
MOST_SLANT = 12.0  # run over rise of the sun's rays; a lower sun throws no longer shadows
NIGHT = 0.01  # below this height the sun throws none


class PropMap:
    """A depth texture; `square` is its middle in the slid world and half its side."""

    def __init__(self, ctx, size: int) -> None:
        self.size = size
        self.texture = ctx.depth_texture((size, size))
        self.texture.compare_func = ""
        self.texture.filter = ctx.NEAREST, ctx.NEAREST
        self.texture.repeat_x = self.texture.repeat_y = False
        self.framebuffer = ctx.framebuffer(depth_attachment=self.texture)
        self.range_m = 1.0

    def release(self) -> None:
        self.framebuffer.release()
        self.texture.release()


def slant(sun: np.ndarray) -> np.ndarray:
    """Metres east and north by which a ray moves towards the sun a metre up, `(2,)`."""
    flat = math.hypot(float(sun[0]), float(sun[1]))
    run = min(flat / max(float(sun[2]), 1e-3), MOST_SLANT)
    return np.array(sun[:2], np.float64) / max(flat, 1e-6) * run


def square(frame: Frame, way: np.ndarray) -> tuple[np.ndarray, float]:
    """Middle (x, y, z) of the square on the ground that is looked at, and half its side."""
    level, position = frame.level, frame.matrices.position
    forward = -frame.matrices.view[2]
    under = float(ground_at(level, *position[:2]))
    above = max(float(position[2]) - max(under, level.sea_level_m), 1.0)
    away = above / max(-float(forward[2]), 0.12)
    side = SMALLEST_M
    while side < 1.4 * away and side < LARGEST_M:
        side *= 2
    flat = math.hypot(float(forward[0]), float(forward[1]))
    ahead = min(away * flat, 0.36 * side)
    target = position[:2] + forward[:2] / max(flat, 1e-6) * ahead
    z = level.sea_level_m
    ground = max(float(ground_at(level, *target)), z)
    step = side / STEPS  # whole texels for every size
    middle = np.round((target - way * (ground - z)) / step) * step
    return np.array([*middle, z]), side / 2


def draw(frame: Frame) -> None:
    level, kept, size = frame.level, held(frame), frame.tier.prop_shadow_size
    if "map" not in kept or kept["map"].size != size:
        if "map" in kept:
            kept["map"].release()
        kept["map"], kept["casters"] = PropMap(frame.renderer.ctx, size), kept.get("casters") or Batch(
            frame.renderer.ctx, kept["meshes"])  # fmt: skip
        kept["casters"].key = None
    made, sun = kept["map"], np.asarray(frame.uniforms["u_sun_direction"], np.float64)
    way = slant(sun)
    middle, half = square(frame, way)
    on = level.settings.scatter.on and level.settings.light.shadows and sun[2] > NIGHT
    if on and not kept["casters"].fresh(level, *(key := (frame.tier.name, *sun, *middle, half))):
        _render(frame, made, kept["casters"], middle, half, way, key)
    frame.textures["u_prop_shadow"] = made.texture
    frame.uniforms["u_prop_middle"] = (*middle, half if on else 0.0)
    frame.uniforms["u_prop_slant"] = tuple(way)
    frame.uniforms["u_prop_range"] = made.range_m
    frame.uniforms["u_prop_soft"] = frame.tier.prop_shadow_size > 512


def _render(frame: Frame, made: PropMap, batch: Batch, middle: np.ndarray, half: float, way: np.ndarray, key) -> None:
    level, ctx = frame.level, frame.renderer.ctx
    low, high = frame.renderer.uploader.bounds.range
    reach = half * 1.5 + float(np.abs(way).max()) * max(high - middle[2], middle[2] - low, 0.0)
    texel = 2 * half / made.size
    reached = {name: reach for name, kind in SCATTER.items() if casts(kind, texel, frame)}
    made.range_m = max(high - low, 1.0) + 8.0
    # a thing counts where the square, slid back to its height, holds it
    sides = [(1, 0), (-1, 0), (0, 1), (0, -1)]
    planes = np.array([(x, y, -(x * way[0] + y * way[1]), half) for x, y in sides])
    groups = gather(level, Eye(middle, planes, 0.0), frame.tier, reached)
    frame.renderer.uploader.sent["casters"] += batch.fill(level, groups, *key)
    made.framebuffer.use()
    made.framebuffer.clear(depth=1.0)
    shader = frame.shader("prop_shadow.glsl")
    for name, value in {"u_slant": tuple(way), "u_half_m": half, "u_range_m": made.range_m}.items():
        shader.program[name].value = value
    ctx.enable(ctx.DEPTH_TEST)

    def turned(kind):
        # closed things by their far side, so that no lit face shades itself; blades have two
        (ctx.disable if kind.channel == "grass" else ctx.enable)(ctx.CULL_FACE)
        return shader

    ctx.cull_face = "front"
    frame.stats["prop_shadow_triangles"], frame.stats["prop_shadow_instances"] = batch.draw(turned)
    ctx.cull_face = "back"
    ctx.disable(ctx.DEPTH_TEST | ctx.CULL_FACE)


def casts(kind, texel_m: float, frame: Frame) -> bool:
    """Whether a kind is large enough for the map's texels; grass only where there are enough of them."""
    if kind.channel == "grass":
        return frame.tier.prop_shadow_size > 512 and texel_m < 0.3 * kind.size_m[1]
    return texel_m < 1.2 * kind.size_m[1] * (0.1 if kind.along_contour else 1.0)
