"""Rows of ACTIONS for files, undo, the clock and what the picture shows."""

from __future__ import annotations

from collections.abc import Callable

from ..level.framing import frame
from ..renderer.show import SHOW_FLAGS
from ..renderer.views import VIEWS
from . import time_edits
from .action import Action
from .session import Session
from .tools import BRUSH, put_away


def file_rows() -> list[Action]:
    """Files and undo."""
    return [
        Action("new", "New…", ("Ctrl+N",), "File", lambda s: s.ask("new")),
        Action("open", "Open…", ("Ctrl+O",), "File", lambda s: s.ask("open")),
        Action("save", "Save", ("Ctrl+S",), "File", _save),
        Action("save_as", "Save as…", ("Ctrl+Shift+S",), "File", lambda s: s.ask("save_as")),
        Action("import", "Import height…", (), "File", lambda s: s.ask("import")),
        Action("export", "Export…", ("Ctrl+E",), "File", lambda s: s.ask("export")),
        Action("weather_import", "Import weather map…", (), "File", lambda s: s.ask("weather_import")),
        Action("weather_export", "Export weather map…", (), "File", lambda s: s.ask("weather_export")),
        Action("quit", "Quit", ("Ctrl+Q",), "File", lambda s: s.ask("quit")),
        Action("undo", "Undo", ("Ctrl+Z",), "Edit", Session.undo, _can_undo, repeats=True),
        Action("redo", "Redo", ("Ctrl+Shift+Z", "Ctrl+Y"), "Edit", Session.redo, _can_redo, repeats=True),
        Action("abort", "Abort stroke, let go of the tool", ("Escape",), "Edit", _abort, _can_abort),
    ]


def time_rows() -> list[Action]:
    """The clock."""
    return [
        Action("pause", "Pause or run", ("Space",), "Time", Session.toggle_pause),
        Action("step", "One step on", (".",), "Time", lambda s: s.step_time(1), repeats=True),
        Action("step_back", "One step back", (",",), "Time", lambda s: s.step_time(-1), repeats=True),
        *(
            Action(name, title, keys, "Time", _wave_step(waves), repeats=True)
            for name, title, keys, waves in (
                ("tenth", "A tenth of a wave on", ("Shift+.",), 0.1),
                ("tenth_back", "A tenth of a wave back", ("Shift+,",), -0.1),
                ("wave", "One wave on", ("Ctrl+.",), 1.0),
                ("wave_back", "One wave back", ("Ctrl+,",), -1.0),
            )
        ),
        Action("marker", "Mark this moment", ("K",), "Time", time_edits.add_marker),
        Action("marker_next", "To the next marker", ("Shift+K",), "Time", _jump(1), time_edits.has_marker),
        Action("marker_before", "To the marker before", ("Ctrl+K",), "Time", _jump(-1), time_edits.has_marker),
        Action("events", "Export crest times…", (), "Time", lambda s: s.ask("events"), time_edits.has_probe),
    ]


def view_rows() -> list[Action]:
    """Overlays, views and parts of the picture."""
    return [
        Action("water", "Water", ("Shift+W",), "View", _show("water")),
        Action("walkable", "Walkable ground", ("N",), "View", lambda s: s.ask("walkable")),
        Action("outline", "Border of the level", (), "View", lambda s: s.ask("outline")),
        Action("centre", "Centre of the picture", (), "View", lambda s: s.ask("centre")),
        Action("arrows", "Arrows of the current", (), "View", lambda s: s.ask("arrows")),
        Action("streamlines", "Streamlines of the current", (), "View", lambda s: s.ask("streamlines")),
        Action("force_inset", "Pushed water in a corner", ("I",), "View", lambda s: s.ask("force_inset")),
        Action("weather_inset", "Weather map in a corner", ("Shift+I",), "View", lambda s: s.ask("weather_inset")),
        Action("front_crests", "Crests and their ghosts on the water", ("T",), "View", lambda s: s.ask("front_crests")),
        Action("front_isochrones", "Times of arrival on the water", (), "View", lambda s: s.ask("front_isochrones")),
        Action("front_speed", "Speed of fronts as colour", (), "View", lambda s: s.ask("front_speed")),
        Action("front_breakers", "Where waves break", (), "View", lambda s: s.ask("front_breakers")),
        Action("next_view", "Next view", ("F1",), "View", _view(1), repeats=True),
        Action("last_view", "View before", ("Shift+F1",), "View", _view(-1), repeats=True),
        *_show_rows(),
    ]


def finding_rows() -> list[Action]:
    """Finding a command, a place, the whole level."""
    return [
        Action("palette", "Find a command…", ("Ctrl+P",), "Edit", lambda s: s.ask("palette")),
        Action("frame", "Frame what is pointed at", ("F",), "View", Session.frame),
        Action("frame_all", "Frame the whole level", ("Shift+F",), "View", _frame_all),
    ]


def _save(session: Session) -> None:
    session.save() if session.path else session.ask("save_as")


def _can_undo(session: Session) -> bool:
    return bool(session.journal.done) or session.stroke is not None


def _can_redo(session: Session) -> bool:
    return bool(session.journal.undone)


def _abort(session: Session) -> None:
    session.stroke_abort() if session.stroke is not None else put_away(session)


def _can_abort(session: Session) -> bool:
    return session.stroke is not None or session.tool != BRUSH or bool(session.selected)


def _wave_step(waves: float) -> Callable[[Session], None]:
    return lambda session: time_edits.step_wave(session, waves)


def _jump(way: int) -> Callable[[Session], None]:
    return lambda session: time_edits.jump(session, way)


def _show(flag: str) -> Callable[[Session], None]:
    """T11: one key switches one part of the picture."""

    def run(session: Session) -> None:
        session.show = session.show.toggled(flag)

    return run


def _show_rows() -> list[Action]:
    """A row for every show flag but the water, which has its own; the first ten have a key."""
    names = [name for name in SHOW_FLAGS if name != "water"]
    keys = [f"Alt+{n % 10}" for n in range(1, 11)]
    return [
        Action(f"show.{name}", SHOW_FLAGS[name].label, tuple(keys[n : n + 1]), "View", _show(name))
        for n, name in enumerate(names)
    ]


def _view(step: int) -> Callable[[Session], None]:
    def run(session: Session) -> None:
        names = list(VIEWS)
        session.view = names[(names.index(session.view) + step) % len(names)]

    return run


def _frame_all(session: Session) -> None:
    session.camera = frame(session.level, session.camera)
