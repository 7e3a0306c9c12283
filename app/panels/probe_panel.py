"""Height of the water over time at the level's probes, the present moment marked; crest times to a file (T06)."""

from __future__ import annotations

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, implot

from .. import theme
from ..actions import ACTIONS
from ..editor import Editor
from ..param_widgets import tooltip
from ..probe_record import ProbeRecord
from ..time_edits import wave_s

INKS = (theme.BLUE, theme.WARM, theme.ACCENT_BRIGHT, (0.86, 0.50, 0.88), (0.90, 0.85, 0.45), theme.RED)
LEAST_PX, MOST_PX = 150.0, 420.0
WAVES = 5  # shown at most, to either side of now


def line_spec(rgb, alpha: float = 1.0, weight: float = 1.6) -> implot.Spec:
    """How a line of a plot looks."""
    return implot.Spec(line_color=ImVec4(*rgb, alpha), line_weight=weight)


class ProbePanel:
    """Keeps how much time it shows, and what it has worked out."""

    def __init__(self) -> None:
        self.waves = 2
        self.record = ProbeRecord()
        self.drawn = 0  # lines in the last frame

    def draw(self, editor: Editor) -> None:
        session = editor.session
        self._tools(editor)
        self.drawn = 0
        if not any(thing.kind == "probe" for thing in session.level.objects.values()):
            imgui.text_wrapped("A probe tells the height of the water at a point over time. Drop one in the sea.")
            return
        now, reach_s = session.clock.time_s, self.waves * wave_s(session)
        first, last = max(now - reach_s, 0.0), now + reach_s
        self.record.update(session.level, first, last)
        times, heights = self.record.lines(first, last)
        self._plot(times, heights, now, (now - reach_s, last))
        self._values(heights, times, now)

    def _tools(self, editor: Editor) -> None:
        for name, glyph, title in (("tool.probe", "crosshairs", "Drop a probe"), ("events", "file_export", "Export")):
            action = ACTIONS[name]
            imgui.begin_disabled(not action.enabled(editor.session))
            if imgui.button(theme.titled(glyph, title, f"probes_{name}")):
                editor.do(action)
            imgui.end_disabled()
            told = "Click in the viewport drops one." if name == "tool.probe" else "Crest times at all probes, as JSON."
            tooltip(told)
            imgui.same_line()
        imgui.set_next_item_width(-imgui.FLT_MIN)
        _, self.waves = imgui.slider_int("###probe_waves", self.waves, 1, WAVES, "±%d waves")
        tooltip("How much time is shown before and after now.")

    def _plot(self, times: np.ndarray, heights: np.ndarray, now: float, span: tuple[float, float]) -> None:
        room = imgui.get_content_region_avail().y - imgui.get_text_line_height_with_spacing() * (len(heights) + 1)
        size = ImVec2(-1, min(max(room, LEAST_PX), MOST_PX))
        if not implot.begin_plot("###probes", size, implot.Flags_.no_menus | implot.Flags_.no_mouse_text):
            return
        implot.setup_axes("s", "m")
        implot.setup_axis_limits(implot.ImAxis_.x1, *span, imgui.Cond_.always)
        if np.isfinite(heights).any():
            low, high = float(np.nanmin(heights)), float(np.nanmax(heights))
            spare = 0.1 * max(high - low, 0.2)
            implot.setup_axis_limits(implot.ImAxis_.y1, low - spare, high + 3 * spare, imgui.Cond_.always)
        implot.setup_legend(implot.Location_.north_west, implot.LegendFlags_.horizontal)
        for number, name in enumerate(self.record.names):
            known = np.isfinite(heights[number])
            if known.sum() > 1:
                ink = INKS[number % len(INKS)]
                implot.plot_line(name, times[known].copy(), heights[number][known].copy(), spec=line_spec(ink))
                self.drawn += 1
        implot.plot_inf_lines("###now", np.array([now]), spec=line_spec(theme.INK, 0.8))
        implot.end_plot()

    def _values(self, heights: np.ndarray, times: np.ndarray, now: float) -> None:
        """Where each stands now, and its highest in the stretch."""
        for number, name in enumerate(self.record.names):
            known = np.isfinite(heights[number])
            if not known.any():
                continue
            here = float(np.interp(now, times[known], heights[number][known]))
            top = int(np.argmax(heights[number][known]))
            imgui.text_colored(theme.colour(INKS[number % len(INKS)]), name)
            imgui.same_line()
            high = f"highest {heights[number][known][top]:.2f} m at {times[known][top]:.2f} s"
            imgui.text_colored(theme.colour(theme.INK_FAINT), f"{here:.2f} m now, {high}")
