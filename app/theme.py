"""How the editor looks: a calm dark theme with a sea-green accent, one font, one set of icons."""

from __future__ import annotations

import logging
import re

import numpy as np
from imgui_bundle import hello_imgui, icons_fontawesome_6, imgui

log = logging.getLogger(__name__)

FONT_PX = 15.0
ICON_PX = 13.0
FONT = "fonts/Roboto/Roboto-Regular.ttf"
BOLD = "fonts/Roboto/Roboto-Bold.ttf"
ICONS = "fonts/Font_Awesome_6_Free-Solid-900.otf"

INK = (0.87, 0.89, 0.90)
INK_FAINT = (0.56, 0.60, 0.63)
GROUND = (0.115, 0.125, 0.135)
PANEL = (0.145, 0.157, 0.170)
FIELD = (0.205, 0.222, 0.240)
FIELD_HOVER = (0.255, 0.278, 0.300)
LINE = (0.085, 0.092, 0.100)
ACCENT = (0.24, 0.66, 0.66)
ACCENT_DEEP = (0.15, 0.42, 0.44)
ACCENT_BRIGHT = (0.42, 0.86, 0.84)
SHADE = (0.03, 0.04, 0.05)  # behind text on the picture
WARM = (0.95, 0.68, 0.36)  # what is changed, inverted or asks for a look
RED = (0.93, 0.43, 0.38)
BLUE = (0.45, 0.68, 0.95)

_state = {"icons": False, "bold": None}


def load_fonts() -> None:
    """Load text and icons; whatever is missing is replaced by the built-in font, never by a failed start."""
    try:
        hello_imgui.load_font(FONT, FONT_PX)
        merged = hello_imgui.FontLoadingParams()
        merged.merge_to_last_font = True
        merged.font_config.glyph_offset = (0, 1)
        hello_imgui.load_font(ICONS, ICON_PX, merged)
        _state["icons"] = True
        _state["bold"] = hello_imgui.load_font(BOLD, FONT_PX)
    except Exception as error:
        log.warning("the editor's fonts could not be loaded: %s", error)
        imgui.get_io().fonts.add_font_default()


def icon(name: str) -> str:
    """A glyph such as `icon("pause")`, empty when the icon font is missing."""
    return getattr(icons_fontawesome_6, f"ICON_FA_{name.upper()}", "") if _state["icons"] else ""


def titled(glyph: str, text: str, key: str = "") -> str:
    """A label with an icon before it and, after ###, a key that stays the same whatever is shown."""
    key = key or re.sub(r"\W+", "_", text.lower())
    return f"{icon(glyph)}  {text}###{key}" if icon(glyph) else f"{text}###{key}"


def colour(rgb: tuple[float, float, float], alpha: float = 1.0) -> imgui.ImVec4:
    return imgui.ImVec4(*rgb, alpha)


def packed(rgb: tuple[float, float, float], alpha: float = 1.0) -> int:
    """A colour as draw lists take it."""
    return imgui.get_color_u32(imgui.ImVec4(*rgb, alpha))


def packed_rows(colours: np.ndarray) -> list[list[int]]:
    """Opaque colours `(rows, cols, 3)`, 0 … 1, as draw lists take them."""
    parts = np.rint(np.clip(colours, 0, 1) * 255).astype(np.int64)
    return (parts @ np.array([1, 1 << 8, 1 << 16]) + (255 << 24)).tolist()


COLOURS: dict[str, imgui.ImVec4] = {
    "text": colour(INK),
    "text_disabled": colour(INK_FAINT),
    "window_bg": colour(PANEL),
    "child_bg": colour(PANEL, 0),
    "popup_bg": colour((0.125, 0.137, 0.148), 0.985),
    "border": colour((0.30, 0.33, 0.35), 0.55),
    "frame_bg": colour(FIELD),
    "frame_bg_hovered": colour(FIELD_HOVER),
    "frame_bg_active": colour(FIELD_HOVER),
    "title_bg": colour(GROUND),
    "title_bg_active": colour(GROUND),
    "title_bg_collapsed": colour(GROUND),
    "menu_bar_bg": colour(GROUND),
    "scrollbar_bg": colour(PANEL, 0),
    "scrollbar_grab": colour(FIELD_HOVER),
    "scrollbar_grab_hovered": colour((0.34, 0.37, 0.40)),
    "scrollbar_grab_active": colour(ACCENT),
    "check_mark": colour(ACCENT_BRIGHT),
    "slider_grab": colour(ACCENT),
    "slider_grab_active": colour((0.36, 0.82, 0.80)),
    "button": colour(FIELD),
    "button_hovered": colour(FIELD_HOVER),
    "button_active": colour(ACCENT_DEEP),
    "header": colour((0.185, 0.202, 0.218)),
    "header_hovered": colour((0.225, 0.250, 0.268)),
    "header_active": colour(ACCENT_DEEP),
    "separator": colour((0.24, 0.26, 0.28)),
    "separator_hovered": colour(ACCENT_DEEP),
    "separator_active": colour(ACCENT),
    "resize_grip": colour(FIELD, 0),
    "resize_grip_hovered": colour(ACCENT_DEEP),
    "resize_grip_active": colour(ACCENT),
    "tab": colour(GROUND),
    "tab_hovered": colour(FIELD_HOVER),
    "tab_selected": colour(PANEL),
    "tab_selected_overline": colour(ACCENT),
    "tab_dimmed": colour(GROUND),
    "tab_dimmed_selected": colour(PANEL),
    "tab_dimmed_selected_overline": colour(ACCENT, 0.35),
    "docking_preview": colour(ACCENT, 0.5),
    "docking_empty_bg": colour(LINE),
    "plot_histogram": colour(ACCENT),
    "table_header_bg": colour(GROUND),
    "table_border_strong": colour(LINE),
    "table_border_light": colour((0.20, 0.22, 0.24)),
    "table_row_bg": colour(PANEL, 0),
    "table_row_bg_alt": colour((1, 1, 1), 0.018),
    "text_selected_bg": colour(ACCENT_DEEP),
    "modal_window_dim_bg": colour((0.02, 0.03, 0.03), 0.55),
}


class bold:  # noqa: N801
    """`with bold():` writes text in the bold font, where it was loaded."""

    def __enter__(self) -> None:
        if _state["bold"] is not None:
            imgui.push_font(_state["bold"], FONT_PX)

    def __exit__(self, *_: object) -> None:
        if _state["bold"] is not None:
            imgui.pop_font()


def apply_style(scale: float = 1.0) -> None:
    """Sizes and colours of every widget; `scale` as preferred, on top of what the display asks for."""
    style = imgui.get_style()
    style.font_scale_main = scale
    style.window_rounding = style.child_rounding = style.popup_rounding = 5
    style.frame_rounding = style.grab_rounding = style.tab_rounding = 4
    style.scrollbar_rounding, style.scrollbar_size = 6, 11
    style.window_border_size = style.frame_border_size = 0
    style.popup_border_size = style.tab_bar_border_size = 1
    style.window_padding, style.frame_padding = (10, 9), (7, 4)
    style.item_spacing, style.item_inner_spacing = (7, 5), (6, 4)
    style.cell_padding = (5, 3)
    style.grab_min_size, style.indent_spacing = 9, 14
    style.docking_separator_size = 2
    style.docking_node_has_close_button = False
    style.window_menu_button_position = imgui.Dir.right  # lists the panels whose tabs have no room
    style.tab_min_width_shrink = 200  # names of panels are not cut short
    style.disabled_alpha = 0.45
    style.scale_all_sizes(scale)
    for name, value in COLOURS.items():
        style.set_color_(int(getattr(imgui.Col_, name)), value)
