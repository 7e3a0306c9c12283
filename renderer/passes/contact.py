"""Contact occlusion (L03): less sky on the ground at the foot of things, and on their own lower part.

A quad round each foot multiplies the share of open sky that is in the G-buffer's alpha, by how near the drawn point
lies to it; so it holds on any slope and from every camera, and things darken each other.
"""

from __future__ import annotations

import numpy as np

from ..frame import Frame
from ..scatter import CONTACT_FLOATS
from .scatter import seen_in


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


def draw(frame: Frame) -> None:
    if not frame.level.settings.scatter.on or not len(seen_in(frame).feet):
        return
    seen, ctx = seen_in(frame), frame.renderer.ctx
    if seen.discs is None:
        seen.discs = Discs(ctx)
    seen.discs.send(seen.feet)
    frame.targets.land[0].use()  # the colour stays, its alpha is multiplied
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.ZERO, ctx.ONE, ctx.ZERO, ctx.SRC_ALPHA
    seen.discs.draw(frame.shader("contact.glsl"))
    ctx.blend_func = ctx.DEFAULT_BLENDING
    ctx.disable(ctx.BLEND)
    frame.stats["contacts"] = len(seen.feet)
