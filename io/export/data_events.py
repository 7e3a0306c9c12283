"""NAME_events.json: when crests come to a level's probes, and when these get wet and dry, over a stated span."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, Literal

from pydantic import BaseModel, Field

from ...level import Level
from ...level.settings import Time
from .data_axes import Frame
from .data_models import DataFile, Record

SPAN_S = 60.0  # from time 0, without a loop
MOST_S = 600.0


class Event(Record):
    time_s: float = Field(description="On the level's clock.")
    kind: Literal["crest", "wet", "dry"] = Field(
        description="A crest is there; the ground comes under water; the water is gone from it."
    )
    probe: str = Field(description="Id of the probe, of NAME_objects.json.")
    height_m: float = Field(description="Height of the water then, in the level.")


class Start(Record):
    """A probe of NAME_objects.json, and whether it is under water when the span begins."""

    id: str
    wet: bool


class EventsFile(DataFile):
    """What happens at the level's probes, in order of time; events of the sea as it is in the editor."""

    from_s: float = Field(description="Events are listed from here.")
    to_s: float = Field(description="Till here.")
    repeats_s: float = Field(description="The loop after which they come again; 0: there is none, or it is longer.")
    probes: list[Start]
    events: list[Event]


def span(time: Time) -> tuple[float, float, float]:
    """From, to, and the loop: what is played in a loop, the sea's own loop, or a minute."""
    if time.loop_end_s > time.loop_start_s:
        first, last = time.loop_start_s, time.loop_end_s
    else:
        first, last = 0.0, time.loop_s or SPAN_S
    whole = time.loop_s if 0 < time.loop_s <= min(last - first, MOST_S) else 0.0
    return first, min(last, first + MOST_S), whole


def make(level: Level, frame: Frame) -> dict[str, Any] | None:
    """None without probes."""
    from ...level.probes import events, is_wet, probes_of, wet_and_dry

    first, last, whole = span(level.settings.time)
    probes = [{"id": probe.id, "wet": is_wet(level, probe, first)} for probe in probes_of(level)]
    if not probes:
        return None
    rows = [*events(level, first, last), *wet_and_dry(level, first, last)]
    rows.sort(key=lambda row: (row["time_s"], row["probe"], row["kind"]))
    return {"from_s": first, "to_s": last, "repeats_s": whole, "probes": probes, "events": rows}


def off(level: Level, file: BaseModel) -> float:
    """How far the surface at an event is off the height that is told of it, cm."""
    from ...level.probes import heights_at

    at = {probe.id: level.objects[probe.id] for probe in file.probes}
    found = [
        abs(float(heights_at(level, event.time_s, at[event.probe].x, at[event.probe].y)) - event.height_m)
        for event in file.events
    ]
    return 100 * max(found, default=0.0)


def check(file, others: dict[str, BaseModel], manifest) -> list[str]:
    """Findings: order and span, probes that there are, water that this level can have."""
    findings = []
    if any(b.time_s < a.time_s for a, b in pairwise(file.events)):
        findings.append("its events are not in order of time")
    if any(not file.from_s <= event.time_s <= file.to_s for event in file.events):
        findings.append(f"an event lies outside {file.from_s:g} to {file.to_s:g} s")
    objects = others.get("objects")
    ids = [probe.id for probe in file.probes]
    known = ids if objects is None else sorted(probe.id for probe in objects.probe)
    if ids != known or any(event.probe not in known for event in file.events):
        findings.append("it names a probe that the level has not")
    far = manifest.world.height_max_m - manifest.world.height_min_m + 100.0
    if any(abs(event.height_m - manifest.world.sea_level_m) > far for event in file.events):
        findings.append("an event has a height that no sea of this level reaches")
    return findings
