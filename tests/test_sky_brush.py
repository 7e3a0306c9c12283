"""The weather brush between world, clock and map (T04): a session without a window, the panel's square, named skies."""

import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shorewright.app import script, sky_brush
from shorewright.app.map_sight import CLOSEST_M, Sight
from shorewright.app.session import Session
from shorewright.brushes import BRUSHES
from shorewright.level import BadInput, Grid
from shorewright.level.cloud_types import CLOUD_TYPES
from shorewright.level.pick_sky import bend_m
from shorewright.level.weather import TILE_M, drift_m, weather_at


@pytest.fixture
def session(tmp_path):
    with Session.new(Grid(65, 65), spill_root=tmp_path) as session:
        session.pick_brush("weather")
        yield session


def sky(session):
    return session.level.layers["weather"].array


def stroke(session, *places):
    sky_brush.press(session, *places[0])
    for place in places[1:]:
        sky_brush.drag(session, *place)
    session.stroke_end()


@pytest.mark.parametrize("name", CLOUD_TYPES)
@pytest.mark.parametrize("time_s", [0.0, 4321.5])
def test_a_named_sky_is_what_is_shown_where_it_was_painted(session, name, time_s):
    """At the world place that was pointed at, at that time; and the wind carries it on."""
    session.scrub(time_s)
    sky_brush.choose(session, name)
    assert sky_brush.chosen(session) == name
    assert sky_brush.in_hand(session)
    place = (5000.0, -9000.0)
    stroke(session, place)
    want, level = CLOUD_TYPES[name], session.level
    shown = weather_at(level, time_s, *place, stage="painted")
    np.testing.assert_allclose(shown, [want.coverage, want.precipitation, want.type, 1], atol=2e-3)
    later = time_s + 500
    moved = place + drift_m(level, later) - drift_m(level, time_s)
    np.testing.assert_allclose(weather_at(level, later, *moved, stage="painted"), shown, atol=2e-3)


def test_named_skies_are_told_apart():
    rows = list(CLOUD_TYPES.values())
    assert len({tuple(row.values.values()) for row in rows}) == len(rows)
    for row in rows:
        assert CLOUD_TYPES[row.name] is row
        assert row.doc.endswith(".")
        assert all(0 <= value <= 1 for value in row.values.values())


def test_an_unknown_sky_is_one_sentence(session):
    with pytest.raises(BadInput, match="no sky is called 'pink'"):
        sky_brush.choose(session, "pink")


def test_a_stroke_plays_again_at_any_time(session, tmp_path):
    """Recordings hold metres of the moving air: the clock doesn't count when they are replayed, nor does the file."""
    session.scrub(777.0)
    sky_brush.choose(session, "showers")
    stroke(session, (0, 3000), (4000, 3500), (9000, -2000))
    recorded = json.loads(json.dumps(script.Script(actions=session.record).dump()))
    with Session.new(Grid(65, 65), spill_root=tmp_path) as other:
        other.scrub(31_000.0)
        other.run(recorded)
        assert sky(other).tobytes() == sky(session).tobytes()
        other.save(tmp_path / "other.shore")
    with Session.open(tmp_path / "other.shore") as saved:
        assert sky(saved).tobytes() == sky(session).tobytes()


def test_a_hand_goes_on_over_the_border(session):
    """The map is a torus: a line from one side of it to the other stays a line, however long the hand's steps are."""
    session.scrub(250.0)
    edge = TILE_M / 2 + drift_m(session.level, 250.0)[0]
    sky_brush.press(session, edge - 800, 0)
    for x in (edge + 900, edge + 2600, edge + 2600 + 60_000, edge + 40_000):
        sky_brush.drag(session, x, 0)
    xs = [sample.x for sample in session.stroke.samples]
    assert np.diff(xs) == pytest.approx([1700, 1700, 60_000, -22_600])
    session.stroke_end()
    assert (sky(session)[..., 3] > 0).any(axis=0).all()
    assert (sky(session)[..., 3] > 0).mean() < 0.2


def test_a_hand_that_stands_paints_on_only_as_the_air_moves(session):
    sky_brush.press(session, 0, 0)
    for step in range(1, 100):
        session.clock.time_s = step / 10
        sky_brush.drag(session, 0, 0)
    way_m = session.level.settings.weather.wind_mps * 9.9
    assert 2 <= len(session.stroke.samples) <= 1 + way_m / (sky_brush.STILL_CELLS * 136.7)
    session.stroke_abort()
    session.set("weather.paint_drifts", False)
    sky_brush.press(session, 0, 0)
    session.clock.time_s = 500.0
    sky_brush.drag(session, 0, 0)
    assert len(session.stroke.samples) == 1


def test_the_whole_sky_is_filled_and_erased_in_one_step_each(session):
    """Every texel of the torus, whatever the brush's size and softness; only the channels that are painted."""
    sky_brush.choose(session, "stratus")
    session.set_param("paint_type", False)
    sky_brush.fill(session)
    assert len(session.journal.done) == 1
    np.testing.assert_allclose(sky(session).reshape(-1, 6).min(axis=0), [1, 0, 0, 1, 1, 0], atol=1e-3)
    np.testing.assert_allclose(sky(session).reshape(-1, 6).max(axis=0), [1, 0, 0, 1, 1, 0], atol=1e-3)
    sky_brush.fill(session, "erase")
    assert not sky(session).any()
    session.undo()
    session.undo()
    assert session.level.layers["weather"].neutral
    assert session.params["weather"].size_m == 4000


def test_parameters_that_mean_nothing_are_not_shown(session):
    """Targets only where they are painted, the step only where it is added."""
    idle = BRUSHES["weather"].effect.idle
    params = session.params["weather"]
    assert idle(params) == {"step"}
    assert idle(params.model_copy(update={"paint_type": False})) == {"step", "type"}
    assert idle(params.model_copy(update={"mode": "add"})) == {"coverage", "precipitation", "type"}
    assert idle(params.model_copy(update={"mode": "smooth"})) == {"coverage", "precipitation", "type", "step"}


def test_the_eyedropper_takes_what_is_shown(session):
    """And what it took, painted elsewhere, is the same sky."""
    there = (2000.0, 4000.0)
    taken = sky_brush.take(session, *there)
    shown = weather_at(session.level, 0.0, *there, stage="painted")
    assert list(taken.values()) == pytest.approx(shown[:3], abs=1e-3)
    stroke(session, (-6000.0, 0.0))
    assert weather_at(session.level, 0.0, -6000.0, 0.0, stage="painted")[:3] == pytest.approx(shown[:3], abs=3e-3)


def test_what_the_status_bar_says(session):
    sky_brush.choose(session, "thunderstorm")
    before = sky_brush.sentence(sky_brush.sky_at(session, 1000.0, 1000.0))
    stroke(session, (1000.0, 1000.0))
    after = sky_brush.sentence(sky_brush.sky_at(session, 1000.0, 1000.0))
    assert before.endswith("simulated")
    assert "cumulonimbus" in after
    assert after.endswith("100% painted")


def test_the_ring_lies_on_the_shell(session):
    """At the brush's radius about what is pointed at, bent with the planet."""
    level, camera = session.level, session.camera
    ring = sky_brush.shell_circle(session, (9000.0, -3000.0, 0.0), 4000.0)
    np.testing.assert_allclose(np.hypot(ring[:, 0] - 9000, ring[:, 1] + 3000), 4000)
    away = np.hypot(ring[:, 0] - camera.x, ring[:, 1] - camera.y)
    base_m = level.settings.clouds.base_m
    np.testing.assert_allclose(ring[:, 2] + bend_m(level, away, base_m), base_m)
    assert np.ptp(ring[:, 2]) > 1


# The panel's square

SIGHTS = st.builds(Sight, st.floats(-3e4, 3e4), st.floats(-3e4, 3e4), st.floats(CLOSEST_M, TILE_M), st.floats(96, 560))


@given(SIGHTS, st.floats(0, 500), st.floats(0, 500), st.floats(-6, 6))
def test_a_place_stays_under_the_pointer_while_the_map_is_zoomed(sight, px, py, notches):
    place = sight.world(px, py)
    assert sight.pixels(*place) == pytest.approx([px, py], abs=1e-6)
    zoomed = sight.zoomed(px, py, notches)
    assert zoomed.world(px, py) == pytest.approx(place, abs=1e-6)
    assert CLOSEST_M <= zoomed.span_m <= TILE_M
    assert zoomed.panned(3, -4).pixels(*place) == pytest.approx([px + 3, py - 4], abs=1e-6)


@given(SIGHTS)
def test_the_map_is_north_up_and_its_scale_a_round_number(sight):
    x, y = sight.grid(8)
    assert (np.diff(x, axis=1) > 0).all()
    assert (np.diff(y, axis=0) > 0).all()
    assert sight.pixels(sight.east_m, sight.north_m + 100)[1] < sight.side / 2
    assert sight.span_m / 5 - 1e-6 <= sight.scale_m <= sight.span_m / 2 + 1e-6
    digit = sight.scale_m / 10 ** math.floor(math.log10(sight.scale_m) + 1e-9)
    assert min(abs(digit - nice) for nice in (1, 2, 5, 10)) < 1e-6


def test_the_camera_s_own_shot_is_what_is_read_and_taken(session):
    """T04 Z20: status bar and eyedropper tell the sky of the picture, with the shots of its camera, not of another."""
    even = np.broadcast_to(np.float32([0.875, 0.25, 0.5]), (512, 512, 3))
    session.shot_add("mine", 0.0, 100.0, 0.0, camera=session.camera.id, source=even)
    session.scrub(50.0)
    at = session.camera.x + 100.0, session.camera.y
    assert sky_brush.sky_at(session, *at).precipitation == pytest.approx(0.25, abs=1e-3)
    assert sky_brush.take(session, *at)["coverage"] == pytest.approx(0.875, abs=1e-3)
    session.camera = session.camera.model_copy(update={"id": "another"})
    assert sky_brush.take(session, *at)["precipitation"] != pytest.approx(0.25, abs=1e-3)
