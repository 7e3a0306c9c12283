"""Shadows of meshes from files (D12) in the map of prop_shadow.py.

What stands lies in the kept map; what floats is drawn each time into a copy of it, of which only the part that it
covered is put right again.
"""

from __future__ import annotations

import math

import numpy as np

from ..frame import Frame
from ..props import Placed, buffers, seen

LOWER_M = 0.02  # a mesh without an inside is drawn so much lower, and a texel


def planes(square: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Sides `(4, 4)` of a square in the slid world: a thing counts where it, slid back to its height, holds it."""
    sides = np.array([
        (x, y, -(x * way[0] + y * way[1]), float(square[3])) for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
    ])  # fmt: skip
    return sides / np.linalg.norm(sides[:, :3], axis=1, keepdims=True)


def reached(things: list[Placed], square: np.ndarray, way: np.ndarray, size: int) -> list[Placed]:
    """Those that the square holds and that are larger than a texel."""
    large = [thing for thing in things if thing.radius_m > float(square[3]) / size]
    return seen(large, square[:3], planes(square, way), 0.0)


def looks(things: list[Placed], square: np.ndarray) -> tuple:
    """What tells two drawings of things into a square apart."""
    return tuple((id(thing.mesh), thing.row(square[:3]).tobytes()) for thing in things)


def cast(frame: Frame, target, index: int, square: np.ndarray, shader, things: list[Placed]) -> None:
    """Draw things into one square of a map, by their far sides where they have an inside."""
    if not things:
        return
    ctx, size = frame.renderer.ctx, target.height
    target.use()
    target.viewport = (index * size, 0, size, size)

    def before(mesh) -> None:
        (ctx.enable if mesh.closed else ctx.disable)(ctx.CULL_FACE)
        shader.program["u_lower_m"].value = 0.0 if mesh.closed else LOWER_M + 2 * float(square[3]) / size

    ctx.enable(ctx.DEPTH_TEST)
    ctx.cull_face = "front"
    triangles, count = buffers(frame).draw(f"shadow {index}", shader, things, square[:3], before)
    ctx.cull_face = "back"
    ctx.disable(ctx.DEPTH_TEST | ctx.CULL_FACE)
    frame.stats["prop_caster_triangles"] = frame.stats.get("prop_caster_triangles", 0) + triangles
    frame.stats["prop_casters"] = frame.stats.get("prop_casters", 0) + count


class Copy:
    """A map besides the kept one, with what floats in it; `stale` are rectangles (x, y, width, height) to put right."""

    def __init__(self, target, size: int) -> None:
        self.target = target
        self.whole = [(0, 0, 2 * size, size)]
        self.stale = self.whole

    def restore(self, frame: Frame, source) -> None:
        """Make it what the kept map is, where it differs."""
        ctx, shader = frame.renderer.ctx, frame.renderer.programs.get("copy_depth.glsl")
        self.target.use()
        self.target.viewport = self.whole[0]
        source.use(0)
        shader.program["u_source"].value = 0
        ctx.enable(ctx.DEPTH_TEST)
        ctx.depth_func = "1"  # always
        for part in self.stale:
            self.target.scissor = part
            shader.fullscreen()
        self.target.scissor = None
        ctx.depth_func = "<"
        ctx.disable(ctx.DEPTH_TEST)
        self.stale = []

    def cover(self, index: int, square: np.ndarray, way: np.ndarray, things: list[Placed]) -> None:
        """Remember what things cover in a square."""
        size = self.target.height
        for thing in things:
            middle = thing.middle - square[:3]
            at = (middle[:2] - way * middle[2]) / float(square[3])
            reach = thing.radius_m * (1 + math.hypot(*way)) / float(square[3])
            low = np.clip(np.floor((at - reach + 1) / 2 * size) - 1, 0, size).astype(int)
            high = np.clip(np.ceil((at + reach + 1) / 2 * size) + 1, 0, size).astype(int)
            if (high > low).all():
                self.stale.append((int(low[0]) + index * size, int(low[1]), *(int(v) for v in high - low)))

    def release(self) -> None:
        self.target.depth_attachment.release()
        self.target.release()
