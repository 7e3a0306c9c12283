"""What is drawn while fronts are shaped: the crest, the line it is brought to, the circle, what is forbidden (T07)."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from . import theme
from .brush_ring import circle
from .camera_control import to_screen
from .front_drag import FrontDrag
from .front_tool import FrontTool
from .viewport_overlay import Overlay

LIFT_M = 0.15
MOST_POINTS = 160


class ShapeOverlay:
    """Draws through the viewport's overlay."""

    def __init__(self, overlay: Overlay, tool: FrontTool) -> None:
        self.overlay = overlay
        self.tool = tool
        self.session = overlay.editor.session

    def draw(self) -> None:
        held = self.tool.drag_now
        if held is not None:
            self._held(held)
        elif self.tool.crest is not None:
            self._line(self.tool.crest, theme.ACCENT, 0.95, 2.6)
            if self.session.cursor:
                self._ring(self.session.cursor[:2], 0.5)

    def _held(self, held: FrontDrag) -> None:
        self._line(held.crest, theme.INK, 0.35, 1.4)
        self._ring(held.grabbed, 0.9)
        if held.shaped is None:
            self._line(held.crest, theme.ACCENT, 0.95, 2.6)
        else:
            line = held.shaped.line
            self._line(line, theme.ACCENT, 0.95, 2.6)
            for short in held.shaped.forbidden:
                self._line(line[short.first : short.last + 1], theme.RED, 1.0, 3.6)
                self._text(line[(short.first + short.last) // 2], short.text)
        if held.settling:
            self.overlay.beside_pointer(["updating…"])
        elif held.refused:
            self.overlay.beside_pointer([held.refused])
        elif held.shaped is not None and len(held.shaped.change):
            change = held.shaped.change
            self.overlay.beside_pointer([f"bed {change.min():+.2f} to {change.max():+.2f} m"])

    def _line(self, line: np.ndarray, ink: tuple, alpha: float, width: float) -> None:
        """World points (n, 2) on the still sea."""
        if len(line) < 2:
            return
        line = line[np.unique(np.linspace(0, len(line) - 1, MOST_POINTS).astype(int))]
        height = np.full((len(line), 1), self.session.level.sea_level_m + LIFT_M)
        self.overlay.line(np.concatenate([line, height], axis=1), ink, alpha, width)

    def _ring(self, at, alpha: float) -> None:
        ring = circle(self.session.level, *at, self.session.front.radius_m)
        ring[:, 2] = np.maximum(ring[:, 2], self.session.level.sea_level_m + LIFT_M)
        self.overlay.line(ring, theme.INK, alpha, 1.4)

    def _text(self, at: np.ndarray, text: str) -> None:
        """A red sentence beside a world point."""
        point = np.array([[at[0], at[1], self.session.level.sea_level_m + LIFT_M]])
        pixels, ahead = to_screen(self.session.camera, self.overlay.size, point)
        if not ahead[0]:
            return
        size = imgui.calc_text_size(text)
        corner = self.overlay.origin + pixels[0] + (10, -size.y - 8)
        self.overlay.plate(corner, (size.x + 12, size.y + 6), 0.7)
        where = imgui.ImVec2(corner[0] + 6, corner[1] + 3)
        self.overlay.draw_list.add_text(where, theme.packed(theme.RED), text)
