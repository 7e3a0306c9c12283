"""Contact occlusion (L03): less sky on the ground at the foot of things, and on their own lower part.

A quad round each foot multiplies the share of open sky that is in the G-buffer's alpha, by how near the drawn point
lies to it; so it holds on any slope and from every camera, and things darken each other.
"""

from __future__ import annotations

from ..frame import Frame
from ..scatter import CONTACT_FLOATS


class Discs:
    """The instance buffer and its vertex arrays."""

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.buffer = ctx.buffer(reserve=4096 * CONTACT_FLOATS, dynamic=True)
        self.arrays: dict[tuple, object] = {}

    def send(self, data: bytes) -> None:
        if len(data) > self.buffer.size:
            self.buffer.orphan(2 * len(data))
        self.buffer.write(data)

    def draw(self, shader, count: int) -> None:
        key = id(shader), shader.generation
        if key not in self.arrays:
            content = [(self.buffer, "4f4 4f4 2f4/i", "in_foot", "in_shape", "in_normal")]
            self.arrays[key] = self.ctx.vertex_array(shader.program, content)
        self.arrays[key].render(self.ctx.TRIANGLE_STRIP, vertices=4, instances=count)

    def release(self) -> None:
        for thing in (*self.arrays.values(), self.buffer):
            thing.release()


def draw(frame: Frame) -> None:
    kept = frame.renderer.kept.get("scatter", {})
    contacts = kept.get("contacts")
    if not frame.level.settings.scatter.on or contacts is None or not len(contacts.rows):
        return
    ctx = frame.renderer.ctx
    if "discs" not in kept:
        kept["discs"] = Discs(ctx)
    if not contacts.sent:
        kept["discs"].send(contacts.rows.tobytes())
        contacts.sent = True
    frame.targets.land[0].use()  # the colour stays, its alpha is multiplied
    ctx.enable(ctx.BLEND)
    ctx.blend_func = ctx.ZERO, ctx.ONE, ctx.ZERO, ctx.SRC_ALPHA
    kept["discs"].draw(frame.shader("contact.glsl"), len(contacts.rows))
    ctx.blend_func = ctx.DEFAULT_BLENDING
    ctx.disable(ctx.BLEND)
    frame.stats["contacts"] = len(contacts.rows)
