"""The shore waves along the way of a front: bed, still sea, surface now, before and after, masks (D03, H28, T06)."""

from __future__ import annotations

import numpy as np
from imgui_bundle import ImVec2, ImVec4, imgui, implot

from ...level.gerstner import groups
from ...level.section import Section, ghosts, reach, section, way_of_front
from .. import theme
from ..editor import Editor
from ..param_widgets import tooltip
from ..time_edits import wave_s
from .probe_panel import line_spec

QUIET = implot.Flags_.no_menus | implot.Flags_.no_mouse_text
MASKS_PX, LEAST_CUT_PX, MOST_CUT_PX = 140, 210, 400
SAND = (0.72, 0.58, 0.38)
MASKS = (("line", "line", theme.INK), ("back", "back", theme.BLUE), ("fall", "fall", theme.WARM))
STILL_SAMPLES, MOVING_SAMPLES = 200, 120
GHOSTS = 3  # to either side


class WavesPanel:
    """Keeps the point it cuts through: the last ground under the pointer while `follows`."""

    def __init__(self) -> None:
        self.follows = True
        self.point: tuple[float, float] | None = None
        self.step = 0.1  # of a wave, between ghosts
        self.kept: dict[str, tuple] = {}

    def draw(self, editor: Editor) -> None:
        session = editor.session
        _, self.follows = imgui.checkbox("Follow the pointer", self.follows)
        tooltip("Off, the cut stays where it is while you sculpt and let time run.")
        imgui.same_line()
        imgui.set_next_item_width(-imgui.FLT_MIN)
        _, self.step = imgui.slider_float("###ghost_step", self.step, 0.02, 0.5, "ghosts every %.2f waves")
        tooltip("The paused surface is drawn before and after now, so far apart; fading the farther they are.")
        if session.cursor and (self.follows or self.point is None):
            self.point = session.cursor[:2]
        if self.point is None:
            imgui.text_wrapped("Move the pointer over the coast to cut through it.")
        else:
            self._plots(session)
        self._groups(session.level)

    def _once(self, name: str, key: tuple, work):
        """What `work` gives, kept while the key stays."""
        held = self.kept.get(name)
        if held is None or held[0] != key:
            held = self.kept[name] = key, work()
        return held[1]

    def _plots(self, session) -> None:
        level, t = session.level, session.clock.time_s
        samples = STILL_SAMPLES if session.clock.paused else MOVING_SAMPLES
        place = id(level), level.revision, self.point, samples
        way = self._once("way", place, lambda: way_of_front(level, *self.point, samples=samples))
        cut = self._once("cut", (*place, t), lambda: section(level, t, *self.point, way=way))
        period_s = wave_s(session)
        begun = np.floor(t / period_s) * period_s
        band = self._once("band", (*place, begun), lambda: reach(level, begun, period_s, way))
        shades = ()
        if session.clock.paused:
            steps = [n for n in range(-GHOSTS, GHOSTS + 1) if n]
            times = [t + n * self.step * period_s for n in steps]
            found = self._once("ghosts", (*place, t, self.step), lambda: ghosts(level, times, way))
            shades = tuple(zip(steps, found, strict=True))
        self._cut(cut, band, shades)
        self._masks(cut)

    def _cut(self, cut: Section, band, shades) -> None:
        x = cut.along_m
        rest = MASKS_PX + 5 * imgui.get_text_line_height_with_spacing()
        high = min(max(imgui.get_content_region_avail().y - rest, LEAST_CUT_PX), MOST_CUT_PX)
        if not implot.begin_plot("###cut", ImVec2(-1, high), QUIET):
            return
        fit = implot.AxisFlags_.none
        implot.setup_axes("", "m", fit, fit)
        implot.setup_axis_limits(implot.ImAxis_.x1, float(x[0]), float(x[-1]), imgui.Cond_.always)
        implot.setup_axis_limits(implot.ImAxis_.y1, *_span(cut, band), imgui.Cond_.always)
        implot.setup_legend(implot.Location_.south_east)  # over the ground, where nothing is to be seen
        wet = implot.Spec(fill_color=ImVec4(*theme.BLUE, 1.0), fill_alpha=0.35, line_color=ImVec4(0, 0, 0, 0))
        implot.plot_shaded("range", x, *band, spec=wet)
        for name, edge in zip(("###lowest", "###highest"), band, strict=True):
            implot.plot_line(name, x, edge, spec=line_spec(theme.BLUE, 0.45, 1.0))
        sand = implot.Spec(fill_color=ImVec4(*SAND, 1.0), fill_alpha=0.35, line_color=ImVec4(0, 0, 0, 0))
        implot.plot_shaded("###ground", x, cut.ground_m, -1e4, spec=sand)
        implot.plot_line("bed", x, cut.ground_m, spec=line_spec(SAND, 1.0, 1.8))
        for step, heights in shades:
            ink = theme.ACCENT_BRIGHT if step > 0 else theme.WARM
            alpha = 0.6 * (1 - (abs(step) - 1) / GHOSTS)
            implot.plot_line("after###g1" if step == 1 else "before###g-1" if step == -1 else f"###g{step}", x,
                             heights.copy(), spec=line_spec(ink, alpha, 1.0))  # fmt: skip
        still = np.where(cut.ground_m < cut.still_m, cut.still_m, np.nan)
        implot.plot_line("still", x, still, spec=line_spec(theme.INK, 0.45, 1.0))
        implot.plot_line("now", x, cut.surface_m, spec=line_spec(theme.BLUE, 1.0, 2.2))
        implot.plot_inf_lines("###here", np.zeros(1), spec=line_spec(theme.INK, 0.25, 1.0))
        _told(cut, band)
        implot.end_plot()

    @staticmethod
    def _masks(cut: Section) -> None:
        if not implot.begin_plot("###masks", ImVec2(-1, MASKS_PX), QUIET):
            return
        implot.setup_axes("m, sea to land", "")
        implot.setup_axis_limits(implot.ImAxis_.x1, float(cut.along_m[0]), float(cut.along_m[-1]), imgui.Cond_.always)
        implot.setup_axis_limits(implot.ImAxis_.y1, -0.05, 1.75, imgui.Cond_.always)
        implot.setup_legend(implot.Location_.north_west, implot.LegendFlags_.horizontal)
        for label, name, ink in MASKS:
            implot.plot_line(label, cut.along_m, getattr(cut, name), spec=line_spec(ink))
        if implot.is_plot_hovered():
            n = _nearest(cut, implot.get_plot_mouse_pos().x)
            imgui.set_tooltip("\n".join(f"{label} {float(getattr(cut, name)[n]):.2f}" for label, name, _ in MASKS))
        implot.end_plot()

    @staticmethod
    def _groups(level) -> None:
        imgui.separator_text("Offshore")
        for label, fronts in zip(("chop", "swell"), groups(level.settings.sea, level.settings.level.seed), strict=True):
            largest = float(fronts.amplitude_m.max())
            imgui.text(f"{label}: {len(fronts.length_m)} fronts, RMS {fronts.rms_m:.2f} m, largest {largest:.2f} m")
            tooltip("Root mean square height of the sum beside the largest front: fronts of like length cancel (H28).")


def _span(cut: Section, band) -> tuple[float, float]:
    """Heights shown: all water, and of the bed what lies near it."""
    low, high = float(band[0].min()), float(band[1][cut.ground_m < cut.still_m + 1.0].max(initial=cut.still_m))
    low = min(low, max(float(cut.ground_m.min()), cut.still_m - 8.0))
    spare = 0.12 * max(high - low, 1.0)
    return low - spare, high + 2.2 * spare


def _nearest(cut: Section, along_m: float) -> int:
    return int(np.argmin(np.abs(cut.along_m - along_m)))


def _told(cut: Section, band) -> None:
    """The values under the pointer."""
    if not implot.is_plot_hovered():
        return
    n = _nearest(cut, implot.get_plot_mouse_pos().x)
    low, high = float(band[0][n]), float(band[1][n])
    ground, surface = float(cut.ground_m[n]), float(cut.surface_m[n])
    rows = [f"{float(cut.along_m[n]):+.1f} m", f"surface {surface:.2f} m", f"bed {ground:.2f} m",
            f"depth {max(cut.still_m - ground, 0.0):.2f} m still", f"in a wave {low:.2f} … {high:.2f} m"]  # fmt: skip
    imgui.set_tooltip("\n".join(rows))
