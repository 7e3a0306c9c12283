"""What stands on the timeline besides waves: shots as bars with their fades, keys of the weather as diamonds (Z20)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from imgui_bundle import imgui

from ..level import Level
from ..level.objects import Marker, Placed, Shot
from ..level.tide import tide_m
from . import theme

LANE_PX = 5.0
LANES = 3
KEY_PX, KEY_DOWN_PX = 4.0, 6.0  # half a diamond, and how far down it hangs
FLAG_PX = 7.0  # a marker's flag, to the right of its pole
TIDE_PIECES = 120


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


def markers(level: Level, first_s: float, last_s: float) -> list[Marker]:
    """Named moments between two others, the latest last."""
    found = [thing for thing in level.objects.values() if isinstance(thing, Marker)]
    return sorted((m for m in found if first_s <= m.time_s <= last_s), key=lambda m: (m.time_s, m.id))


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
    if thing.kind == "marker":
        return f"{thing.id}: {thing.time_s:g} s"
    if not isinstance(thing, Shot):
        where = f" within {thing.radius_m / 1000:g} km" if thing.radius_m else ""
        return f"{thing.id}: {thing.weather}{where} from {thing.time_s:g} s on, there after {thing.fade_s:g} s"
    return f"{thing.id}{f' of {thing.camera}' if thing.camera else ''}: {thing.start_s:g} to {thing.end_s:g} s"


@dataclass(frozen=True)
class Strip:
    """Where the timeline is on the screen, pixels, and what it shows, seconds."""

    left: float
    top: float
    right: float
    bottom: float
    first_s: float
    last_s: float

    def x_of(self, time_s: float) -> float:
        return self.left + (time_s - self.first_s) / (self.last_s - self.first_s) * (self.right - self.left)

    def time_of(self, x: float) -> float:
        """The moment at a pixel, no farther than the ends."""
        part = min(max((x - self.left) / (self.right - self.left), 0.0), 1.0)
        return self.first_s + part * (self.last_s - self.first_s)

    def shows(self, time_s: float) -> bool:
        return self.first_s <= time_s <= self.last_s

    def foot(self, lane: int) -> float:
        """Where the bars of a lane stand."""
        return self.bottom - 2 - lane * (LANE_PX + 1)

    def in_lane(self, lane: int, y: float) -> bool:
        return self.foot(lane) - LANE_PX - 1 < y <= self.foot(lane)


def bars_under(level: Level, strip: Strip, x: float, y: float) -> list[Placed]:
    """The shots whose bars are at a pixel, the uppermost last."""
    return [
        bar.shot
        for bar in bars(level, strip.first_s, strip.last_s)
        if strip.x_of(bar.shot.start_s) <= x <= strip.x_of(bar.shot.end_s) and strip.in_lane(bar.lane, y)
    ]


def keys_under(level: Level, strip: Strip, x: float, y: float) -> list[Placed]:
    """The keys of the weather whose diamonds are at a pixel."""
    return [
        key
        for key in keys(level, strip.first_s, strip.last_s)
        if abs(strip.x_of(key.time_s) - x) <= KEY_PX and abs(strip.top + KEY_DOWN_PX - y) <= KEY_PX
    ]


def markers_under(level: Level, strip: Strip, x: float, y: float) -> list[Placed]:
    """The markers whose flags are at a pixel."""
    return [
        marker
        for marker in markers(level, strip.first_s, strip.last_s)
        if -3 <= x - strip.x_of(marker.time_s) <= FLAG_PX + 2 and strip.top - 2 <= y <= strip.bottom
    ]


def under(level: Level, strip: Strip, x: float, y: float) -> list[Placed]:
    """What the marks at a pixel stand for, the uppermost last."""
    return [*bars_under(level, strip, x, y), *keys_under(level, strip, x, y), *markers_under(level, strip, x, y)]


def draw(level: Level, strip: Strip, selected: str) -> None:
    """Draw all marks into a strip of the window."""
    draw_list = imgui.get_window_draw_list()
    _tide(level, strip)
    for bar in bars(level, strip.first_s, strip.last_s):
        foot = strip.foot(bar.lane)
        corners = outline(bar.shot, strip.first_s, strip.last_s)
        points = [(strip.x_of(time_s), foot - LANE_PX * share) for time_s, share in corners]
        points = [(points[0][0], foot), *points, (points[-1][0], foot)]
        ink = theme.packed(theme.WARM, 0.95 if bar.shot.id == selected else 0.6)
        draw_list.add_convex_poly_filled([imgui.ImVec2(*point) for point in points], ink)
    for key in keys(level, strip.first_s, strip.last_s):
        x, y = strip.x_of(key.time_s), strip.top + KEY_DOWN_PX
        points = [(x - KEY_PX, y), (x, y - KEY_PX), (x + KEY_PX, y), (x, y + KEY_PX)]
        ink = theme.packed(theme.ACCENT_BRIGHT, 1.0 if key.id == selected else 0.8)
        draw_list.add_convex_poly_filled([imgui.ImVec2(*point) for point in points], ink)
    for marker in markers(level, strip.first_s, strip.last_s):
        _flag(strip, marker, marker.id == selected)


def _flag(strip: Strip, marker: Marker, selected: bool) -> None:
    """A pole at the moment, a flag on top and its name beside it."""
    draw_list, x = imgui.get_window_draw_list(), strip.x_of(marker.time_s)
    ink = theme.packed(theme.WARM, 1.0 if selected else 0.8)
    draw_list.add_line(imgui.ImVec2(x, strip.top - 1), imgui.ImVec2(x, strip.bottom), ink, 2.0 if selected else 1.5)
    corners = [(x, strip.top - 1), (x + FLAG_PX, strip.top + 2), (x, strip.top + 5)]
    draw_list.add_triangle_filled(*(imgui.ImVec2(*corner) for corner in corners), ink)
    wide = imgui.calc_text_size(marker.id).x
    left = x + FLAG_PX + 2 if x + FLAG_PX + 2 + wide < strip.right else x - wide - 4
    if left > strip.left:
        draw_list.add_text(imgui.ImVec2(left, strip.top + 1), ink, marker.id)


def _tide(level: Level, strip: Strip) -> None:
    """The tide over what is shown, a thin line between the strip's edges."""
    tide = level.settings.tide
    if not tide.on or tide.range_m <= 0:
        return
    at = np.linspace(strip.first_s, strip.last_s, TIDE_PIECES)
    part = tide_m(level.settings, at) / tide.range_m + 0.5
    high = strip.bottom - strip.top - 6
    points = [imgui.ImVec2(strip.x_of(t), strip.bottom - 3 - high * p) for t, p in zip(at, part)]
    imgui.get_window_draw_list().add_polyline(points, theme.packed(theme.BLUE, 0.75), 1.2, imgui.ImDrawFlags_.none)
