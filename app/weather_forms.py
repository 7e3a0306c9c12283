"""Forms for weather maps: take one in, seen and told about before it is; write the sky out (Z04, T04)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from imgui_bundle import imgui

from ..io.weather_maps import WEATHER_LAYOUTS, read_weather_map
from ..level import BadInput
from ..level.sky_maps import SIDE, STAGES, TILE_M
from ..level.weather import paint_place
from . import theme
from .editor import Editor
from .file_forms import WIDE, Form, PathField
from .param_widgets import tooltip

FIELD_PX = 120
CELLS = 56  # of the small picture, a side
CELL_PX = 3.0
STAGE_LABELS = {"paint": "the paint alone", "simulated": "the simulation", "painted": "simulation and paint",
                "final": "what is drawn"}  # fmt: skip


def sky_colours(sky: np.ndarray) -> np.ndarray:
    """float32 `(…, 3)` of coverage, precipitation, type and weights: red, green, blue as the talk paints maps."""
    weight = sky[..., 3:].max(axis=-1, keepdims=True) if sky.shape[-1] > 3 else 1.0
    return sky[..., :3] * weight + 0.12 * (1 - weight)


def sky_inks(sky: np.ndarray) -> list[list[int]]:
    """Colours of a small picture of a map `(512, 512, channels)`, north on top."""
    places = (np.arange(CELLS) * SIDE) // CELLS
    return theme.packed_rows(sky_colours(sky[np.ix_(places, places)])[::-1])


def draw_inks(inks: list[list[int]]) -> None:
    """Such a picture, its own item."""
    corner, draw_list = imgui.get_cursor_screen_pos(), imgui.get_window_draw_list()
    imgui.dummy(imgui.ImVec2(CELLS * CELL_PX, CELLS * CELL_PX))
    for row in range(CELLS):
        for col in range(CELLS):
            low = imgui.ImVec2(corner.x + col * CELL_PX, corner.y + row * CELL_PX)
            high = imgui.ImVec2(low.x + CELL_PX, low.y + CELL_PX)
            draw_list.add_rect_filled(low, high, inks[row][col])


def layout_combo(label: str, layout: str, names: list[str]) -> str:
    """A combo of layouts; returns the one chosen."""
    imgui.set_next_item_width(2 * FIELD_PX)
    if imgui.begin_combo(label, WEATHER_LAYOUTS[layout].label):
        for name in names:
            if imgui.selectable(f"{WEATHER_LAYOUTS[name].label}###layout_{name}", name == layout)[0]:
                layout = name
            tooltip(WEATHER_LAYOUTS[name].doc)
        imgui.end_combo()
    tooltip(WEATHER_LAYOUTS[layout].doc)
    return layout


class WeatherImportForm(Form):
    title, confirm = "Import weather map", "Import"

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        self.field = PathField("open", "Weather map")
        self.layout, self.swizzle, self.opacity = "ours", "", 1.0
        self.blend_m, self.extent_m, self.feather_m, self.at = 0.0, TILE_M, 0.0, ""
        self._key: Any = None  # of what was looked at
        self._seen: list[list[int]] | None = None
        self._told: list[str] = []

    def draw(self) -> None:
        imgui.text_colored(theme.colour(theme.INK_FAINT), "Lies over the painted sky; north is on top.")
        self.field.draw("sky.png, .bmp, .tga, .tif or .exr", focus=True)
        busy = imgui.is_item_active()
        readable = [row.name for row in WEATHER_LAYOUTS.values() if row.swizzle]
        self.layout = layout_combo("Layout", self.layout, readable)
        imgui.set_next_item_width(FIELD_PX)
        _, self.swizzle = imgui.input_text_with_hint("Channels", WEATHER_LAYOUTS[self.layout].swizzle, self.swizzle)
        busy = busy or imgui.is_item_active()
        tooltip("Coverage, precipitation, type: r, g, b, a, 1-r, a number, or - to leave what is there. r,0,0.6 takes"
                " coverage from red, no rain, mostly cumulus; further parts are weights.")  # fmt: skip
        imgui.set_next_item_width(FIELD_PX)
        _, self.opacity = imgui.slider_float("Opacity", self.opacity, 0.0, 1.0, "%.2f")
        self._sizes()
        self._look(busy)

    def _sizes(self) -> None:
        imgui.set_next_item_width(FIELD_PX)
        changed, extent = imgui.input_float("Covers a side", self.extent_m, 0, 0, "%.0f m")
        self.extent_m = min(max(extent, 300.0), TILE_M) if changed else self.extent_m
        tooltip("70 km is the whole sky; a smaller map leaves the rest.")
        imgui.set_next_item_width(FIELD_PX)
        if self.extent_m == TILE_M:
            _, self.blend_m = imgui.slider_float("Wrap blend", self.blend_m, 0.0, 15_000.0, "%.0f m")
            tooltip("Edges are cross-faded over so much, so that the map tiles.")
            return
        _, self.feather_m = imgui.slider_float("Feather", self.feather_m, 0.0, self.extent_m / 2, "%.0f m")
        imgui.set_next_item_width(FIELD_PX)
        _, self.at = imgui.input_text_with_hint("Middle", "of the sky", self.at)
        tooltip("Metres east and north in the level, such as 500, 700, at the clock's time.")

    def options(self) -> dict[str, Any]:
        """As `Session.weather_import` takes them; BadInput for a middle that is none."""
        made = {"layout": self.layout, "swizzle": self.swizzle.strip(), "extent_m": self.extent_m}
        if self.extent_m == TILE_M:
            return made | {"opacity": self.opacity, "wrap_blend_m": self.blend_m}
        if self.at.strip():
            try:
                east, north = (float(part) for part in self.at.replace(",", " ").split())
            except ValueError:
                raise BadInput(f"{self.at!r} is no place: give two numbers, such as 500, 700") from None
            made["at"] = (east, north)
        return made | {"opacity": self.opacity, "feather_m": self.feather_m}

    def _look(self, busy: bool) -> None:
        """The map as it would lie, and what is to be told of it; read anew when something was changed."""
        key = self._state()
        if key != self._key and not busy and not imgui.is_mouse_down(0):
            self._key, self._seen, self._told = key, None, []
            if self.field.text.strip():
                try:
                    sky, self._told = self._read()
                    self._seen = sky_inks(sky)
                except (BadInput, OSError) as error:
                    self._told = [str(error)]
        top = imgui.get_cursor_pos()
        if self._seen is not None:
            draw_inks(self._seen)
        imgui.set_cursor_pos(imgui.ImVec2(top.x + CELLS * CELL_PX + 12, top.y))
        imgui.push_text_wrap_pos(WIDE)
        imgui.begin_group()
        for note in self._told:
            imgui.text_colored(theme.colour(theme.WARM), note)
        imgui.end_group()
        imgui.pop_text_wrap_pos()
        imgui.set_cursor_pos(top)
        imgui.dummy(imgui.ImVec2(WIDE, CELLS * CELL_PX))  # always as high: the button stays under the pointer

    def _state(self) -> tuple:
        return self.field.text, self.layout, self.swizzle, self.blend_m, self.feather_m, self.extent_m, self.at

    def _read(self) -> tuple[np.ndarray, list[str]]:
        options = self.options()
        options.pop("opacity")
        if at := options.pop("at", None):
            place = paint_place(self.editor.session.level, self.editor.session.clock.time_s, *at)
            options["about_m"] = tuple(float(part) for part in place)
        return read_weather_map(self.field.path, **options)

    def run(self) -> None:
        self.editor.session.weather_import(self.field.path, **self.options())
        self.editor.messages.tell(f"Laid {self.field.path.name} over the sky")


class WeatherExportForm(Form):
    title, confirm = "Export weather map", "Export"
    bits = (8, 16)
    sides = (256, 512, 1024, 2048)

    def __init__(self, editor: Editor) -> None:
        super().__init__(editor)
        held = editor.session.path
        folder, stem = (held.parent, held.stem) if held else (Path.cwd(), "level")
        self.field = PathField("save", "Weather map", str(folder / f"{stem}_sky.png"))
        self.layout, self.stage, self.deep, self.side = "ours", "", 0, 1

    def draw(self) -> None:
        imgui.text_colored(theme.colour(theme.INK_FAINT), "70 km round the middle of the sky, now; north on top.")
        self.field.draw("sky.png, .tif or .exr")
        before = self.layout
        self.layout = layout_combo("Layout", before, [row.name for row in WEATHER_LAYOUTS.values() if row.stage])
        self.stage = self.stage if self.layout == before else ""
        stage = self.stage or WEATHER_LAYOUTS[self.layout].stage
        stages = ["paint"] if self.layout == "weights" else list(STAGES)
        imgui.set_next_item_width(2 * FIELD_PX)
        changed, number = imgui.combo("Of", stages.index(stage), [STAGE_LABELS[name] for name in stages])
        self.stage = stages[number] if changed else self.stage
        imgui.set_next_item_width(FIELD_PX)
        _, self.deep = imgui.combo("Bits", self.deep, [str(bits) for bits in self.bits])
        imgui.set_next_item_width(FIELD_PX)
        _, self.side = imgui.combo("Samples a side", self.side, [str(side) for side in self.sides])

    def run(self) -> None:
        session, path = self.editor.session, self.field.path
        bits = self.bits[self.deep]
        session.notes += session.weather_export(
            path, layout=self.layout, stage=self.stage, bits=bits, side=self.sides[self.side]
        )
        self.editor.messages.tell(f"Wrote {path.name}")
