"""ACTIONS: every command of the editor declared once; menus, shortcuts, palette and tests read these rows.

`keys` are text such as `Ctrl+Shift+Z`, as printed on a US keyboard; `run` works on a `Session`, window or not.
What needs a person's answer (which file?) leaves a request with `Session.ask`, and the window answers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from ..brushes import BRUSHES
from ..level.cloud_types import CLOUD_TYPES
from ..level.environments import ENVIRONMENTS
from ..level.framing import frame
from ..level.objects import River, Shot, WaveObject
from ..level.weather_presets import WEATHERS
from ..renderer.show import SHOW_FLAGS
from ..renderer.views import VIEWS
from . import placing, sky_brush, time_edits
from .session import Session
from .tools import BRUSH, TOOLS, Tool, pick_tool, put_away

SIZE_STEP = 1.12  # one press of [ or ]
STRENGTH_STEP = 1.15


@dataclass(frozen=True)
class Action:
    """A row: `menu` is where it stands ("" for nowhere), `enabled` whether it can do something now."""

    id: str
    title: str
    keys: tuple[str, ...]
    menu: str
    run: Callable[[Session], object]
    enabled: Callable[[Session], bool] = lambda session: True
    repeats: bool = False  # holding the key goes on


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


def _environment(name: str) -> Callable[[Session], None]:
    """L02: all of a named light and air, as one step."""
    row = ENVIRONMENTS[name]
    return lambda session: session.set_all(f"{row.label} light", row.values)


def _weather(name: str) -> Callable[[Session], None]:
    """D36: all of a named weather, as one step."""
    row = WEATHERS[name]
    return lambda session: session.set_all(f"{row.label} weather", row.values)


def _storm(session: Session) -> None:
    """Z23: a storm sets out upwind now."""
    now = min(session.clock.time_s, 1e7)
    session.set_all("Bring a storm", {"clouds.on": True, "storm.chance": 1.0, "storm.start_s": now})


def _storm_end(session: Session) -> None:
    session.set_all("End the storm", {"storm.chance": 0.0})


def _has_storm(session: Session) -> bool:
    return session.level.settings.storm.chance > 0


def _frame_all(session: Session) -> None:
    session.camera = frame(session.level, session.camera)


def _save(session: Session) -> None:
    session.save() if session.path else session.ask("save_as")


def _brush(name: str) -> Callable[[Session], None]:
    return lambda session: session.pick_brush(name)


def _rows() -> list[Action]:
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
        *(Action(f"light.{row.name}", row.label, (), "Light", _environment(row.name)) for row in ENVIRONMENTS.values()),
        *(Action(f"weather.{row.name}", row.label, (), "Weather", _weather(row.name)) for row in WEATHERS.values()),
        Action("storm", "Bring a storm", (), "Weather", _storm),
        Action("storm_end", "End the storm", (), "Weather", _storm_end, _has_storm),
        *(Action(f"tool.{row.name}", _tool_title(row), row.keys, "Place", _tool(row.name)) for row in TOOLS.values()),
        Action("prop_file", "Prop from a file…", (), "Place", lambda s: s.ask("prop")),
        *(
            Action(f"place.{row.name}", f"{row.title} in the middle", (), "In the middle", _put(row.name))
            for row in placing.PLACEABLES.values()
        ),
        Action("shot", "New shot from the sky now", (), "Weather", _put("shot")),
        Action("shot_paint", "New shot from the paint", (), "Weather", _shot_of_paint),
        Action("shot_file", "New shot from a weather map…", (), "Weather", lambda s: s.ask("shot_file")),
        Action("shot_to_paint", "Lay the shot's sky into the paint", (), "Weather", _shot_to_paint, _has_shot),
        Action("object.delete", "Delete the object", ("Delete",), "Edit", placing.delete, _has_object),
        Action("object.duplicate", "Duplicate the object", ("Ctrl+D",), "Edit", placing.duplicate, _has_object),
        Action("object.left", "Turn the object left", ("Ctrl+[",), "Edit", _turn(-15.0), _has_object, repeats=True),
        Action("object.right", "Turn the object right", ("Ctrl+]",), "Edit", _turn(15.0), _has_object, repeats=True),
        Action("wave.fit", "Fit the wave to the bay", (), "Place", _fit(False), _has_wave),
        Action("wave.fit_place", "Fit the wave to the bay and move it there", (), "Place", _fit(True), _has_wave),
        Action(
            "river.snap",
            "Bring the river down to the ground that it runs over",
            (),
            "Place",
            _river("river_snap"),
            _has_river,
        ),
        Action("river.carve", "Carve the bed that the river needs", (), "Place", _river("river_carve"), _has_river),
        Action("palette", "Find a command…", ("Ctrl+P",), "Edit", lambda s: s.ask("palette")),
        Action("frame", "Frame what is pointed at", ("F",), "View", Session.frame),
        Action("frame_all", "Frame the whole level", ("Shift+F",), "View", _frame_all),
        Action("smaller", "Smaller brush", ("[",), "Brush", _scale("size_m", 1 / SIZE_STEP), repeats=True),
        Action("larger", "Larger brush", ("]",), "Brush", _scale("size_m", SIZE_STEP), repeats=True),
        Action("weaker", "Weaker brush", ("{",), "Brush", _scale("strength", 1 / STRENGTH_STEP), repeats=True),
        Action("stronger", "Stronger brush", ("}",), "Brush", _scale("strength", STRENGTH_STEP), repeats=True),
        *(
            Action(f"brush.{brush.name}", brush.label, (brush.key,) if brush.key else (), "Brush", _brush(brush.name))
            for brush in BRUSHES.values()
        ),
        Action("alpha", "Shape of the brush from a file…", (), "Brush", lambda s: s.ask("alpha"), _takes_alpha),
        Action("sky.fill", "Paint all of the sky", (), "Brush", sky_brush.fill),
        Action("sky.erase", "Erase all painted weather", (), "Brush", _erase_sky, _has_sky),
        *(
            Action(f"cloud.{row.name}", row.label, (), "Clouds to paint", _cloud(row.name))
            for row in CLOUD_TYPES.values()
        ),
    ]


def _wave_step(waves: float) -> Callable[[Session], None]:
    return lambda session: time_edits.step_wave(session, waves)


def _jump(way: int) -> Callable[[Session], None]:
    return lambda session: time_edits.jump(session, way)


def _cloud(name: str) -> Callable[[Session], None]:
    return lambda session: sky_brush.choose(session, name)


def _tool(name: str) -> Callable[[Session], None]:
    return lambda session: pick_tool(session, name)


def _tool_title(row: Tool) -> str:
    return f"Drop: {row.title.lower()}" if row.name in placing.PLACEABLES else row.title


def _put(name: str) -> Callable[[Session], object]:
    return lambda session: placing.put(session, name)


def _shot_of_paint(session: Session) -> None:
    session.selected = session.shot_add(source="paint")


def _shot_to_paint(session: Session) -> None:
    session.shot_to_paint(session.selected)


def _has_shot(session: Session) -> bool:
    shot = session.level.objects.get(session.selected)
    return isinstance(shot, Shot) and shot.map in session.level.skies


def _turn(degrees: float) -> Callable[[Session], None]:
    return lambda session: placing.turn(session, degrees)


def _abort(session: Session) -> None:
    session.stroke_abort() if session.stroke is not None else put_away(session)


def _can_abort(session: Session) -> bool:
    return session.stroke is not None or session.tool != BRUSH or bool(session.selected)


def _takes_alpha(session: Session) -> bool:
    return "alpha" in type(session.params[session.brush]).model_fields


def _has_object(session: Session) -> bool:
    return session.selected in session.level.objects


def _has_wave(session: Session) -> bool:
    return isinstance(session.level.objects.get(session.selected), WaveObject)


def _has_river(session: Session) -> bool:
    return isinstance(session.level.objects.get(session.selected), River)


def _river(verb: str) -> Callable[[Session], None]:
    return lambda session: getattr(session, verb)(session.selected)


def _fit(place: bool) -> Callable[[Session], None]:
    return lambda session: session.fit_wave(session.selected, place)


def _erase_sky(session: Session) -> object:
    return sky_brush.fill(session, "erase")


def _has_sky(session: Session) -> bool:
    return not session.level.layers["weather"].neutral


def _view(step: int) -> Callable[[Session], None]:
    def run(session: Session) -> None:
        names = list(VIEWS)
        session.view = names[(names.index(session.view) + step) % len(names)]

    return run


def _scale(name: str, factor: float) -> Callable[[Session], None]:
    return lambda session: session.scale_param(name, factor)


def _can_undo(session: Session) -> bool:
    return bool(session.journal.done) or session.stroke is not None


def _can_redo(session: Session) -> bool:
    return bool(session.journal.undone)


ACTIONS: dict[str, Action] = {row.id: row for row in _rows()}


def by_key(keys: str) -> Action | None:
    """The row a shortcut stands for."""
    return next((row for row in ACTIONS.values() if keys in row.keys), None)
