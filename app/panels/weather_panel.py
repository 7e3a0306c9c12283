"""The weather map as a panel: looked at at every stage, painted on, skies with a name beside it (T04, Z04, Z05)."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
from imgui_bundle import imgui

from ...level.weather import STAGES, weather_at
from .. import sky_brush, theme
from ..editor import Editor
from ..map_sight import Sight
from ..param_widgets import tooltip
from . import weather_marks, weather_paint

LEFT, RIGHT, MIDDLE = 0, 1, 2
TEXELS = 128
LEAST_S = 0.1  # between two drawings of the map while only time goes on
LEAST_PX, MOST_PX = 220, 560
LEGEND = (("cloud", (1.0, 0.42, 0.42)), ("rain", (0.45, 0.95, 0.45)), ("type", (0.55, 0.62, 1.0)))
STAGE_DOC = {
    "simulated": "What the simulation makes with its bias.",
    "painted": "With the paint over it.",
    "horizon": "With the horizon's own sky far away.",
    "final": "What the clouds are made of: rain pulled towards thunderheads.",
}
_FLAGS = imgui.ButtonFlags_
BUTTONS = _FLAGS.mouse_button_left | _FLAGS.mouse_button_right | _FLAGS.mouse_button_middle


class WeatherPanel:
    """Draws itself into the current imgui window; `mode` is what a pressed button does: "", stroke, pan, dead."""

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self.sight: Sight | None = None  # None: the whole map about the camera
        self.stage = "final"
        self.mode = ""
        self.button = LEFT
        self.corner = (0.0, 0.0)  # screen pixels, for whoever drives the window
        self.texture = None
        self._key: tuple = ()
        self._drawn_at = -1e9
        self._below_px = 0.0  # what stands below the map, in the last frame

    def draw(self, ctx) -> None:
        """`ctx` is the window's OpenGL context."""
        room = imgui.get_content_region_avail()
        # as large as what stands below leaves it, so that nothing scrolls; not too small to paint on
        side = float(int(min(max(min(room.x, room.y - self._below_px), min(room.x, LEAST_PX)), MOST_PX)))
        self.sight = replace(self.sight or self._round_camera(), side=side)
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + max(room.x - side, 0) // 2)
        self._map(ctx, side)
        top = imgui.get_cursor_pos_y()
        self._controls()
        weather_paint.draw(self.editor)
        self._below_px = imgui.get_cursor_pos_y() - top

    def release(self) -> None:
        if self.texture is not None:
            self.texture.release()
            self.texture = None

    def _round_camera(self) -> Sight:
        camera = self.editor.session.camera
        return Sight(camera.x, camera.y)

    # The map

    def _map(self, ctx, side: float) -> None:
        origin, size = imgui.get_cursor_screen_pos(), imgui.ImVec2(side, side)
        self.corner = (origin.x, origin.y)
        imgui.invisible_button("###weather_map", size, BUTTONS)
        hovered = imgui.is_item_hovered() or imgui.is_item_active()
        imgui.set_item_key_owner(imgui.Key.mouse_wheel_y)
        self._pointer(origin, hovered)
        self._refresh(ctx)
        draw_list, end = imgui.get_window_draw_list(), imgui.ImVec2(origin.x + side, origin.y + side)
        draw_list.push_clip_rect(origin, end, True)
        texture = imgui.ImTextureRef(self.texture.glo)
        draw_list.add_image(texture, origin, end, imgui.ImVec2(0, 1), imgui.ImVec2(1, 0))
        weather_marks.draw(self.editor, self.sight, origin, ring=self.mode != "pan")
        draw_list.pop_clip_rect()

    def _refresh(self, ctx) -> None:
        """Draw the map anew when the level, the view or, not too often, time changed."""
        session, sight = self.editor.session, self.sight
        camera = session.camera
        level = session.level
        key = (id(level), level.revision, sight, self.stage, camera.x, camera.y, camera.id), session.clock.time_s
        now = time.monotonic()
        early = now - self._drawn_at < LEAST_S
        if self.texture is not None and (key == self._key or (key[0] == self._key[0] and early)):
            return
        values = weather_at(level, key[1], *sight.grid(TEXELS), (camera.x, camera.y), self.stage, camera.id)
        pixels = (np.clip(values[..., :3], 0, 1) * 255 + 0.5).astype(np.uint8)  # the talk's channels: R, G, B
        if self.texture is None:
            self.texture = ctx.texture((TEXELS, TEXELS), 3, alignment=1)
            self.texture.filter = ctx.LINEAR, ctx.LINEAR
        self.texture.write(pixels.tobytes(), alignment=1)
        self._key, self._drawn_at = key, now

    # The pointer

    def _pointer(self, origin, hovered: bool) -> None:
        io, mouse = imgui.get_io(), imgui.get_mouse_pos()
        where = (mouse.x - origin.x, mouse.y - origin.y)
        self.editor.map_pointer = None
        if not (hovered or self.mode) or not imgui.is_mouse_pos_valid():
            return
        x, y = self.sight.world(*where)
        self.editor.map_pointer = (x, y, self.editor.session.level.settings.clouds.base_m)
        if not self.mode:
            self._press(io, x, y)
            if io.mouse_wheel and not self.mode:
                self.sight = self.sight.zoomed(*where, io.mouse_wheel)
        if self.mode == "stroke":
            self._stroke(x, y)
        elif self.mode == "pan":
            self.sight = self.sight.panned(io.mouse_delta.x, io.mouse_delta.y)
        if self.mode and not imgui.is_mouse_down(self.button):
            if self.mode == "stroke":
                self.editor.attempt(self.editor.session.stroke_end)
            self.mode = ""

    def _press(self, io, x: float, y: float) -> None:
        pressed = [button for button in (LEFT, RIGHT, MIDDLE) if imgui.is_mouse_clicked(button)]
        if not pressed:
            return
        self.button, session = pressed[0], self.editor.session
        if self.button != LEFT:
            self.mode = "pan"
            return
        if not sky_brush.in_hand(session):
            session.pick_brush(sky_brush.NAME)
        if imgui.is_key_down(imgui.Key.p):
            self.editor.attempt(sky_brush.take, session, x, y)
            self.mode = "dead"
            return
        done = self.editor.attempt(sky_brush.press, session, x, y, io.key_ctrl, io.key_shift)
        self.mode = "dead" if done is None else "stroke"

    def _stroke(self, x: float, y: float) -> None:
        session = self.editor.session
        if session.stroke is None or not session.stroke.open:
            self.mode = "dead"  # Esc or an undo ended it
            session.stroke_abort()
        else:
            self.editor.attempt(sky_brush.drag, session, x, y)

    # Beside it

    def _controls(self) -> None:
        imgui.set_next_item_width(100)
        changed, number = imgui.combo("###weather_stage", STAGES.index(self.stage), [s.capitalize() for s in STAGES])
        if changed:
            self.stage = STAGES[number]
        tooltip(f"Which step of the map is shown. {STAGE_DOC[self.stage]}")
        imgui.same_line()
        if imgui.button(theme.titled("expand", "Whole map", "weather_whole")):
            self.sight = None
        tooltip("All of the map about the camera. The wheel zooms to the pointer, the middle or right button moves it.")
        imgui.same_line()
        imgui.begin_group()
        for number, (word, ink) in enumerate(LEGEND):
            if number:
                imgui.same_line(0, 5)
            imgui.align_text_to_frame_padding()
            imgui.text_colored(theme.colour(ink), word)
        imgui.end_group()
        tooltip(
            "Colours of the map: red is coverage, green precipitation, blue the type from stratus to cumulus; black is"
            " a clear sky. Left paints, Ctrl and Shift as with every brush; P+left takes the weather under the pointer"
            " as the brush's target."
        )
