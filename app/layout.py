"""Where the panels stand when the window is first opened: brushes left, viewport, timeline below it, the rest right."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from imgui_bundle import hello_imgui, imgui

VERSION = 7  # another number forgets the layouts people saved, as after a change of PANELS
BRUSHES_PX = 80
SIDE_PX = (326, 400)  # at least and at most
SIDE_SHARE = 0.235  # of the width, in between
TIMELINE_PX = 46
BRUSH_PX = 268  # of the right column's height


_FLAGS = imgui.WindowFlags_
BARE = _FLAGS.no_collapse | _FLAGS.no_scrollbar | _FLAGS.no_scroll_with_mouse


@dataclass(frozen=True)
class Panel:
    """A row: `dock` is a place of `SPLITS`; `bare` panels have no tab and stay."""

    name: str
    dock: str
    bare: bool = False
    scrolls: bool = True
    padded: bool = True


PANELS: tuple[Panel, ...] = (
    Panel("Viewport", "MainDockSpace", bare=True, scrolls=False, padded=False),
    Panel("Timeline", "timeline", bare=True, scrolls=False),
    Panel("Brushes", "brushes", bare=True),
    Panel("Brush", "brush"),
    Panel("Settings", "side"),
    Panel("Weather map", "side"),
    Panel("Objects", "side"),
    Panel("Views", "side"),
    Panel("Layers", "side"),
    Panel("History", "side"),
    Panel("Waves", "side"),
    Panel("Probes", "side"),
    Panel("Timing", "side"),
    Panel("Log", "side"),
)


def docking(
    draws: dict[str, Callable[[], None]], size: tuple[int, int], scale: float = 1.0
) -> hello_imgui.DockingParams:
    """The layout for a window of `size` pixels with widgets `scale` times as large; `draws` by panel name."""
    params = hello_imgui.DockingParams()
    params.layout_name = "Shorewright"
    params.docking_splits = _splits((size[0] / scale, size[1] / scale))
    params.dockable_windows = [_window(panel, draws[panel.name]) for panel in PANELS]
    return params


def _splits(size: tuple[float, float]) -> list[hello_imgui.DockingSplit]:
    width, height = max(size[0], 640), max(size[1] - 60, 360)
    side = min(max(SIDE_SHARE * width, SIDE_PX[0]), SIDE_PX[1])
    bare = imgui.internal.DockNodeFlagsPrivate_.no_tab_bar
    split = hello_imgui.DockingSplit
    return [
        split("MainDockSpace", "side", imgui.Dir.right, side / width),
        split("side", "brush", imgui.Dir.up, min(BRUSH_PX / height, 0.6)),
        split("MainDockSpace", "brushes", imgui.Dir.left, BRUSHES_PX / (width - side), bare),
        split("MainDockSpace", "timeline", imgui.Dir.down, TIMELINE_PX / height, bare),
    ]


def edge_to_edge(name: str, draw: Callable[[], None]) -> Callable[[], None]:
    """What a panel without padding draws: its own window, without a tab, filled to the edges."""

    def drawn() -> None:
        bare = imgui.WindowClass()
        bare.dock_node_flags_override_set = imgui.internal.DockNodeFlagsPrivate_.no_tab_bar
        imgui.set_next_window_class(bare)
        imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(0, 0))
        shown, _ = imgui.begin(name, None, BARE)
        imgui.pop_style_var()
        if shown:
            draw()
        imgui.end()

    return drawn


def _window(panel: Panel, draw: Callable[[], None]) -> hello_imgui.DockableWindow:
    draw = draw if panel.padded else edge_to_edge(panel.name, draw)
    window = hello_imgui.DockableWindow(panel.name, panel.dock, draw, True, False)
    window.imgui_window_flags = _FLAGS.no_collapse if panel.scrolls else BARE
    window.call_begin_end = panel.padded
    window.include_in_view_menu = not panel.bare
    return window
