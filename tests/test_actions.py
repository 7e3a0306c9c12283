"""ACTIONS: each row runs on a session without a window (T05, T08, T10, T11)."""

import re

import pytest
from shorewright.app.actions import ACTIONS, by_key
from shorewright.app.invariants import broken
from shorewright.app.session import Session
from shorewright.brushes import BRUSHES
from shorewright.level import Grid

# What the editor promises its keyboard does.
PROMISED = {
    "Space": "pause", ".": "step", ",": "step_back", "[": "smaller", "]": "larger", "{": "weaker", "}": "stronger",
    "Shift+W": "water", "Ctrl+Z": "undo", "Ctrl+Shift+Z": "redo", "Ctrl+Y": "redo", "Ctrl+S": "save", "F": "frame",
    "Escape": "abort", "Ctrl+O": "open", "Ctrl+N": "new",
}  # fmt: skip


@pytest.fixture
def session(tmp_path):
    with Session.new(Grid(80, 90), spill_root=tmp_path) as session:
        session.drag("raise", (40, 40), (60, 50), size_m=8)
        yield session


@pytest.mark.parametrize("name", ACTIONS)
def test_every_row_runs(session, name):
    """A row may change the session, leave a request, or do nothing; it never breaks the level."""
    action = ACTIONS[name]
    if action.enabled(session):
        action.run(session)
    assert broken(session) == []
    assert action.title
    menus = ("", "File", "Edit", "Time", "View", "Brush", "Place", "Light", "Weather", "In the middle")
    assert action.menu in (*menus, "Clouds to paint")


@pytest.mark.parametrize(("keys", "name"), PROMISED.items())
def test_promised_keys(keys, name):
    assert by_key(keys).id == name


def test_number_keys_pick_the_brushes(session):
    """1 … 9 and 0 in the order of the table, then letters."""
    for key, name in zip("1234567890JU", BRUSHES, strict=True):
        by_key(key).run(session)
        assert session.brush == name
        assert BRUSHES[name].key == key


def test_no_key_has_two_meanings():
    keys = [key for row in ACTIONS.values() for key in row.keys]
    assert len(keys) == len(set(keys))
    assert all(
        re.fullmatch(r"((Ctrl|Shift|Alt)\+)*(Space|Escape|Delete|F\d+|[A-Z0-9]|[\[\]{}.,])", key) for key in keys
    )


def test_pause_steps_and_time(session):
    """T05: Space stops the world, . and , move it by whole steps while it stands."""
    assert session.advance(0.5) > 0
    by_key("Space").run(session)
    at = session.clock.time_s
    assert session.advance(0.5) == 0
    assert session.clock.time_s == at
    by_key(".").run(session)
    by_key(".").run(session)
    by_key(",").run(session)
    step = session.clock.step_s
    assert session.clock.time_s == pytest.approx((round(at / step) + 1) * step)
    by_key("Space").run(session)
    assert session.advance(0.5) > 0


def test_brush_keys_stay_within_the_range(session):
    session.set_param("size_m", 10)
    by_key("]").run(session)
    assert session.params["raise"].size_m > 10
    for _ in range(300):
        by_key("[").run(session)
        by_key("{").run(session)
    assert session.params["raise"].size_m == pytest.approx(0.01)
    assert session.params["raise"].strength >= 0


def test_water_is_a_show_flag_and_not_an_edit(session):
    """T11: one key, and the level is as it was."""
    steps, settings = len(session.journal.done), session.level.settings
    by_key("Shift+W").run(session)
    assert "water" not in session.show
    by_key("Shift+W").run(session)
    assert "water" in session.show
    assert (len(session.journal.done), session.level.settings) == (steps, settings)


def test_frame_brings_the_pointer_into_the_middle(session):
    """F: the camera keeps its direction and looks at what is under the pointer."""
    before = session.camera
    session.cursor = (30.0, 50.0, 1.0)
    by_key("F").run(session)
    assert session.camera.yaw_deg == before.yaw_deg
    assert (session.camera.x, session.camera.y) != (before.x, before.y)
    session.cursor = None
    by_key("F").run(session)


def test_undo_and_abort_through_the_rows(session):
    """T08: Ctrl+Z, Ctrl+Y and Esc on the session alone."""
    after = session.level.height.copy()
    by_key("Ctrl+Z").run(session)
    assert not by_key("Ctrl+Z").enabled(session)
    before = session.level.height.copy()
    assert (before != after).any()
    by_key("Ctrl+Y").run(session)
    assert (session.level.height == after).all()
    session.stroke_begin(20, 20)
    session.stroke_move(30, 30)
    by_key("Escape").run(session)
    assert (session.level.height == after).all()
    assert not by_key("Escape").enabled(session)


def test_requests_wait_for_a_window(session):
    by_key("Ctrl+O").run(session)
    by_key("Ctrl+S").run(session)  # it has no folder yet
    assert list(session.requests) == ["open", "save_as"]


def test_views_go_round(session):
    """F1 goes through every buffer and mask and ends where it began."""
    from shorewright.renderer.views import VIEWS

    seen = []
    for _ in VIEWS:
        by_key("F1").run(session)
        seen.append(session.view)
    assert sorted(seen) == sorted(VIEWS)
    assert session.view == "final"
