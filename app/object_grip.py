"""An object held by the pointer: dropped or picked up, moved over ground and sea, turned, raised; one undo step."""

from __future__ import annotations

import numpy as np

from ..level.objects import Placed, River
from ..renderer.camera import camera_matrices
from . import placing, river_gizmo, wave_gizmo
from .camera_control import place
from .editor import Editor
from .object_markers import at_pixel
from .tools import LAKE, SELECT

HELD_PX = 3.0  # a hand is never quite still: a shorter way is a click
TURN_DEG_PER_PX = 0.5


class Grip:
    """What the left button does while an object tool is in hand."""

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self._thing: Placed | None = None
        self._how = ""
        self._lift = False
        self._pressed = (0.0, 0.0)
        self._from: tuple[float, float, float] | None = None
        self._moving = False

    def press(self, where, size, turn: bool, lift: bool) -> bool:
        """Take what is under the pointer, or drop what the tool drops; False where there is nothing to hold."""
        session = self.editor.session
        self._pressed, self._moving, self._how = where, False, "turn" if turn else "lift" if lift else "move"
        self._from = self.surface(where, size)
        if session.tool == SELECT:
            held = session.level.objects.get(session.selected)
            if isinstance(held, River):
                if turn and self._from is not None:
                    return self._more_river(held)
                handle = self._river_handle(held, size, where)
            else:
                handle = wave_gizmo.handle_at(session.level, session.camera, size, held, where)
            self._how = handle or self._how
            self._lift = lift
            session.selected = session.selected if handle else at_pixel(session.level, session.camera, size, where)
        elif session.tool == LAKE:
            if self._from is not None:
                self.editor.attempt(session.fill_water, *self._from[:2], None, turn)
            return False
        else:
            self._how = "move"
            if self._from is None:
                return False
            if not self.editor.attempt(placing.put, session, session.tool, self._from, True):
                return False
        self._thing = session.level.objects.get(session.selected)
        return self._thing is not None

    def _river_handle(self, river: River, size, where) -> str:
        """The handle of a river under the pointer; its point is the one in hand from now on."""
        session = self.editor.session
        handle = river_gizmo.handle_at(session.level, session.camera, size, river, session.river_point, where)
        session.river_point = river_gizmo.number(handle) if handle else -1
        return handle

    def _more_river(self, river: River) -> bool:
        """A point more in the river's line, or at its end; the pointer holds nothing."""
        session, (x, y, _) = self.editor.session, self._from
        if river_gizmo.beyond(river, x, y):
            self.editor.attempt(session.river_extend, river.id, x, y)
        else:
            found = self.editor.attempt(session.river_insert, river.id, x, y)
            session.river_point = -1 if found is None else found
        return False

    def drag(self, where, size) -> bool:
        """Follow the pointer; False when the object is gone or let go."""
        session, thing = self.editor.session, self._thing
        if thing is None or session.selected != thing.id or thing.id not in session.level.objects:
            return False
        way = where[0] - self._pressed[0], where[1] - self._pressed[1]
        self._moving = self._moving or np.hypot(*way) > HELD_PX
        if not self._moving:
            return True
        mean = {"turn": self._turned, "lift": self._lifted, "move": self._moved}.get(self._how, self._handled)
        values = mean(thing, way, where, size)
        if values:
            self.editor.attempt(session.alter, thing.id, values, True)
        return True

    def release(self) -> None:
        self.editor.session.seal()
        self._thing = None

    def surface(self, where, size) -> tuple[float, float, float] | None:
        """Ground or sea under a pixel."""
        session = self.editor.session
        matrices = camera_matrices(session.camera, size)
        return placing.meets_surface(session.level, matrices.position, matrices.ray(*where, size))

    # What a way of the pointer means

    def _moved(self, thing: Placed, way, where, size) -> dict:
        """Over the surface as the pointer goes, as high above it as it was."""
        now = self.surface(where, size)
        if now is None or self._from is None:
            return {}
        level = self.editor.session.level
        values = {"x": round(thing.x + now[0] - self._from[0], 2), "y": round(thing.y + now[1] - self._from[1], 2)}
        if hasattr(thing, "z") and thing.kind != "camera":
            rise = placing.surface_m(level, values["x"], values["y"]) - placing.surface_m(level, thing.x, thing.y)
            values["z"] = round(thing.z + rise, 3)
        return values

    def _turned(self, thing: Placed, way, where, size) -> dict:
        field = next((name for name in ("yaw_deg", "turn_deg") if hasattr(thing, name)), "")
        if not field:
            return {}
        return {field: round(placing.turned(getattr(thing, field), TURN_DEG_PER_PX * way[0]), 1)}

    def _handled(self, thing: Placed, way, where, size) -> dict:
        """A handle of a wave object goes where the pointer meets the surface."""
        if isinstance(thing, River) and self._lift and self._how.startswith(river_gizmo.POINT):
            return river_gizmo.lifted(thing, self._how, -way[1] * self._pixel_m(thing.x, thing.y, 0.0, size))
        now = self.surface(where, size)
        if isinstance(thing, River):
            return river_gizmo.dragged(thing, self._how, *now[:2]) if now is not None else {}
        return wave_gizmo.dragged(self.editor.session.level, thing, self._how, *now[:2]) if now is not None else {}

    def _lifted(self, thing: Placed, way, where, size) -> dict:
        """Up and down by as much as the pointer goes at the object's distance."""
        if not hasattr(thing, "z"):
            return {}
        return {"z": round(thing.z - way[1] * self._pixel_m(thing.x, thing.y, thing.z, size), 3)}

    def _pixel_m(self, x: float, y: float, z: float, size) -> float:
        """How much of the world a pixel is high at a place."""
        camera = self.editor.session.camera
        away = float(np.linalg.norm(place(camera) - (x, y, z)))
        return 2 * away * np.tan(np.radians(camera.fov_deg) / 2) / size[1]
