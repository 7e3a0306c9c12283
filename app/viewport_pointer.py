"""The pointer in the viewport: strokes with the left button, camera with the others.

Left: brush (Ctrl inverts, Shift smooths), or the tool in hand (object_grip.py, front_tool.py). L+left: the sun.
With the weather brush the left button works on the sky; P+left takes the weather there as the brush's target.
Alt+left or middle: orbit. Shift+middle or Alt+middle: pan. Alt+right: dolly. Right held: look round and fly with
W A S D Q E, Shift faster; the wheel then sets the speed, else it zooms to the pointer.
"""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from ..level.pick import pick_ray
from ..level.pick_sky import pick_sky
from ..renderer.camera import camera_matrices
from . import camera_control as control
from . import sky_brush
from .editor import Editor
from .front_tool import FrontTool
from .object_grip import Grip
from .tools import BRUSH, FRONT

LEFT, RIGHT, MIDDLE = 0, 1, 2
FLY = {name: getattr(imgui.Key, name) for name in control.FLY_KEYS}
FASTER = 4.0


class Pointer:
    """What the pressed buttons mean until released.

    `mode` is "", stroke, take, object, front, sun, orbit, pan, dolly, fly, dead.
    """

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self.mode = ""
        self.button = LEFT
        self.grip = Grip(editor)
        self.front = FrontTool(editor)
        self._pivot: np.ndarray | None = None
        self._picked: tuple = (None, None)
        self._picked_sky: tuple = (None, None)

    # Once a frame

    def update(self, origin: imgui.ImVec2, size: tuple[int, int], hovered: bool) -> None:
        """Take in a frame's mouse; `origin` is the viewport's corner, `size` its pixels."""
        io, mouse = imgui.get_io(), imgui.get_mouse_pos()
        where = (mouse.x - origin.x, mouse.y - origin.y)
        valid = imgui.is_mouse_pos_valid()
        if (hovered or self.mode) and valid:
            self.editor.session.cursor = self._pick(where, size)
            self.editor.session.sky_cursor = self._pick_sky(where, size)
        elif not self.mode:
            self.editor.session.cursor = self.editor.session.sky_cursor = None
        free = hovered and valid and not self.mode and not imgui.is_mouse_clicked(LEFT)  # a press looks by itself
        self.front.hover(self.grip.surface(where, size) if free else None)
        if not self.mode and hovered and valid:
            self._press(io, where, size)
            if io.mouse_wheel and not self.mode:
                self._zoom(where, size, io.mouse_wheel)
        if self.mode:
            self._drag(io, where, size)
            if not imgui.is_mouse_down(self.button):
                self._release()
        self.editor.flying = self.mode == "fly"

    def _press(self, io, where, size) -> None:
        pressed = [button for button in (LEFT, RIGHT, MIDDLE) if imgui.is_mouse_clicked(button)]
        if not pressed:
            return
        self.button = pressed[0]
        alt = io.key_alt
        if self.button == LEFT:
            work = {BRUSH: "stroke", FRONT: "front"}.get(self.editor.session.tool, "object")
            work = "take" if imgui.is_key_down(imgui.Key.p) and sky_brush.in_hand(self.editor.session) else work
            self.mode = "sun" if imgui.is_key_down(imgui.Key.l) else "orbit" if alt else work
        elif self.button == MIDDLE:
            self.mode = "pan" if io.key_shift or alt else "orbit"
        else:
            self.mode = "dolly" if alt else "fly"
        session = self.editor.session
        if self.mode == "stroke":
            self._begin_stroke(io)
        elif self.mode == "take":
            self._take()
        elif self.mode == "front":
            self.mode = "front" if self.front.press(self.grip.surface(where, size), io.key_shift) else "dead"
        elif self.mode == "object":
            self.mode = "object" if self.grip.press(where, size, io.key_ctrl, io.key_shift) else "dead"
        else:
            self._pivot = control.pivot_ahead(session.level, session.camera, session.cursor)

    def _release(self) -> None:
        if self.mode == "stroke":
            self.editor.attempt(self.editor.session.stroke_end)
        elif self.mode == "front":
            self.front.release()
        elif self.mode == "object":
            self.grip.release()
        elif self.mode == "sun":
            self.editor.session.seal()
        self.mode = ""

    # Strokes

    def _begin_stroke(self, io) -> None:
        session = self.editor.session
        sky = sky_brush.in_hand(session)
        point = session.sky_cursor if sky else session.cursor
        if point is None:
            self.mode = "dead"
            return
        x, y, _ = point
        if sky:
            done = self.editor.attempt(sky_brush.press, session, x, y, io.key_ctrl, io.key_shift)
        else:
            done = self.editor.attempt(session.stroke_begin, x, y, 1.0, io.key_ctrl, io.key_shift)
        if done is None:
            self.mode = "dead"

    def _take(self) -> None:
        """The eyedropper: the weather that is pointed at becomes the brush's target."""
        session, self.mode = self.editor.session, "dead"
        if session.sky_cursor is not None:
            self.editor.attempt(sky_brush.take, session, *session.sky_cursor[:2])

    def _move_stroke(self) -> None:
        session = self.editor.session
        if session.stroke is None or not session.stroke.open:
            self.mode = "dead"  # Esc or an undo ended it: nothing until the button is let go
            session.stroke_abort()
        elif session.stroke.brush.layer == sky_brush.NAME:
            if session.sky_cursor is not None:
                self.editor.attempt(sky_brush.drag, session, *session.sky_cursor[:2])
        elif session.cursor is not None:
            x, y, _ = session.cursor
            last = session.stroke.samples[-1] if session.stroke.samples else None
            if last is None or (last.x, last.y) != (x, y):
                self.editor.attempt(session.stroke_move, x, y)

    # Camera

    def _drag(self, io, where, size) -> None:
        if self.mode == "stroke":
            self._move_stroke()
            return
        if self.mode == "front":
            if not self.front.drag(self.grip.surface(where, size)):
                self.mode = "dead"
            return
        if self.mode == "object":
            if not self.grip.drag(where, size):
                self.grip.release()
                self.mode = "dead"
            return
        delta = io.mouse_delta
        if self.mode == "sun":
            if delta.x or delta.y:
                self.editor.turn_sun(delta.x, delta.y)
            return
        camera, level = self.editor.session.camera, self.editor.session.level
        if self.mode == "fly":
            camera = self._fly(io, camera, delta)
        elif not (delta.x or delta.y):
            return
        elif self.mode == "orbit":
            camera = control.orbit(camera, self._pivot, delta.x, delta.y)
        elif self.mode == "pan":
            camera = control.pan(camera, self._pivot, delta.x, delta.y, size)
        elif self.mode == "dolly":
            camera = control.zoom(camera, self._pivot, (delta.x - delta.y) * 0.05)
        if camera is not self.editor.session.camera:
            self.editor.move_camera(control.above_ground(level, camera))

    def _fly(self, io, camera, delta):
        preferred = self.editor.preferences
        if delta.x or delta.y:
            camera = control.turn(camera, delta.x, delta.y)
        if io.mouse_wheel:
            preferred.fly_speed_mps = min(max(preferred.fly_speed_mps * 1.2**io.mouse_wheel, 0.5), 900.0)
        level = self.editor.session.level
        speed = control.fly_speed_mps(level, camera, preferred.fly_speed_mps) * (FASTER if io.key_shift else 1.0)
        held = {name for name, key in FLY.items() if imgui.is_key_down(key)}
        return control.fly(camera, held, min(io.delta_time, 0.1), speed)

    def _zoom(self, where, size, notches: float) -> None:
        session = self.editor.session
        point = session.cursor
        if point is None:
            ray = camera_matrices(session.camera, size).ray(*where, size)
            point = control.place(session.camera) + ray * max(session.level.grid.extent_m) * 0.25
        camera = control.zoom(session.camera, point, notches)
        self.editor.move_camera(control.above_ground(session.level, camera))

    # Picking

    def _pick(self, where, size) -> tuple[float, float, float] | None:
        """The ground under a pixel; while a stroke runs past the border, the plane it left off at goes on."""
        session = self.editor.session
        key = (where, size, session.camera, id(session.level), session.level.layer_revision("height"))
        if self._picked[0] == key:
            return self._picked[1]
        matrices = camera_matrices(session.camera, size)
        ray = matrices.ray(*where, size)
        point = pick_ray(session.level, matrices.position, ray)
        on_ground = self.mode == "stroke" and not sky_brush.in_hand(session)
        if point is None and on_ground and session.cursor is not None:
            point = _on_plane(matrices.position, ray, session.cursor[2]) or session.cursor
        self._picked = key, point
        return point

    def _pick_sky(self, where, size) -> tuple[float, float, float] | None:
        """The clouds' shell under a pixel, while a brush for it is in hand."""
        session = self.editor.session
        if not sky_brush.in_hand(session):
            return None
        clouds = session.level.settings.clouds
        key = (where, size, session.camera, id(session.level), session.level.layer_revision("height"), clouds)
        if self._picked_sky[0] != key:
            matrices = camera_matrices(session.camera, size)
            self._picked_sky = key, pick_sky(session.level, matrices.position, matrices.ray(*where, size))
        return self._picked_sky[1]


def _on_plane(origin: np.ndarray, ray: np.ndarray, height_m: float) -> tuple[float, float, float] | None:
    """Where a ray meets a level plane before it, not absurdly far away."""
    if abs(ray[2]) < 1e-3:
        return None
    distance = (height_m - origin[2]) / ray[2]
    if not 0 < distance < 50_000:
        return None
    x, y, z = origin + ray * distance
    return float(x), float(y), float(z)
