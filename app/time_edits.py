"""The clock by hand: steps by a part of a wave, markers on the timeline, crest times to a file (T05, T06)."""

from __future__ import annotations

from pathlib import Path

from ..level import BadInput
from ..level.objects import Marker
from ..level.probes import events, probes_of
from ..level.timing import period_s
from . import placing
from .session import Session

SAME_S = 1e-6
LONGEST_S = 3600.0


def wave_s(session: Session) -> float:
    """The period of the shore waves now: as the loop makes it, or the leading swell's."""
    return period_s(session.level, session.clock.time_s)


def step_wave(session: Session, waves: float) -> None:
    """On (or, negative, back) by a part of a wave's period, paused there."""
    if not session.clock.paused:
        session.pause()
    session.scrub(session.clock.time_s + waves * wave_s(session))


def markers_of(session: Session) -> list[Marker]:
    """By time."""
    found = (thing for thing in session.level.objects.values() if isinstance(thing, Marker))
    return sorted(found, key=lambda marker: (marker.time_s, marker.id))


def add_marker(session: Session) -> str:
    """A marker at the clock's time; returns its id."""
    return placing.put(session, "marker")


def jump(session: Session, way: int) -> None:
    """To the next marker, or (−1) to the one before, and take it in hand; nothing where there is none."""
    now = session.clock.time_s
    found = [marker for marker in markers_of(session)[::way] if way * (marker.time_s - now) > SAME_S]
    if found:
        session.scrub(found[0].time_s)
        session.selected = found[0].id


def has_marker(session: Session) -> bool:
    return any(isinstance(thing, Marker) for thing in session.level.objects.values())


def has_probe(session: Session) -> bool:
    return bool(probes_of(session.level))


def export_events(session: Session, path: Path | str, first_s: float, last_s: float) -> int:
    """Write when crests come to the level's probes from one moment to another; returns how many."""
    from ..io.events import write_events

    if not has_probe(session):
        raise BadInput("this level has no probe: place one where the crests are to be timed")
    if not 0 <= last_s - first_s <= LONGEST_S:
        raise BadInput(f"crests are timed over 0 to {LONGEST_S:g} s, not from {first_s:g} to {last_s:g} s")
    rows = events(session.level, first_s, last_s)
    write_events(path, rows)
    return len(rows)
