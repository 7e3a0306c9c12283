"""Markers of placed objects over the picture: a disc with the kind's glyph, its foot, what the chosen one reaches."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from ..level.objects import Placed, River
from . import river_gizmo, theme, wave_gizmo
from .brush_ring import hidden_by_land
from .camera_control import to_screen
from .object_markers import Marker, at_pixel, heading, outlines, shown
from .tools import BRUSH, FRONT, SELECT, TOOLS
from .viewport_overlay import Overlay

DISC_PX = 11.0
HIDDEN_ALPHA = 0.35
HEADING_M = 6.0
HANDLE_PX = 5.0


class MarkerOverlay:
    """Draws with an `Overlay`; nothing while the brush is in hand and no object is selected."""

    def __init__(self, overlay: Overlay) -> None:
        self.overlay = overlay
        self.session = overlay.editor.session

    def draw(self, where: tuple[float, float] | None) -> None:
        """`where` is the pointer in the viewport, None outside."""
        session, size = self.session, self.overlay.size
        if session.tool == BRUSH and session.selected not in session.level.objects:
            return
        found = shown(session.level, session.camera, size)
        if session.tool == BRUSH:
            found = [(marker, pixel) for marker, pixel in found if marker.id == session.selected]
        pointed = at_pixel(session.level, session.camera, size, where) if where and session.tool == SELECT else ""
        for name in dict.fromkeys((session.selected, pointed)):
            self._reach(name, name == session.selected)
        if found:
            places = np.array([marker.place for marker, _ in found])
            hidden = hidden_by_land(session.level, session.camera, places)
            for (marker, pixel), behind in zip(found, hidden, strict=True):
                self._marker(marker, pixel + self.overlay.origin, bool(behind), marker.id == pointed)
        if where and session.tool not in (BRUSH, SELECT, FRONT):
            row = TOOLS[session.tool]
            self.overlay.beside_pointer([f"{theme.icon(row.glyph)}  {row.title}"])

    def _reach(self, name: str, chosen: bool) -> None:
        thing = self.session.level.objects.get(name)
        if thing is None:
            return
        ink = theme.ACCENT_BRIGHT if chosen else theme.INK
        for line in outlines(self.session.level, thing):
            self.overlay.line(line, ink, 0.85 if chosen else 0.5, 1.6)
        self._waves(thing, ink, chosen)
        way = (
            heading(self.session.level, thing, HEADING_M)
            if chosen and not isinstance(thing, wave_gizmo.KINDS)
            else None
        )
        if way is not None:
            self.overlay.line(way, ink, 0.9, 2.0)

    def _waves(self, thing: Placed, ink: tuple, chosen: bool) -> None:
        """Fronts, rings and arrow of a wave object or region; handles of the chosen one."""
        session = self.session
        for line in wave_gizmo.lines(session.level, thing, session.clock.time_s):
            self.overlay.line(line.points, ink, line.alpha * (1.0 if chosen else 0.6), line.width)
        held = chosen and session.tool == SELECT
        found = wave_gizmo.handles(session.level, thing) if held else {}
        if isinstance(thing, River):
            for points, alpha, width in river_gizmo.lines(session.level, thing):
                self.overlay.line(points, ink, alpha * (1.0 if chosen else 0.6), width)
            found = river_gizmo.handles(session.level, thing, session.river_point) if held else {}
        if not found:
            return
        pixels, ahead = to_screen(session.camera, self.overlay.size, np.array(list(found.values())))
        for pixel in pixels[ahead] + self.overlay.origin:
            self.overlay.draw_list.add_circle_filled(imgui.ImVec2(*pixel), HANDLE_PX, theme.packed(theme.SHADE, 0.8))
            self.overlay.draw_list.add_circle(imgui.ImVec2(*pixel), HANDLE_PX, theme.packed(ink, 0.95), 0, 1.8)

    def _marker(self, marker: Marker, at: np.ndarray, behind: bool, pointed: bool) -> None:
        chosen = marker.id == self.session.selected
        alpha = HIDDEN_ALPHA if behind and not (chosen or pointed) else 1.0
        draw_list, ink = self.overlay.draw_list, theme.ACCENT_BRIGHT if chosen else theme.INK
        self._foot(marker, at, ink, alpha)
        centre = imgui.ImVec2(*at)
        fill = theme.ACCENT_DEEP if chosen else theme.SHADE
        draw_list.add_circle_filled(centre, DISC_PX, theme.packed(fill, 0.85 * alpha))
        draw_list.add_circle(centre, DISC_PX, theme.packed(ink, (0.95 if chosen or pointed else 0.55) * alpha), 0, 1.5)
        glyph = theme.icon(marker.glyph) or marker.id[:1]
        size = imgui.calc_text_size(glyph)
        place = imgui.ImVec2(at[0] - size.x / 2, at[1] - size.y / 2)
        draw_list.add_text(place, theme.packed(theme.INK, alpha), glyph)
        if chosen or pointed:
            self._name(marker.id, at)

    def _foot(self, marker: Marker, at: np.ndarray, ink: tuple, alpha: float) -> None:
        """A thread down to the surface from what hangs over it, or up from what lies under it."""
        pixels, ahead = to_screen(self.session.camera, self.overlay.size, np.array([marker.foot]))
        foot = pixels[0] + self.overlay.origin
        if not ahead[0] or np.hypot(*(foot - at)) < DISC_PX + 3:
            return
        way = (foot - at) / np.hypot(*(foot - at))
        start = imgui.ImVec2(*(at + way * DISC_PX))
        self.overlay.draw_list.add_line(start, imgui.ImVec2(*foot), theme.packed(ink, 0.6 * alpha), 1.2)
        self.overlay.draw_list.add_circle_filled(imgui.ImVec2(*foot), 2.5, theme.packed(ink, 0.8 * alpha))

    def _name(self, name: str, at: np.ndarray) -> None:
        size = imgui.calc_text_size(name)
        corner = at + np.array([DISC_PX + 5, -size.y / 2 - 3])
        self.overlay.plate(corner, (size.x + 12, size.y + 6), 0.78)
        place = imgui.ImVec2(corner[0] + 6, corner[1] + 3)
        self.overlay.draw_list.add_text(place, theme.packed(theme.INK), name)
