"""What stands on the timeline besides waves: shots as bars with their fades, keys of the weather as diamonds (Z20)."""

from __future__ import annotations

from dataclasses import dataclass

from imgui_bundle import imgui

from ..level import Level
from ..level.objects import Placed, Shot
from . import theme

LANE_PX = 5.0
LANES = 3


@dataclass(frozen=True)
class Bar:
    """A shot on the timeline; `lane` 0 is the lowest, so that shots at the same time lie over one another."""

    shot: Shot
    lane: int


def bars(level: Level, first_s: float, last_s: float) -> list[Bar]:
    """The shots that run between two moments, in order of their start, each in the lowest lane that is free."""
    shots = [thing for thing in level.objects.values() if isinstance(thing, Shot)]
    shots = [shot for shot in shots if shot.start_s < min(last_s, shot.end_s) and shot.end_s > first_s]
    ends = [float("-inf")] * LANES
    found = []
    for shot in sorted(shots, key=lambda shot: (shot.start_s, shot.id)):
        lane = next((n for n, end in enumerate(ends) if end <= shot.start_s), LANES - 1)
        ends[lane] = max(ends[lane], shot.end_s)
        found.append(Bar(shot, lane))
    return found


def keys(level: Level, first_s: float, last_s: float) -> list[Placed]:
    """Keys of the weather between two moments."""
    return [
        thing for thing in level.objects.values() if thing.kind == "weather_key" and first_s <= thing.time_s <= last_s
    ]


def outline(shot: Shot, first_s: float, last_s: float) -> list[tuple[float, float]]:
    """(moment, share of a lane) of a shot's corners, cut off at the ends of what is shown."""
    fade = min(shot.fade_s, (shot.end_s - shot.start_s) / 2)
    corners = [(shot.start_s, 0.0), (shot.start_s + fade, 1.0), (shot.end_s - fade, 1.0), (shot.end_s, 0.0)]

    def share(time_s: float) -> float:
        rise = (time_s - shot.start_s) / fade if fade > 0 else 1.0
        fall = (shot.end_s - time_s) / fade if fade > 0 else 1.0
        return min(max(min(rise, fall), 0.0), 1.0)

    inside = [corner for corner in corners if first_s <= corner[0] <= last_s]
    left = [(first_s, share(first_s))] if shot.start_s < first_s else []
    right = [(last_s, share(last_s))] if shot.end_s > last_s else []
    return [*left, *inside, *right]


def sentence(thing: Placed) -> str:
    """What a mark stands for, on a line."""
    if not isinstance(thing, Shot):
        return f"{thing.id}: {thing.time_s:g} s"
    return f"{thing.id}{f' of {thing.camera}' if thing.camera else ''}: {thing.start_s:g} to {thing.end_s:g} s"


def draw(level: Level, selected: str, low, high, first_s: float, last_s: float) -> list[Placed]:
    """Draw all marks into a rectangle of the screen; returns what those under the pointer stand for."""
    draw_list, mouse, under = imgui.get_window_draw_list(), imgui.get_mouse_pos(), []

    def x_of(time_s: float) -> float:
        return low.x + (time_s - first_s) / (last_s - first_s) * (high.x - low.x)

    for bar in bars(level, first_s, last_s):
        foot = high.y - 2 - bar.lane * (LANE_PX + 1)
        points = [(x_of(t), foot - LANE_PX * share) for t, share in outline(bar.shot, first_s, last_s)]
        lit = bar.shot.id == selected
        ink = theme.packed(theme.WARM, 0.95 if lit else 0.6)
        corners = [(points[0][0], foot), *points, (points[-1][0], foot)]
        draw_list.add_convex_poly_filled([imgui.ImVec2(*point) for point in corners], ink)
        if corners[0][0] <= mouse.x <= corners[-1][0] and foot - LANE_PX - 1 <= mouse.y <= foot + 1:
            under.append(bar.shot)
    for key in keys(level, first_s, last_s):
        x, y, half = x_of(key.time_s), low.y + 6, 4.0
        corners = [(x - half, y), (x, y - half), (x + half, y), (x, y + half)]
        ink = theme.packed(theme.ACCENT_BRIGHT, 1.0 if key.id == selected else 0.8)
        draw_list.add_convex_poly_filled([imgui.ImVec2(*point) for point in corners], ink)
        if abs(mouse.x - x) <= half and abs(mouse.y - y) <= half:
            under.append(key)
    return under
