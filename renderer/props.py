"""Props on the GPU (D12): meshes sent once, an instance row for each prop that is seen, sent when something moved.

Where props are is asked once a moment (`placed`), for picture and shadow alike.
"""

from __future__ import annotations

import colorsys
import zlib
from dataclasses import dataclass

import numpy as np

from ..level.buoyancy import Pose, poses
from ..level.force import force_field
from ..level.meshes import Mesh, mesh_of
from ..level.objects import Prop
from .passes.force import centre
from .scatter import used

FLOATS = 16  # an instance: axes and place, three times four; colour of its view, height of the water line
ROW = ("in_east", "in_north", "in_up", "in_mark")
DRY = -1e6  # water line of what does not float
LEAST_PX = 0.7  # smaller ones are left out


@dataclass(frozen=True)
class Placed:
    """A prop at a moment."""

    prop: Prop
    mesh: Mesh
    pose: Pose

    @property
    def middle(self) -> np.ndarray:
        """World middle of its box, `(3,)`."""
        return self.pose.place + self.pose.axes @ (self.mesh.box.mean(axis=0) * self.prop.scale)

    @property
    def radius_m(self) -> float:
        """Of the ball round its middle that holds it."""
        low, high = self.mesh.box
        return 0.5 * self.prop.scale * float(np.linalg.norm(high - low))

    def row(self, origin: np.ndarray) -> np.ndarray:
        """Its instance, relative to a world place, float32 `(FLOATS,)`."""
        rows = np.empty((4, 4))
        rows[:3, :3], rows[:3, 3] = (self.pose.axes * self.prop.scale).T, self.pose.place - origin
        line = self.prop.scale * self.mesh.box[0, 2] + self.pose.draft_m if self.pose.afloat > 0 else DRY
        rows[3] = *mark(self.prop.id), line
        return rows.reshape(-1).astype(np.float32)


def mark(name: str) -> tuple[float, float, float]:
    """A colour that goes with an id."""
    return colorsys.hsv_to_rgb(zlib.crc32(name.encode()) % 997 / 997, 0.75, 0.9)


def placed(frame) -> list[Placed]:
    """Every prop at the frame's moment; none while they are off. Kept for the frame's passes, and while time rests."""
    level = frame.level
    if not level.settings.things.on or not any(isinstance(thing, Prop) for thing in level.objects.values()):
        return []
    moving = any(isinstance(thing, Prop) and thing.floats for thing in level.objects.values())
    field = force_field(level, frame.time_s, centre(frame)) if moving else None
    time_s = frame.time_s if moving else None
    key = (level.revision, level.live, level.settings, time_s, field and (field.first, field.time_s))
    kept = frame.renderer.kept.get("placed")
    if kept is None or kept[0] is not level.layers or kept[1] != key:
        things = sorted((o for o in level.objects.values() if isinstance(o, Prop)), key=lambda o: o.id)
        where = poses(level, frame.time_s, field)
        found = [Placed(thing, mesh_of(level, thing), where[thing.id]) for thing in things]
        kept = frame.renderer.kept["placed"] = (level.layers, key, found)
    return kept[2]


class Buffers:
    """Vertices and triangles of meshes in use, and one instance buffer for each user of each mesh."""

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.meshes: dict[int, tuple] = {}
        self.instances: dict[tuple, object] = {}
        self.arrays: dict[tuple, object] = {}

    def keep(self, things: list[Placed]) -> int:
        """Hold what these props show and let others go; returns the bytes sent."""
        wanted = {id(thing.mesh): thing.mesh for thing in things}
        for key in [key for key in self.meshes if key not in wanted]:
            self._let_go(key)
        new = [key for key in wanted if key not in self.meshes]
        for key in new:
            mesh = wanted[key]
            packed = np.column_stack([mesh.vertices, mesh.normals, mesh.colours]).astype(np.float32)
            buffers = self.ctx.buffer(packed.tobytes()), self.ctx.buffer(mesh.triangles.tobytes())
            self.meshes[key] = (mesh, *buffers, packed.nbytes + mesh.triangles.nbytes)
        return sum(self.meshes[key][3] for key in new)

    def draw(self, user: str, shader, things: list[Placed], origin: np.ndarray, before=None) -> tuple[int, int]:
        """Draw props; `before(mesh)` is called ahead of each mesh. Returns triangles and instances."""
        groups: dict[int, list[Placed]] = {}
        for thing in things:
            groups.setdefault(id(thing.mesh), []).append(thing)
        triangles = 0
        for key, group in groups.items():
            mesh = self.meshes[key][0]
            rows = np.stack([thing.row(origin) for thing in group])
            self._send(user, key, rows)
            if before:
                before(mesh)
            self._array(user, key, shader).render(instances=len(group))
            triangles += len(mesh.triangles) * len(group)
        return triangles, len(things)

    def _send(self, user: str, key: int, rows: np.ndarray) -> None:
        buffer = self.instances.get((user, key))
        if buffer is None:
            buffer = self.instances[user, key] = self.ctx.buffer(reserve=max(rows.nbytes, 1024), dynamic=True)
        if rows.nbytes > buffer.size:
            buffer.orphan(2 * rows.nbytes)
        buffer.write(rows.tobytes())

    def _array(self, user: str, key: int, shader):
        at = user, key, id(shader), shader.generation
        if at not in self.arrays:
            _, vertices, indices, _ = self.meshes[key]
            content = [
                (vertices, *used(shader, "3f4 3f4 3f4", ("in_position", "in_normal", "in_colour"))),
                (self.instances[user, key], *used(shader, "4f4 4f4 4f4 4f4/i", ROW)),
            ]  # fmt: skip
            self.arrays[at] = self.ctx.vertex_array(shader.program, content, indices, index_element_size=4)
        return self.arrays[at]

    def _let_go(self, key: int) -> None:
        for held in (self.arrays, self.instances):
            for at in [at for at in held if at[1] == key]:
                held.pop(at).release()
        for buffer in self.meshes.pop(key)[1:3]:
            buffer.release()

    def release(self) -> None:
        for key in list(self.meshes):
            self._let_go(key)


def buffers(frame, name: str = "props") -> Buffers:
    """Those of a renderer, of that name."""
    kept = frame.renderer.kept.setdefault("prop_buffers", {})
    return kept.get(name) or kept.setdefault(name, Buffers(frame.renderer.ctx))


def seen(things: list[Placed], position: np.ndarray, planes: np.ndarray | None, pixel: float) -> list[Placed]:
    """Those whose ball has a part inside every plane `(n, 4)` over places relative to `position`, and some pixels."""
    found = []
    for thing in things:
        middle, radius = thing.middle - position, thing.radius_m
        if planes is not None and (planes[:, :3] @ middle + planes[:, 3] < -radius).any():
            continue
        if 2 * radius >= LEAST_PX * pixel * max(float(np.linalg.norm(middle)) - radius, 0.0):
            found.append(thing)
    return found
