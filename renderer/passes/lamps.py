"""Point lights on everything in the G-buffer, land and sea alike: a rectangle of the screen for each (D01).

A lamp costs the pixels within its radius, whatever they show: the sea is one more layer of the G-buffer. What lies
under water is lit in the plate that it is seen through (H12), at half size, before the water is drawn.
"""

from __future__ import annotations

import numpy as np

from ...level.loop import moment
from ...level.objects import PointLight
from ..frame import Frame

MOST = 256  # the nearest ones
UNSEEN = 0.002  # of the daylight: less light on the bed than that is not looked for
FLOATS = 12  # rectangle (left, low, right, high), camera-relative place and radius, power and nothing


def visible(frame: Frame, over: float = 0.0) -> np.ndarray:
    """Rows of FLOATS for the lamps that can be seen, the nearest first, float32 `(n, FLOATS)`.

    With `over` klx, times the sky's unit, none reaches farther than it is that bright.
    """
    matrices, rows, loop_s = frame.matrices, [], frame.level.settings.time.loop_s
    for lamp in frame.level.objects.values():
        if not isinstance(lamp, PointLight) or lamp.power_kcd <= 0:
            continue
        place = np.array(lamp.place(moment(frame.time_s, loop_s), loop_s)) - matrices.position
        power = lamp.power_kcd * np.array([lamp.red, lamp.green, lamp.blue]) * frame.renderer.sky.light.unit
        radius_m = min(lamp.radius_m, float(np.sqrt(power.max() / over))) if over > 0 else lamp.radius_m
        box = screen_box(matrices, place, radius_m)
        if box is not None:
            rows.append((*box, *place, radius_m, *power, 0.0))
    table = np.array(rows, np.float32).reshape(-1, FLOATS)
    return table[np.argsort((table[:, 4:7] ** 2).sum(axis=1), kind="stable")[:MOST]]


def screen_box(matrices, place: np.ndarray, radius_m: float) -> tuple[float, float, float, float] | None:
    """The rectangle of clip space that holds a sphere at a camera-relative place; None where it isn't seen."""
    depth = float(place @ -matrices.view[2])
    if depth < -radius_m:
        return None
    if depth <= radius_m * 1.01:  # the camera may be in it
        return -1.0, -1.0, 1.0, 1.0
    ends = []
    for axis in (matrices.ray_x, matrices.ray_y):
        half = float(np.linalg.norm(axis))
        off = float(place @ axis) / half
        # tangents from the eye to the circle that the sphere is in this plane
        root = radius_m * np.sqrt(max(off**2 + depth**2 - radius_m**2, 0.0))
        slopes = (np.array([-root, root]) + off * depth) / (depth**2 - radius_m**2)
        ends.append(np.clip(slopes / half + np.array([-0.01, 0.01]), -1, 1))
    (left, right), (low, high) = ends
    return (left, low, right, high) if left < right and low < high else None


class Lamps:
    """The instances on the GPU."""

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.buffer = ctx.buffer(reserve=4 * FLOATS * MOST, dynamic=True)
        self.arrays: dict[tuple, object] = {}  # by program

    def draw(self, shader, table: np.ndarray) -> None:
        self.buffer.write(np.ascontiguousarray(table).tobytes())
        key = id(shader), shader.generation
        if key not in self.arrays:
            content = [(self.buffer, "4f 4f 4f/i", "in_box", "in_place", "in_power")]
            self.arrays[key] = self.ctx.vertex_array(shader.program, content)
        self.arrays[key].render(self.ctx.TRIANGLE_STRIP, vertices=4, instances=len(table))

    def release(self) -> None:
        for thing in (*self.arrays.values(), self.buffer):
            thing.release()


def lamps(frame: Frame) -> Lamps:
    return frame.renderer.kept.get("lamps") or frame.renderer.kept.setdefault("lamps", Lamps(frame.renderer.ctx))


def draw_under(frame: Frame) -> int:
    """Add the lamps' light to plate A, the target in use; returns how many there are."""
    light, up = frame.renderer.sky.light, max(float(frame.uniforms["u_sun_direction"][2]), 0.0)
    table = visible(frame, UNSEEN * float(light.on_level(up).max()))
    if len(table):
        ctx = frame.renderer.ctx
        shader = frame.shader("lamps.glsl", UNDER="")
        ctx.enable(ctx.BLEND)
        ctx.blend_func = ctx.DST_ALPHA, ctx.ONE, ctx.ZERO, ctx.ONE  # a plate's colour is premultiplied by its weight
        lamps(frame).draw(shader, table)
        ctx.disable(ctx.BLEND)
    return len(table)


def draw(frame: Frame) -> None:
    if frame.view.scene == "lamps":
        frame.targets.hdr.use()
        frame.targets.hdr.clear()
    table = visible(frame)
    frame.stats["lamps"] = len(table)
    if not len(table):
        return
    ctx = frame.renderer.ctx
    frame.targets.hdr.use()
    shader = frame.shader("lamps.glsl")
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.ONE, ctx.ONE
    lamps(frame).draw(shader, table)
    ctx.disable(ctx.BLEND)
