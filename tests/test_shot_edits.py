"""Shots as edits (Z20): from sky, paint, files and arrays; undo, scripts, the recovery log, the command line."""

import io
import json

import numpy as np
import pytest
from shorewright.app import recovery_record
from shorewright.app.cli import main
from shorewright.app.session import Session
from shorewright.io import read_level, write_level
from shorewright.io.images import write_image
from shorewright.level import BadInput, Rect
from shorewright.level.layers import WEATHER_GRID
from shorewright.level.objects import Shot
from shorewright.level.weather import texel_metres, weather_at
from test_shots import waves_sky
from test_weather import cloudy, paint


@pytest.fixture
def session():
    level = cloudy()
    level.set("weather.growth_s", 60.0)
    paint(level, Rect(150, 180, 300, 330), 0.875, 0.5, 0.25, 0.75)
    with Session(level) as made:
        yield made


def sky_over(session, time_s):
    """The map before the horizon, at some places of the world."""
    x, y = (axis[::16, ::16] for axis in texel_metres())
    return weather_at(session.level, time_s, x, y, None, "painted")[..., :3]


def close(one, other):
    """The same but for half a cell of the map: where it begins to rain a cell makes a difference."""
    away = np.abs(one - other)
    return away.mean() < 0.005 and np.quantile(away, 0.9) < 0.02


def test_shot_of_the_sky_now_looks_the_same_and_stays(session):
    """Z20: at its start the picture is as it was without; later the simulation has gone on, the shot has not."""
    session.clock.time_s = 77.0
    session.level.set("weather.wind_mps", 0.0)
    before, later = sky_over(session, 77.0), sky_over(session, 90.0)
    name = session.shot_add(fade_s=0.0, camera="")
    shot = session.level.objects[name]
    assert (shot.start_s, shot.end_s) == (77.0, 97.0)
    assert close(sky_over(session, 77.0), before)
    assert np.abs(sky_over(session, 90.0) - later).max() > 0.1
    session.level.put_object(name, shot.model_copy(update={"start_s": 80.0, "end_s": 99.0}))
    session.level.set("weather.painted", False)
    assert close(sky_over(session, 90.0), before)


def test_shot_of_the_paint_goes_back_into_it(session):
    """Z20: the paint lies where it had drifted to, exactly; taken back, it is the paint again."""
    session.level.set("weather.wind_mps", 50.0)
    painted = np.array(session.level.layers["weather"].array)
    name = session.shot_add(start_s=300.0, end_s=400.0, fade_s=0.0, source="paint")
    session.level.set("weather.painted", False)
    shown = sky_over(session, 300.0)
    session.level.set("weather.painted", True)
    assert close(shown, sky_over(session, 300.0))
    session.shot_to_paint(name)
    assert (session.level.layers["weather"].array[..., 3:] == 1).all()
    assert session.level.objects[name].painted
    session.remove(name)
    assert close(sky_over(session, 300.0), shown)
    session.undo()
    session.undo()
    np.testing.assert_array_equal(session.level.layers["weather"].array, painted)


def test_array_comes_and_goes_bit_for_bit(session):
    """Z20: an array is the sky as it is, and the paint too once it is taken back."""
    sky = waves_sky()
    name = session.shot_add("mine", 0.0, 10.0, source=sky)
    np.testing.assert_array_equal(session.level.skies[session.level.objects[name].map], sky)
    session.shot_to_paint(name)
    np.testing.assert_array_equal(session.level.layers["weather"].array[..., :3], sky.astype(np.float32))


def test_image_becomes_a_shot(session, tmp_path):
    """Z20: north on top; what is no map is refused and leaves nothing."""
    sky = waves_sky()
    write_image(tmp_path / "front.exr", np.ascontiguousarray(sky[::-1]), half=True)
    name = session.shot_add(source=tmp_path / "front.exr")
    np.testing.assert_array_equal(session.level.skies[session.level.objects[name].map], sky)
    assert session.level.objects[name].map.startswith("front_")
    objects = dict(session.level.objects)
    with pytest.raises(BadInput):
        session.shot_add(source=tmp_path / "none.png")
    assert session.level.objects == objects


def test_every_way_is_one_step_and_a_word(session, tmp_path):
    """Z20 T08: undo takes each away, redo brings it, a script of it makes the same level."""
    session.clock.time_s = 12.0
    write_image(tmp_path / "front.exr", np.ascontiguousarray(waves_sky()[::-1]), half=True)
    for source in ("now", "paint", tmp_path / "front.exr", waves_sky(5)):
        steps = len(session.journal.done)
        session.shot_add(source=source, start_s=3.0, end_s=20.0, camera="beach")
        assert len(session.journal.done) == steps + 1
    session.shot_to_paint("shot-1")
    made = {name: thing for name, thing in session.level.objects.items() if isinstance(thing, Shot)}
    assert len(made) == 4
    assert len({shot.map for shot in made.values()}) == 4
    again = cloudy()
    again.set("weather.growth_s", 60.0)
    paint(again, Rect(150, 180, 300, 330), 0.875, 0.5, 0.25, 0.75)
    with Session(again) as other:
        other.run(json.loads(json.dumps(session.script)))
        assert {name: other.level.objects[name] for name in made} == made
        for shot in made.values():
            np.testing.assert_array_equal(other.level.skies[shot.map], session.level.skies[shot.map])
        np.testing.assert_array_equal(other.level.layers["weather"].array, session.level.layers["weather"].array)
    for _ in range(5):
        session.undo()
    assert not any(isinstance(thing, Shot) for thing in session.level.objects.values())
    for _ in range(5):
        session.redo()
    assert {name: session.level.objects[name] for name in made} == made


def test_bad_shots_are_refused(session):
    """Z20: with one sentence and no step."""
    session.shot_add("one", 0.0, 5.0)
    steps = len(session.journal.done)
    for fields, told in (
        ({"name": "one"}, "already"), ({"start_s": 5.0, "end_s": 5.0}, "must end after"), ({"fade_s": -1.0}, "fade_s"),
        ({"name": "a b"}, "id"), ({"camera": "a b"}, "camera"), ({"source": np.zeros((3, 3))}, "512"),
        ({"source": "nowhere.png"}, "nowhere.png"),
    ):  # fmt: skip
        with pytest.raises(BadInput, match=told):
            session.shot_add(**fields)
    for word in (session.shot_to_paint, session.shot_remove):
        with pytest.raises(BadInput, match="it has: one"):
            word("two")
    assert len(session.journal.done) == steps


def test_crop_keeps_shots(session):
    """Z20: a shot stands nowhere, so a crop moves nothing of it and loses nothing."""
    name = session.shot_add(source="paint")
    shot, sky = session.level.objects[name], session.level.skies[session.level.objects[name].map]
    session.crop(10, 10, 60, 60)
    assert session.level.objects[name] == shot
    assert session.level.skies[shot.map] is sky
    assert not any(name in note for note in session.notes if "outside" in note)


def test_recovery_log_holds_skies(session):
    """Z20 T08: a record of the step brings object and sky back; a sky that the log has is left out."""
    name = session.shot_add(source=waves_sky())
    change = recovery_record.change_of(session.level, session.journal.done[-1])
    again = recovery_record.decode(*recovery_record.read(io.BytesIO(recovery_record.encode(change))))
    held = session.level.objects[name].map
    with Session(cloudy()) as other:
        other.apply_change(again)
        assert other.level.objects[name] == session.level.objects[name]
        np.testing.assert_array_equal(other.level.skies[held], session.level.skies[held])
    assert not recovery_record.change_of(session.level, session.journal.done[-1], {held}).skies
    whole = recovery_record.fold([recovery_record.everything(session.level, "all"), change])
    assert whole.skies.keys() == {held}


def test_killed_editor_gives_shots_back(session, tmp_path):
    """Z20 T08: through the log on the disk."""
    from shorewright.app.recovery_offer import offers

    session.keep_log(tmp_path)
    name = session.shot_add(source=waves_sky())
    session.recovery.settle()
    session.recovery.close(discard=False)
    session.recovery = None
    found = offers(tmp_path)
    change = found[0].change()
    assert isinstance(change.objects[name], Shot)
    np.testing.assert_array_equal(change.skies[change.objects[name].map], waves_sky())


def test_command_line(tmp_path, capsys):
    """Z20: add, list, remove; bad input is told in a line and leaves the level."""
    path = tmp_path / "a.shore"
    write_level(cloudy(), path)
    assert main(["shot", "add", str(path), "--start", "5", "--end", "25", "--name", "dusk", "--camera", "beach"]) == 0
    out, err = capsys.readouterr()
    assert "dusk from 5 to 25 s" in out
    assert "no camera" in err
    assert main(["shot", "list", str(path), "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)
    assert [(row["id"], row["start_s"], row["camera"]) for row in rows] == [("dusk", 5.0, "beach")]
    assert main(["shot", "list", str(path)]) == 0
    assert "dusk" in capsys.readouterr().out
    assert read_level(path).skies.keys() == {rows[0]["map"]}
    for words in (
        ["add", str(path), "--start", "5", "--end", "3"],
        ["add", str(path), "--start", "5", "--end", "9", "--from", "x"],
        ["remove", str(path), "none"], ["add", str(path), "--start", "5"], ["list"],
    ):  # fmt: skip
        assert main(["shot", *words]) == 2
        err = capsys.readouterr().err
        assert err.startswith("shorewright: ")
        assert err.count("\n") == 1
    assert main(["shot", "remove", str(path), "dusk"]) == 0
    assert not read_level(path).objects.keys() & {"dusk"}
    assert not (path / "skies").exists()


def test_grid_of_skies_is_that_of_the_paint():
    """Z20: sample for sample."""
    assert waves_sky().shape[:2] == WEATHER_GRID.shape
