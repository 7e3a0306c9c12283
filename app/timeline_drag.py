"""Marks of the timeline in the hand: the ends of a shot, all of it, a key of the weather, a marker (Z20, D36, T05)."""

from __future__ import annotations

from dataclasses import dataclass

from ..level import Level
from ..level.objects import Placed, Shot
from .timeline_marks import Strip, bars, bars_under, keys_under, markers_under

EDGE_PX = 4.0  # to both sides of a shot's end
SLACK_PX = 3.0  # a press that goes no farther is a click
SHORTEST_S = 0.1


@dataclass(frozen=True)
class Grip:
    """What the mouse holds: `part` of a thing as it was when pressed at the moment `at_s`."""

    thing: Placed
    part: str  # start, end, whole or key
    at_s: float

    @property
    def edge(self) -> bool:
        return self.part in ("start", "end")


def grip_at(level: Level, strip: Strip, x: float, y: float, selected: str = "") -> Grip | None:
    """What a press takes hold of: a marker or a key, else an end, else a shot; the one in hand before others."""
    at_s = strip.time_of(x)
    if found := markers_under(level, strip, x, y) or keys_under(level, strip, x, y):
        return Grip(found[-1], "key", at_s)
    ends = [
        Grip(bar.shot, part, at_s)
        for bar in bars(level, strip.first_s, strip.last_s)
        for part, end_s in (("start", bar.shot.start_s), ("end", bar.shot.end_s))
        if strip.in_lane(bar.lane, y) and abs(strip.x_of(end_s) - x) <= EDGE_PX and strip.shows(end_s)
    ]
    # where one shot ends as the next begins, the side of the pointer decides
    ends.sort(key=lambda grip: (grip.thing.id == selected, (grip.part == "start") == (x >= _end_px(strip, grip))))
    if ends:
        return ends[-1]
    found = bars_under(level, strip, x, y)
    return Grip(found[-1], "whole", at_s) if found else None


def _end_px(strip: Strip, grip: Grip) -> float:
    return strip.x_of(grip.thing.start_s if grip.part == "start" else grip.thing.end_s)


def dragged(grip: Grip, time_s: float) -> dict[str, float]:
    """The fields of what is held once the mouse is at another moment; a shot keeps SHORTEST_S, nothing goes below 0."""
    thing, by_s = grip.thing, time_s - grip.at_s
    if not isinstance(thing, Shot):
        return {"time_s": round(max(thing.time_s + by_s, 0.0), 2)}
    start_s, end_s = thing.start_s, thing.end_s
    if grip.part == "start":
        return {"start_s": round(min(max(start_s + by_s, 0.0), max(end_s - SHORTEST_S, 0.0)), 2)}
    if grip.part == "end":
        return {"end_s": round(max(end_s + by_s, start_s + SHORTEST_S), 2)}
    by_s = max(by_s, -start_s)
    return {"start_s": round(start_s + by_s, 2), "end_s": round(end_s + by_s, 2)}


def hint(grip: Grip) -> str:
    """What can be done with it, on a line."""
    return (
        "Drag to move its end."
        if grip.edge
        else "Drag to move it."
        if grip.part == "key"
        else ("Drag to move it, its ends to make it longer or shorter.")
    )
