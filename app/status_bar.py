"""The status bar: what is under the pointer, frames a second and the scale they are drawn at, memory."""

from __future__ import annotations

import time

from imgui_bundle import imgui

from ..level.sun import day_moment, day_runs
from . import sky_brush, theme
from .editor import Editor
from .panels.history_panel import bytes_text
from .picture import Picture
from .probe import sentence

_memory = {"at": -1e9, "bytes": 0}


def draw(editor: Editor, picture: Picture | None) -> None:
    imgui.text_unformatted(_pointed(editor))
    right = f"{day_text(editor)}{_speed(editor, picture)}      memory {bytes_text(resident_bytes())}"
    width = imgui.calc_text_size(right).x
    imgui.same_line(max(imgui.get_window_width() - width - 14, 0))
    imgui.text_colored(theme.colour(theme.INK_FAINT), right)


def _pointed(editor: Editor) -> str:
    """What is under the pointer: the ground, or the weather with a brush for it in hand."""
    session = editor.session
    if sky_brush.in_hand(session):
        point = session.sky_cursor or editor.map_pointer
        return sky_brush.sentence(sky_brush.sky_at(session, *point[:2])) if point else sky_brush.ELSEWHERE
    probe = editor.probe()
    return sentence(probe) if probe else "Point at the ground to read it"


def day_text(editor: Editor) -> str:
    """Date and hour at the place while its day runs (Z25)."""
    light = editor.session.level.settings.light
    if not day_runs(light):
        return ""
    moment = day_moment(light, editor.session.clock.time_s)
    return f"{moment.day} {moment:%B, %H:%M}      "


def _speed(editor: Editor, picture: Picture | None) -> str:
    if picture is None or picture.drawn is None:
        return ""
    width, height = picture.drawn.size
    cost = picture.governor.frame_s
    marched = picture.renderer.stats.get("clouds_marched") if picture.renderer else None
    clouds = "" if marched is None else f"{marched} of {-(-width // 2) * -(-height // 2)} rays through clouds   "
    if not editor.live:
        return f"{clouds}{width} × {height}   still"
    return f"{clouds}{width} × {height}   {cost * 1000:.0f} ms   {imgui.get_io().framerate:.0f} fps"


def resident_bytes() -> int:
    """Memory of this process, looked up once a second; 0 where the system doesn't say."""
    if time.monotonic() - _memory["at"] > 1.0:
        _memory.update(at=time.monotonic(), bytes=_resident())
    return _memory["bytes"]


def _resident() -> int:
    try:
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * 4096
    except (OSError, ValueError, IndexError):
        return _peak()


def _peak() -> int:
    try:
        import resource
        import sys
    except ImportError:
        return 0
    used = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return used if sys.platform == "darwin" else used * 1024
