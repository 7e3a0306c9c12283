"""What is drawn over the picture in the viewport: brush ring, ramp preview, texts, the passing message."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from . import sky_brush, theme
from .brush_ring import ScreenLine, along, circle, on_screen
from .camera_control import to_screen
from .editor import Editor
from .probe import Probe, speed

HIDDEN_ALPHA = 0.22


class Overlay:
    """Draws into a draw list whose viewport starts at `origin` with `size` pixels."""

    def __init__(self, editor: Editor, draw_list, origin: imgui.ImVec2, size: tuple[int, int]) -> None:
        self.editor = editor
        self.draw_list = draw_list
        self.origin = np.array([origin.x, origin.y])
        self.size = size

    def line(self, points: np.ndarray, ink: tuple, alpha: float, width: float) -> None:
        """World points (n, 3) as a line with a dark rim, faint where land hides it."""
        session = self.editor.session
        shown = on_screen(session.level, session.camera, self.size, points)
        self._pieces(shown, theme.SHADE, alpha * 0.5, width + 2)
        self._pieces(shown, ink, alpha, width)

    def _pieces(self, line: ScreenLine, ink: tuple, alpha: float, width: float) -> None:
        for hidden, factor in ((False, 1.0), (True, HIDDEN_ALPHA)):
            packed = theme.packed(ink, alpha * factor)
            for first, last in _runs(line.drawn & (line.hidden == hidden)):
                points = [imgui.ImVec2(*(p + self.origin)) for p in line.points[first : last + 1]]
                self.draw_list.add_polyline(points, packed, width, 0)

    # The brush

    def ring(self, point: tuple[float, float, float], invert: bool, smooth: bool, sky: bool = False) -> None:
        """Outer and inner circle of the brush in hand and its fall-off between them, on the ground or in the sky."""
        session = self.editor.session
        params = session.params[session.brush]
        size_m, inner_m = params.size_m, getattr(params, "inner_m", 0.0)
        ink = theme.BLUE if smooth else theme.WARM if invert else theme.INK

        def around(radius_m: float) -> np.ndarray:
            if sky:
                return sky_brush.shell_circle(session, point, radius_m)
            return circle(session.level, point[0], point[1], radius_m)

        self.line(around(size_m), ink, 0.95, 1.8)
        if size_m * 0.04 < inner_m < size_m * 0.96:
            self.line(around(inner_m), ink, 0.55, 1.1)
        for part in (1 / 3, 2 / 3):
            radius_m = size_m + (inner_m - size_m) * part
            self.line(around(radius_m), ink, 0.12 + 0.14 * part, 1)

    def ramp(self, preview: dict) -> None:
        """The ramp being dragged: middle line, edges, and beside the pointer its grade and front speed (D31)."""
        session = self.editor.session
        start, end = np.array(preview["start"][:2], float), np.array(preview["end"][:2], float)
        way = end - start
        length = float(np.hypot(*way))
        self.line(circle(session.level, *start, session.params[session.brush].size_m * 0.08, 20), theme.INK, 1, 2)
        if length > 1e-6:
            side = np.array([-way[1], way[0]]) / length * session.params[session.brush].size_m
            self.line(along(session.level, start, end), theme.INK, 1.0, 2.4)
            for edge in (side, -side):
                self.line(along(session.level, start + edge, end + edge), theme.WARM, 0.9, 1.4)
        ends = to_screen(session.camera, self.size, np.array([[*start, 0.0], [*end, 0.0]]))[0]
        self.beside_pointer(ramp_text(preview), ends[1] - ends[0])

    def beside_pointer(self, lines: list[str], away=(1.0, 1.0)) -> None:
        """Up to three short lines on a plate near the pointer, on the side `away` (pixels), inside the viewport."""
        inks = [ink for ink, text in zip((theme.INK, theme.WARM, theme.INK_FAINT), lines) if text]
        lines = [text for text in lines if text]
        if not lines:
            return
        sizes = [imgui.calc_text_size(text) for text in lines]
        width, height = max(s.x for s in sizes) + 16, sum(s.y for s in sizes) + 12 + 2 * (len(lines) - 1)
        mouse = imgui.get_mouse_pos()
        x = mouse.x + 20 if away[0] >= 0 else mouse.x - 16 - width
        y = mouse.y + 18 if away[1] >= 0 else mouse.y - 14 - height
        corner = np.clip([x, y], self.origin + 6, self.origin + self.size - (width + 6, height + 6))
        self.plate(corner, (width, height), 0.82)
        y = corner[1] + 6
        for ink, text, size in zip(inks, lines, sizes):
            self.draw_list.add_text(imgui.ImVec2(corner[0] + 8, y), theme.packed(ink), text)
            y += size.y + 2

    def plate(self, corner, size, alpha: float = 0.75) -> None:
        low, high = imgui.ImVec2(*corner), imgui.ImVec2(corner[0] + size[0], corner[1] + size[1])
        self.draw_list.add_rect_filled(low, high, theme.packed(theme.SHADE, alpha), 5)

    # Telling

    def toast(self) -> None:
        """The last message, low in the middle, while it is fresh."""
        line = self.editor.messages.toast()
        if line is None:
            return
        text = line.text if len(line.text) < 160 else line.text[:157] + "…"
        wrap = min(self.size[0] - 60, 620)
        size = imgui.calc_text_size(text, wrap_width=wrap)
        width, height = size.x + 24, size.y + 14
        corner = self.origin + np.array([(self.size[0] - width) / 2, self.size[1] - height - 18])
        self.plate(corner, (width, height), 0.85)
        ink = theme.WARM if line.bad else theme.INK
        where = imgui.ImVec2(corner[0] + 12, corner[1] + 7)
        self.draw_list.add_text(imgui.get_font(), imgui.get_font_size(), where, theme.packed(ink), text, wrap)

    def corner_text(self, text: str, ink: tuple = theme.INK_FAINT) -> None:
        """A word in the upper right corner."""
        size = imgui.calc_text_size(text)
        corner = self.origin + np.array([self.size[0] - size.x - 26, 10])
        self.plate(corner, (size.x + 16, size.y + 8), 0.55)
        self.draw_list.add_text(imgui.ImVec2(corner[0] + 8, corner[1] + 4), theme.packed(ink), text)


def ramp_text(preview: dict) -> list[str]:
    """Grade as ratio and angle, front speed, heights and length."""
    slope, (first_m, last_m) = abs(preview["grade"]), preview["heights"]
    ratio = f"1 : {1 / slope:.1f}" if slope > 1e-3 else "level"
    front = preview.get("front_speed_mps")
    told = f"wave front {speed(front)}" if front is not None else "too flat to hold a wave"
    return [
        f"{ratio}   {preview['slope_deg']:.1f}°",
        told,
        f"{first_m:.2f} m to {last_m:.2f} m over {preview['length_m']:.1f} m",
    ]


def stroke_text(probe: Probe | None) -> list[str]:
    """What brushing makes of the ground under the pointer: steeper slows a front, flatter lets it run (D31)."""
    if probe is None:
        return []
    place = f"depth {probe.depth_m:.2f} m" if probe.depth_m > 0 else f"{-probe.depth_m:.2f} m over the sea"
    front = f"wave front {speed(probe.front_mps)}" if probe.front_mps is not None else ""
    return [f"slope {probe.slope_deg:.1f}°", front, place]


def _runs(wanted: np.ndarray) -> list[tuple[int, int]]:
    """(first, last) point indices of every unbroken run of wanted pieces."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], wanted.astype(np.int8), [0]])))
    return list(zip(edges[::2], edges[1::2]))
