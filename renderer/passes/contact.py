"""Contact occlusion (L03): less sky on the ground at the foot of things, and on their own lower part.

A quad round each foot multiplies the share of open sky that is in the G-buffer's alpha, by how near the drawn point
lies to it; so it holds on any slope and from every camera, and things darken each other.
"""

from __future__ import annotations

import numpy as np

from ...level.pick import ground_at
from ..frame import Frame
from ..props import placed
from ..scatter import CONTACT_FLOATS
from .scatter import seen_in

DARK = 0.6  # of the foot of a prop
LEAST_PX = 3.0


class Discs:
    """The instance buffer and its vertex arrays."""

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.buffer = ctx.buffer(reserve=4096 * CONTACT_FLOATS, dynamic=True)
        self.arrays: dict[tuple, object] = {}
        self.rows: np.ndarray | None = None

    def send(self, rows: np.ndarray) -> None:
        """Feet of things, float32 `(n, CONTACT_FLOATS)`; nothing is sent twice."""
        if rows is self.rows:
            return
        if rows.nbytes > self.buffer.size:
            self.buffer.orphan(2 * rows.nbytes)
        self.buffer.write(rows.tobytes())
        self.rows = rows

    def draw(self, shader) -> None:
        key = id(shader), shader.generation
        if key not in self.arrays:
            content = [(self.buffer, "4f4 4f4 2f4/i", "in_foot", "in_shape", "in_normal")]
            self.arrays[key] = self.ctx.vertex_array(shader.program, content)
        self.arrays[key].render(self.ctx.TRIANGLE_STRIP, vertices=4, instances=len(self.rows))

    def release(self) -> None:
        for thing in (*self.arrays.values(), self.buffer):
            thing.release()


def prop_feet(frame: Frame) -> np.ndarray:
    """Feet of props that stand or lie on the ground, float32 `(n, CONTACT_FLOATS)`."""
    rows = []
    for thing in placed(frame):
        low, high = thing.mesh.box * thing.prop.scale
        axes, half = thing.pose.axes, (high - low) / 2
        foot = thing.pose.place + axes @ np.array([*(low + half)[:2], low[2]])
        radius, long = 0.9 * half[:2].min(), 0.85 * abs(half[1] - half[0])
        near = foot - frame.matrices.position
        small = radius < LEAST_PX * frame.uniforms["u_pixel_angle"] * np.linalg.norm(near)
        if small or thing.pose.afloat > 0 or abs(float(ground_at(frame.level, *foot[:2])) - foot[2]) > 0.3 * radius:
            continue
        way = axes[:2, 1 if half[1] > half[0] else 0]
        way = way / max(float(np.linalg.norm(way)), 1e-6)
        rows.append((*near, radius, *way, long, DARK, *axes[:2, 2]))
    return np.array(rows, np.float32).reshape(-1, CONTACT_FLOATS)


def draw(frame: Frame) -> None:
    seen, ctx = seen_in(frame), frame.renderer.ctx
    feet = seen.feet if frame.level.settings.scatter.on else seen.feet[:0]
    props = prop_feet(frame)
    feet = np.concatenate([feet, props]) if len(props) else feet
    if not len(feet):
        return
    if seen.discs is None:
        seen.discs = Discs(ctx)
    seen.discs.send(feet)
    frame.targets.land[0].use()  # the colour stays, its alpha is multiplied
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.ZERO, ctx.ONE, ctx.ZERO, ctx.SRC_ALPHA
    seen.discs.draw(frame.shader("contact.glsl"))
    ctx.blend_func = ctx.DEFAULT_BLENDING
    ctx.disable(ctx.BLEND)
    frame.stats["contacts"] = len(feet)
