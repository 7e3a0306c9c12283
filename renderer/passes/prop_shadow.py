"""Shadow map of things (L03, D12): how high above a place the highest of them stands on the way to the sun.

The world is slid along the sun's rays onto a level plane, so a texel is a piece of ground whatever the sun's height,
and the map's grid is fixed to the world. Two squares lie side by side in one texture: a small one before the camera,
a large one round it. They move in large steps: while the camera stays near, they are kept. What floats is drawn
anew into a copy of them.
"""

from __future__ import annotations

import math

import numpy as np

from ...level.pick import ground_at
from ...level.scatter_kinds import SCATTER
from ..frame import Frame
from ..props import buffers, placed
from ..scatter import Batch, Eye, gather
from .prop_casters import Copy, cast, looks, planes, reached
from .scatter import meshes, recent

SMALLEST_M = 64.0  # side of the large square; twice that, and twice again, for cameras farther off
LARGEST_M = 512.0
NEAR = 0.25  # side of the small square, in large ones
STEPS = 16  # parts of its side by which a square moves
MOST_SLANT = 12.0  # run over rise of the sun's rays; a lower sun throws no longer shadows
BLADES_M = 0.02  # blades are drawn so much lower, and a texel
NIGHT = 0.01  # below this height the sun throws none


class PropMap:
    """A depth texture, two squares wide, and what was drawn into each; a copy of it is made when something floats."""

    def __init__(self, frame: Frame) -> None:
        ctx, self.size = frame.renderer.ctx, frame.tier.prop_shadow_size
        self.ctx = ctx
        self.still = self.framebuffer()
        self.copy: Copy | None = None
        self.batches = [Batch(ctx, meshes(frame)) for _ in range(2)]
        self.props: list[tuple] = [(), ()]
        self.range_m = 1.0

    def framebuffer(self):
        texture = self.ctx.depth_texture((2 * self.size, self.size))
        texture.compare_func = ""
        texture.filter = self.ctx.NEAREST, self.ctx.NEAREST
        texture.repeat_x = texture.repeat_y = False
        return self.ctx.framebuffer(depth_attachment=texture)

    @property
    def textures(self) -> list:
        return [target.depth_attachment for target in (self.still, self.copy and self.copy.target) if target]

    def release(self) -> None:
        for thing in (*self.batches, self.still.depth_attachment, self.still, *filter(None, [self.copy])):
            thing.release()


def slant(sun: np.ndarray) -> np.ndarray:
    """Metres east and north by which a ray moves towards the sun a metre up, `(2,)`."""
    flat = math.hypot(float(sun[0]), float(sun[1]))
    run = min(flat / max(float(sun[2]), 1e-3), MOST_SLANT)
    return np.array(sun[:2], np.float64) / max(flat, 1e-6) * run


def squares(frame: Frame, way: np.ndarray) -> np.ndarray:
    """Middle x, y, z of both squares in the slid world and half their side, near and far, `(2, 4)`."""
    level, position = frame.level, frame.matrices.position
    forward = -frame.matrices.view[2]
    # water hides what lies deep in it; without water the floor is ground as any other
    least = 0.0 if level.settings.water.on else -math.inf

    def over_sea(xy: np.ndarray) -> float:
        return max(float(ground_at(level, *xy)) - level.mean_sea_m, least)

    above = max(float(position[2]) - level.mean_sea_m - over_sea(position[:2]), 1.0)
    away = above / max(-float(forward[2]), 0.12)  # to the ground that is looked at
    side = SMALLEST_M
    while side < 1.4 * away and side < LARGEST_M:
        side *= 2
    flat = math.hypot(float(forward[0]), float(forward[1]))
    found = []
    for part, most in ((NEAR, 0.36 * NEAR * side + 0.6 * above), (1.0, 0.36 * side)):
        target = position[:2] + forward[:2] / max(flat, 1e-6) * min(away * flat, most)
        step = part * side / STEPS  # whole texels
        middle = np.round((target - way * over_sea(target)) / step) * step
        found.append((*middle, level.mean_sea_m, part * side / 2))
    return np.array(found)


def tallest_m(frame: Frame) -> float:
    """How far the ground is from the still sea at most, which is the middle of the map's heights."""
    low, high = frame.renderer.uploader.bounds.range
    sea_m = frame.level.mean_sea_m
    return float(max(high - sea_m, sea_m - low, 1.0))


def draw(frame: Frame) -> None:
    level, made = frame.level, recent(frame, PropMap, frame.tier.name)
    sun = np.asarray(frame.uniforms["u_sun_direction"], np.float64)
    way = slant(sun)
    found = squares(frame, way)
    lit = level.settings.light.shadows and sun[2] > NIGHT
    things = placed(frame) if lit else []
    frame.renderer.uploader.sent["props"] += buffers(frame).keep(things) if things else 0
    high = max((abs(thing.middle[2] - level.mean_sea_m) + thing.radius_m for thing in things), default=0.0)
    range_m = 2.0 ** math.ceil(math.log2(max(tallest_m(frame) + 8.0 * max(level.settings.scatter.size, 1.0), high)))
    on = lit and (level.settings.scatter.on or bool(things))
    for index, (batch, square) in enumerate(zip(made.batches, found, strict=True)):
        still = reached([thing for thing in things if not thing.prop.floats], square, way, made.size)
        key = frame.tier.name, *sun, *square, range_m, level.settings.scatter.on
        if on and not (batch.fresh(level, *key) and made.props[index] == looks(still, square)):
            made.range_m, made.props[index] = range_m, looks(still, square)
            _render(frame, made, index, square, way, key)
            cast(frame, made.still, index, square, _shader(frame, square, way, range_m, PROP=""), still)
            if made.copy:
                made.copy.stale = made.copy.whole
    texture = made.still.depth_attachment
    if on:
        texture = _floating(frame, made, found, way, [thing for thing in things if thing.prop.floats]) or texture
    found[:, 3] *= on
    frame.textures["u_prop_shadow"] = texture
    frame.uniforms["u_prop_squares"] = found.astype(np.float32)
    frame.uniforms["u_prop_slant"] = tuple(way)
    frame.uniforms["u_prop_range"] = range_m
    frame.uniforms["u_prop_soft"] = made.size > 512


def _floating(frame: Frame, made: PropMap, found: np.ndarray, way: np.ndarray, things: list):
    """The map with what floats in it; None where nothing does."""
    groups = [reached(things, square, way, made.size) for square in found]
    if not any(groups):
        return None
    made.copy = made.copy or Copy(made.framebuffer(), made.size)
    made.copy.restore(frame, made.still.depth_attachment)
    for index, (square, near) in enumerate(zip(found, groups, strict=True)):
        cast(frame, made.copy.target, index, square, _shader(frame, square, way, made.range_m, PROP=""), near)
        made.copy.cover(index, square, way, near)
    return made.copy.target.depth_attachment


def _render(frame: Frame, made: PropMap, index: int, square: np.ndarray, way: np.ndarray, key: tuple) -> None:
    """Scattered things into one square, which is cleared first."""
    level, ctx, batch = frame.level, frame.renderer.ctx, made.batches[index]
    half = float(square[3])
    reach = 1.5 * half + math.hypot(1.0, *way) * tallest_m(frame)
    far = {name: reach for name, kind in SCATTER.items() if casts(kind, 2 * half / made.size, frame)}
    on = level.settings.scatter.on
    groups = gather(level, Eye(square[:3], planes(square, way), 0.0), frame.tier, far) if on else {}
    frame.renderer.uploader.sent["casters"] += batch.fill(level, groups, *key)
    place = (index * made.size, 0, made.size, made.size)
    made.still.use()
    made.still.viewport = place
    made.still.clear(depth=1.0, viewport=place)
    shader = _shader(frame, square, way, made.range_m)
    lower_m = BLADES_M + 2 * half / made.size

    def turned(kind):
        # closed things by their far side, so that no lit face shades itself; blades have two, and lie lower for it
        blades = kind.channel == "grass"
        (ctx.disable if blades else ctx.enable)(ctx.CULL_FACE)
        shader.program["u_lower_m"].value = lower_m if blades else 0.0
        return shader

    ctx.enable(ctx.DEPTH_TEST)
    ctx.cull_face = "front"
    triangles, instances = batch.draw(turned)
    ctx.cull_face = "back"
    ctx.disable(ctx.DEPTH_TEST | ctx.CULL_FACE)
    stats = frame.stats
    stats["prop_shadow_triangles"] = stats.get("prop_shadow_triangles", 0) + triangles
    stats["prop_shadow_instances"] = stats.get("prop_shadow_instances", 0) + instances


def _shader(frame: Frame, square: np.ndarray, way: np.ndarray, range_m: float, **defines: str):
    shader = frame.shader("prop_shadow.glsl", **defines)
    for name, value in {"u_slant": tuple(way), "u_half_m": float(square[3]), "u_range_m": range_m}.items():
        shader.program[name].value = value
    return shader


def casts(kind, texel_m: float, frame: Frame) -> bool:
    """Whether a kind is large enough for the map's texels; grass only where there are enough of them."""
    if kind.channel == "grass":
        return frame.tier.prop_shadow_size > 512 and texel_m < 0.3 * kind.size_m[1]
    return texel_m < 1.2 * kind.size_m[1] * (0.1 if kind.along_contour else 1.0)
