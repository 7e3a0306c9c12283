"""The shore wave clock along a cut: A, B, A − B, bed and surface; what the offshore groups sum to (D03, H28)."""

from __future__ import annotations

from imgui_bundle import ImVec2, imgui, implot

from ...level.gerstner import groups
from ...level.section import section
from ..editor import Editor
from ..param_widgets import tooltip

PLOT_PX = 150
HALVES = (implot.Flags_.no_menus | implot.Flags_.no_mouse_text, implot.AxisFlags_.auto_fit)


class WavesPanel:
    """Keeps the point it cuts through: the last ground under the pointer while `follows`."""

    def __init__(self) -> None:
        self.follows = True
        self.point: tuple[float, float] | None = None
        self.kept: tuple = ((), None)

    def draw(self, editor: Editor) -> None:
        session = editor.session
        _, self.follows = imgui.checkbox("Follow the pointer", self.follows)
        tooltip("Off, the cut stays where it is while you sculpt and let time run.")
        if session.cursor and (self.follows or self.point is None):
            self.point = session.cursor[:2]
        if self.point is None:
            imgui.text_wrapped("Move the pointer over the coast to cut through it.")
        else:
            self._plots(session.level, session.clock.time_s)
        self._groups(session.level)

    def _plots(self, level, time_s: float) -> None:
        key = (id(level), level.revision, time_s, self.point)
        if self.kept[0] != key:
            self.kept = key, section(level, time_s, *self.point)
        cut = self.kept[1]
        lines = (("A", cut.a), ("B", cut.b), ("A − B", cut.a - cut.b))
        self._plot("masks", "", cut.along_m, lines)
        self._plot("cut", "m", cut.along_m, (("surface", cut.surface_m), ("bed", cut.ground_m)))

    @staticmethod
    def _plot(name: str, unit: str, along, lines) -> None:
        flags, fit = HALVES
        if implot.begin_plot(f"###{name}", ImVec2(-1, PLOT_PX), flags):
            implot.setup_axes("m, sea to land", unit, fit, fit)
            for label, values in lines:
                implot.plot_line(label, along, values)
            implot.end_plot()

    @staticmethod
    def _groups(level) -> None:
        imgui.separator_text("Offshore")
        for label, fronts in zip(("chop", "swell"), groups(level.settings.sea, level.settings.level.seed), strict=True):
            largest = float(fronts.amplitude_m.max())
            imgui.text(f"{label}: {len(fronts.length_m)} fronts, RMS {fronts.rms_m:.2f} m, largest {largest:.2f} m")
            tooltip("Root mean square height of the sum beside the largest front: fronts of like length cancel (H28).")
