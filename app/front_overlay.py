"""Over the picture, what belongs to the fronts on the water (T06): seconds on isochrones, a reading, the legend."""

from __future__ import annotations

import numpy as np
from imgui_bundle import imgui

from ..level.crests import Line
from ..level.speed_ramp import BREAKERS, ISOCHRONE, moment_colour, ramp_colour
from . import theme
from .brush_ring import circle, hidden_by_land
from .camera_control import to_screen
from .viewport_overlay import Overlay

MOST_LABELS = 28
LEAST_PX = 70.0  # a line that is shorter on the screen gets no label
APART_PX = 16.0
STEPS = 48  # of the ramp's bar
BREAK_RING_M = 1.2


def draw(overlay: Overlay, pointing: bool) -> None:
    """All of it, where overlays of the timing are on."""
    editor = overlay.editor
    fronts, session = editor.fronts, editor.session
    if not fronts.shown or "water" not in session.show:
        return
    labels(overlay, fronts.isochrones(session))
    legend(overlay)
    reading = fronts.reading(session) if pointing else None
    if reading is None:
        return
    if reading.next.breaks_after_s is not None:
        overlay.line(circle(session.level, *reading.next.at, BREAK_RING_M), theme.WARM, 0.9, 1.6)
    overlay.beside_pointer(reading.lines)


def labels(overlay: Overlay, lines: list[Line]) -> None:
    """Seconds where a line has its middle on the screen, long lines first, none on another."""
    taken: list[tuple[float, float, float]] = []
    for pixel, text in label_places(overlay, lines):
        size = imgui.calc_text_size(text)
        if any(abs(pixel[0] - x) < 0.5 * (size.x + w) + 6 and abs(pixel[1] - y) < APART_PX for x, y, w in taken):
            continue
        taken.append((pixel[0], pixel[1], size.x))
        corner = overlay.origin + pixel - (0.5 * size.x, 0.5 * size.y)
        overlay.plate(corner - (4, 1), (size.x + 8, size.y + 2), 0.6)
        overlay.draw_list.add_text(imgui.ImVec2(*corner), theme.packed(ISOCHRONE), text)
        if len(taken) == MOST_LABELS:
            return


def label_places(overlay: Overlay, lines: list[Line]) -> list[tuple[np.ndarray, str]]:
    """(pixel, text) of each line that is long enough on the screen, longest first."""
    session = overlay.editor.session
    if not lines:
        return []
    sea_m, counts = session.level.sea_level_m, [len(line.points) for line in lines]
    points = np.concatenate([line.points for line in lines])
    points = np.concatenate([points, np.full((len(points), 1), sea_m)], axis=1)
    pixels, ahead = to_screen(session.camera, overlay.size, points)
    inside = ahead & (pixels > 12).all(1) & (pixels < np.array(overlay.size) - 12).all(1)
    found, first = [], 0
    for line, count in zip(lines, counts):
        shown = np.flatnonzero(inside[first : first + count]) + first
        first += count
        if len(shown) < 2:
            continue
        length = float(np.hypot(*np.diff(pixels[shown], axis=0).T).sum())
        if length > LEAST_PX:
            found.append((length, shown[len(shown) // 2], f"{line.value:g} s"))
    found = sorted(found, key=lambda row: -row[0])[: 3 * MOST_LABELS]
    if not found:
        return []
    hidden = hidden_by_land(session.level, session.camera, points[[row[1] for row in found]])
    return [(pixels[row[1]], row[2]) for row, behind in zip(found, hidden) if not behind]


def legend(overlay: Overlay) -> None:
    """What lines and colours mean, in the lower right corner."""
    fronts, session = overlay.editor.fronts, overlay.editor.session
    rows: list[tuple[str, tuple | None]] = []
    if fronts.on["crests"]:
        rows.append(("crest now", moment_colour(0)))
        if fronts.ghosts:
            step_s = fronts.step_s(session)
            told = f"{step_s:.2g} s" if fronts.ghosts == 1 else f"{step_s:.2g} … {fronts.ghosts * step_s:.2g} s"
            rows += [(f"{told} before", moment_colour(-1)), (f"{told} later", moment_colour(1))]
    if fronts.on["isochrones"]:
        rows.append((f"arrival, every {fronts.every_s:g} s", ISOCHRONE))
    if fronts.on["breakers"]:
        rows += [(f"breaks, {name}", colour) for name, colour in BREAKERS.items()]
    if fronts.on["speed"]:
        rows.append((f"0          {fronts.fastest_mps:g} m/s", None))
    if fronts.updating:
        rows.append(("updating…", theme.WARM))
    _plate(overlay, rows)


def _plate(overlay: Overlay, rows: list[tuple[str, tuple | None]]) -> None:
    line_px = imgui.get_font_size() + 4
    width = max(imgui.calc_text_size(text).x for text, _ in rows) + 48
    width, height = max(width, 150), line_px * (len(rows) + sum(colour is None for _, colour in rows)) + 10
    corner = overlay.origin + np.array([overlay.size[0] - width - 10, overlay.size[1] - height - 10])
    overlay.plate(corner, (width, height), 0.7)
    x, y = corner[0] + 8, corner[1] + 5
    for text, colour in rows:
        if colour is None:
            ramp_bar(overlay.draw_list, x, y + 2, width - 16, line_px - 4)
            y += line_px
            ends = ("0", text.split(maxsplit=1)[1])
            right = x + width - 16 - imgui.calc_text_size(ends[1]).x
            for at, word in zip((x, right), ends):
                overlay.draw_list.add_text(imgui.ImVec2(at, y), theme.packed(theme.INK), word)
        else:
            middle = y + 0.5 * imgui.get_font_size()
            low, high = imgui.ImVec2(x, middle - 2), imgui.ImVec2(x + 22, middle + 2)
            overlay.draw_list.add_rect_filled(low, high, theme.packed(tuple(colour)), 1)
            overlay.draw_list.add_text(imgui.ImVec2(x + 32, y), theme.packed(theme.INK), text)
        y += line_px


def ramp_bar(draw_list, x: float, y: float, width: float, height: float) -> None:
    """The colours of speed from slow to fast."""
    for n, rgb in enumerate(ramp_colour((np.arange(STEPS) + 0.5) / STEPS)):
        low, high = imgui.ImVec2(x + width * n / STEPS, y), imgui.ImVec2(x + width * (n + 1) / STEPS + 0.5, y + height)
        draw_list.add_rect_filled(low, high, theme.packed(tuple(float(v) for v in rgb)))
