"""Rows of ACTIONS for light, weather and what is placed in the level."""

from __future__ import annotations

from collections.abc import Callable

from ..level.environments import ENVIRONMENTS
from ..level.objects import River, Shot, WaveObject
from ..level.weather_presets import WEATHERS
from . import placing
from .action import Action
from .session import Session
from .tools import TOOLS, Tool, pick_tool


def air_rows() -> list[Action]:
    """Named light and weather, storms."""
    return [
        *(Action(f"light.{row.name}", row.label, (), "Light", _environment(row.name)) for row in ENVIRONMENTS.values()),
        *(Action(f"weather.{row.name}", row.label, (), "Weather", _weather(row.name)) for row in WEATHERS.values()),
        Action("storm", "Bring a storm", (), "Weather", _storm),
        Action("storm_end", "End the storm", (), "Weather", _storm_end, _has_storm),
    ]


def place_rows() -> list[Action]:
    """What is dropped or placed; shots."""
    return [
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
    ]


def object_rows() -> list[Action]:
    """The object in hand."""
    return [
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


def _has_object(session: Session) -> bool:
    return session.selected in session.level.objects


def _fit(place: bool) -> Callable[[Session], None]:
    return lambda session: session.fit_wave(session.selected, place)


def _has_wave(session: Session) -> bool:
    return isinstance(session.level.objects.get(session.selected), WaveObject)


def _river(verb: str) -> Callable[[Session], None]:
    return lambda session: getattr(session, verb)(session.selected)


def _has_river(session: Session) -> bool:
    return isinstance(session.level.objects.get(session.selected), River)
