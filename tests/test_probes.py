"""Probes and the times at which crests come to them (T06)."""

import json

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app import time_edits
from shorewright.app.session import Session
from shorewright.level import BadInput, Rect
from shorewright.level.gerstner import groups
from shorewright.level.objects import Pin, Probe, WeatherKey
from shorewright.level.pick import ground_at
from shorewright.level.probes import crest_times, events, heights_at, is_wet, wet_and_dry, wet_times
from shorewright.level.waves import sea_at


def deep(**settings):
    """Deep water in which one front alone runs."""
    level = make_beach(rows=65, cols=65, slope=0.0)
    level.write("height", level.grid.rect, -60.0)
    for name, value in {"sea.chop_m": 0.0, "shore.on": False, "sea.phase_noise": 0.0, **settings}.items():
        level.set(name, value)
    return level


def alone(monkeypatch, level, front=0):
    """Leave one front of the swell."""
    from dataclasses import replace

    from shorewright.level import sea_keys

    high, low = groups(level.settings.sea, level.settings.level.seed)
    keep = np.arange(3) == front
    low = replace(low, amplitude_m=low.amplitude_m * keep, lateral_m=low.lateral_m * keep)
    monkeypatch.setattr(sea_keys, "groups", lambda sea, seed: [high, low])
    return low


def test_many_times_at_once_are_those_one_by_one():
    """T06: an array of times gives what single ones give, with tide and loop too."""
    level = make_beach(slope=0.05)
    for settings in (
        {},
        {"tide.on": True, "tide.period_s": 40.0},
        {"time.loop_s": 24.0},
        {"first": 300.0},
        {"first": 9},
        {"pin": 1},
    ):
        for name, value in settings.items():
            if name == "pin":  # over the tide each moment has its own
                level.put_object("gale", None)
                level.put_object("pin", Pin(id="pin", x=60.0, y=30.0, time_s=value))
            elif name == "first":  # a key that comes after all of them, and one among them
                level.put_object("gale", WeatherKey(id="gale", time_s=value, weather="gale"))
                level.put_object("squall", WeatherKey(id="squall", time_s=1, weather="storm", radius_m=90))
            else:
                level.set(name, value)
        times = np.array([0.0, 3.3, 17.0, 250.0])
        x, y = np.array([20.0, 40.0, 60.0, 60.0]), np.array([30.0, 60.0, 61.0, 64.0])
        single = [float(sea_at(level, float(t), a, b).height_m) for t, a, b in zip(times, x, y)]
        assert np.allclose(heights_at(level, times, x, y), single, atol=1e-6)


@pytest.mark.parametrize("front", [0, 2])
def test_crests_come_when_the_closed_form_says(monkeypatch, front):
    """T06: for one plane front, θ = k D·x₀ − ω t = π/2 at the undeformed point under the crest, to 1 ms."""
    level = deep()
    low = alone(monkeypatch, level, front)
    probe = Probe(id="p", x=21.0, y=34.0, rise_m=0.02)
    found = crest_times(level, probe, 0.0, 40.0)
    period_s = 2 * np.pi / low.omega[front]
    # at a crest the lateral shift, which goes with cos θ, is none: the point under it lies where it started
    cycles = (low.east[front] * probe.x + low.north[front] * probe.y) / low.length_m[front]
    first = (cycles - 0.25) * period_s
    expected = first + period_s * np.arange(np.ceil(-first / period_s), np.floor((40 - first) / period_s) + 1)
    assert len(found) == len(expected) >= 6
    assert np.abs(np.array([t for t, _ in found]) - expected).max() < 1e-3
    assert np.allclose([h for _, h in found], low.amplitude_m[front], atol=1e-4)


def test_shore_waves_come_once_an_interval():
    """T06: on a beach without offshore waves one crest an interval, equally far apart; on dry land none."""
    level = make_beach(rows=193, cols=129, slope=0.05)
    for name, value in {"sea.on": False, "shore.variety": 0.0}.items():
        level.set(name, value)
    probe = Probe(id="p", x=60.0, y=level.grid.extent_m[1] / 2 - 30.0)
    times = np.array([t for t, _ in crest_times(level, probe, 10.0, 60.0)])
    assert np.allclose(np.diff(times), level.settings.shore.interval_s, atol=1e-3)
    assert len(times) in (5, 6)
    assert crest_times(level, probe.model_copy(update={"y": 190.0}), 10.0, 60.0) == []


def test_a_beach_gets_wet_and_dry_once_a_wave():
    """T06: by turns, an interval apart, at a centimetre of water; never far up, nor in a hollow behind the beach."""
    level = make_beach(rows=193, cols=129, slope=0.05)
    for name, value in {"sea.on": False, "shore.variety": 0.0}.items():
        level.set(name, value)
    level.write("height", Rect(150, 50, 160, 60), -2.0)
    swash = Probe(id="swash", x=60.0, y=102.0)
    found = wet_times(level, swash, 5.0, 50.0)
    assert [kind for _, _, kind in found] == [
        ["dry", "wet"][(n + (found[0][2] == "wet")) % 2] for n in range(len(found))
    ]
    assert len(found) in (10, 9, 11)
    for kind in ("wet", "dry"):
        assert np.allclose(np.diff([t for t, _, k in found if k == kind]), level.settings.shore.interval_s, atol=2e-3)
    ground_m = float(ground_at(level, np.array([60.0]), np.array([102.0]))[0])
    for time_s, height_m, kind in found:
        before, after = heights_at(level, [time_s - 0.01, time_s + 0.01], 60.0, 102.0) - ground_m >= 0.01
        assert (before, after) == ((False, True) if kind == "wet" else (True, False))
        assert is_wet(level, swash, time_s + 0.01) == (kind == "wet")
        if kind == "wet":
            assert height_m > ground_m
    for place in ({"y": 190.0}, {"x": 55.0, "y": 155.0}, {"y": 20.0}):
        probe = swash.model_copy(update=place)
        assert wet_times(level, probe, 5.0, 50.0) == []
        assert is_wet(level, probe, 5.0) == (place == {"y": 20.0})
    level.put_object("swash", swash)
    assert [row["kind"] for row in wet_and_dry(level, 5.0, 50.0)] == [kind for _, _, kind in found]


def test_events_are_written_whole_or_not_at_all(tmp_path):
    """T06: a list of crests in order of time; a name or a folder that won't do leaves nothing."""
    with Session(make_beach(rows=193, cols=129, slope=0.05)) as session:
        with pytest.raises(BadInput, match="no probe"):
            time_edits.export_events(session, tmp_path / "events.json", 0, 20)
        for name, y in (("near", 80.0), ("far", 40.0)):
            session.place(Probe(id=name, x=50.0, y=y))
        count = time_edits.export_events(session, tmp_path / "events.json", 0, 20)
        rows = json.loads((tmp_path / "events.json").read_text())
        assert rows == events(session.level, 0, 20)
        assert len(rows) == count > 3
        assert {row["probe"] for row in rows} == {"near", "far"}
        assert all(row.keys() == {"probe", "time_s", "height_m", "kind"} for row in rows)
        assert [row["time_s"] for row in rows] == sorted(row["time_s"] for row in rows)
        for path, times in ((tmp_path / "none" / "events.json", (0, 9)), (tmp_path / "events.txt", (0, 9)),
                            (tmp_path / "late.json", (9, 0))):  # fmt: skip
            with pytest.raises(BadInput):
                time_edits.export_events(session, path, *times)
    assert [path.name for path in tmp_path.iterdir()] == ["events.json"]


def test_markers_are_jumped_to_and_are_one_step_each():
    """T05: added at the clock's time, found again in both ways, undone."""
    with Session(make_beach()) as session:
        for t in (12.5, 3.25):
            session.scrub(t)
            time_edits.add_marker(session)
        assert [step.label for step in session.journal.done] == ["Place marker-1", "Place marker-2"]
        session.scrub(0.0)
        seen = []
        for way in (1, 1, 1, -1):
            time_edits.jump(session, way)
            seen.append((session.clock.time_s, session.selected))
        assert seen == [(3.25, "marker-2"), (12.5, "marker-1"), (12.5, "marker-1"), (3.25, "marker-2")]
        session.undo()
        assert [marker.id for marker in time_edits.markers_of(session)] == ["marker-1"]


def test_steps_by_waves_end_where_the_next_wave_is_the_same():
    """T05: a whole wave on and back is where it was; ten tenths are a wave; the loop's period counts."""
    with Session(make_beach()) as session:
        session.scrub(2.0)
        time_edits.step_wave(session, 1.0)
        assert session.clock.paused
        assert session.clock.time_s == 11.0
        for _ in range(10):
            time_edits.step_wave(session, -0.1)
        assert session.clock.time_s == pytest.approx(2.0)
        session.set("time.loop_s", 20.0)
        time_edits.step_wave(session, 1.0)
        assert session.clock.time_s == pytest.approx(12.0)
