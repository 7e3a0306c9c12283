"""Shots on the timeline and in the panel (Z20)."""

import pytest
from shorewright.app.actions import ACTIONS
from shorewright.app.editor import Editor
from shorewright.app.panels.objects_panel import go_to
from shorewright.app.session import Session
from shorewright.app.timeline_drag import dragged, grip_at
from shorewright.app.timeline_marks import Strip, bars, outline, under
from shorewright.level.objects import Shot, WeatherKey
from test_weather import cloudy


def shot(name, start_s, end_s, fade_s=2.0, **fields):
    return Shot(id=name, start_s=start_s, end_s=end_s, fade_s=fade_s, **fields)


@pytest.fixture
def session():
    with Session(cloudy()) as made:
        yield made


def test_bars_lie_over_one_another(session):
    """Z20: only those in the page; what runs at the same time has another lane, what comes after the same."""
    for row in (shot("a", 0, 20), shot("b", 10, 30), shot("c", 25, 40), shot("late", 60, 70), shot("never", 9, 9)):
        session.level.put_object(row.id, row)
    assert [(bar.shot.id, bar.lane) for bar in bars(session.level, 0, 60)] == [("a", 0), ("b", 1), ("c", 0)]
    assert [bar.shot.id for bar in bars(session.level, 60, 120)] == ["late"]


def test_outline_shows_the_fades():
    """Z20: rises and falls over the fade, cut off where the page ends."""
    assert outline(shot("a", 10, 30, 5), 0, 60) == [(10, 0), (15, 1), (25, 1), (30, 0)]
    assert outline(shot("a", 10, 30, 10), 15, 60) == [(15, 0.5), (20, 1), (20, 1), (30, 0)]
    assert outline(shot("a", 10, 30, 0), 0, 20) == [(10, 0), (10, 1), (20, 1)]


def test_marks_are_found_where_they_are_drawn(session):
    """Z20: each in its lane, between its start and its end, and nothing beside them."""
    for row in (shot("a", 0, 20), shot("b", 10, 30)):
        session.level.put_object(row.id, row)
    strip = Strip(100.0, 10.0, 700.0, 34.0, 0.0, 60.0)  # ten pixels a second

    def found(x, y):
        return [thing.id for thing in under(session.level, strip, x, y)]

    assert found(250.0, 30.0) == ["a"]
    assert found(250.0, 24.0) == ["b"]
    assert found(350.0, 30.0) == found(150.0, 24.0) == found(250.0, 14.0) == []


def test_a_press_takes_hold_of_ends_shots_and_keys(session):
    """Z20 D36: an end within some pixels, else the shot; where two meet the side of the pointer decides."""
    for row in (shot("a", 0, 20), shot("b", 20, 70), WeatherKey(id="k", time_s=30.0)):
        session.level.put_object(row.id, row)
    strip = Strip(100.0, 10.0, 700.0, 34.0, 0.0, 60.0)

    def held(x, y=30.0):
        grip = grip_at(session.level, strip, x, y)
        return (grip.thing.id, grip.part) if grip else None

    assert [held(x) for x in (102, 200, 298, 302, 690)] == [
        ("a", "start"), ("a", "whole"), ("a", "end"), ("b", "start"), ("b", "whole")]  # fmt: skip
    assert held(400, 16.0) == ("k", "key")
    assert held(200, 20.0) is None


def test_a_drag_keeps_marks_whole():
    """Z20 D36: ends do not cross, nothing starts before 0, a shot that is moved stays as long."""
    from shorewright.app.timeline_drag import SHORTEST_S, Grip

    row, key = shot("a", 10, 30), WeatherKey(id="k", time_s=30.0)
    assert dragged(Grip(row, "start", 10.0), 14.0) == {"start_s": 14.0}
    assert dragged(Grip(row, "start", 10.0), 90.0) == {"start_s": 30.0 - SHORTEST_S}
    assert dragged(Grip(row, "end", 31.0), 3.0) == {"end_s": 10.0 + SHORTEST_S}
    assert dragged(Grip(row, "whole", 20.0), 25.0) == {"start_s": 15.0, "end_s": 35.0}
    assert dragged(Grip(row, "whole", 20.0), 5.0) == {"start_s": 0.0, "end_s": 20.0}
    assert dragged(Grip(key, "key", 30.0), 12.5) == {"time_s": 12.5}


def test_actions_make_shots_and_take_them_back(session):
    """Z20: a shot of now and one of the paint, in hand at once; its sky becomes the paint."""
    session.clock.time_s = 4.0
    ACTIONS["shot"].run(session)
    assert session.level.objects[session.selected].start_s == 4.0
    ACTIONS["shot_paint"].run(session)
    assert session.selected == "shot-2"
    assert ACTIONS["shot_to_paint"].enabled(session)
    ACTIONS["shot_to_paint"].run(session)
    assert not session.level.layers["weather"].neutral
    session.selected = ""
    assert not ACTIONS["shot_to_paint"].enabled(session)


def test_double_click_goes_to_a_shot(session):
    """Z20: to a moment at which it is whole, through its camera's eyes."""
    session.place({"kind": "camera", "id": "there", "x": 30.0, "y": 20.0, "z": 50.0})
    session.shot_add("mine", 10.0, 30.0, 5.0, camera="there")
    editor = Editor(session)
    go_to(editor, "mine")
    assert session.clock.time_s == 15.0
    assert editor.gliding
