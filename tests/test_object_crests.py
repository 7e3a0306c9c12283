"""Crests of wave objects are told where they stand highest (T06, H08)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.commands.timing import _events
from shorewright.level.next_crest import next_crest
from shorewright.level.object_crests import highest_object, object_crest
from shorewright.level.objects import OBJECT_KINDS, WaveObject
from shorewright.level.probes import crest_times

Probe = OBJECT_KINDS["probe"]


def deep_level(**sea):
    """Twenty metres of water everywhere, 200 × 160 m, no waves but those that are placed."""
    level = make_beach(rows=81, cols=101, cell_m=2.0, slope=0.0)
    level.write("height", level.grid.rect, -20.0)
    for name, value in {"swell_m": 0.0, "chop_m": 0.0, **sea}.items():
        level.set(f"sea.{name}", value)
    return level


def wave(**fields):
    return WaveObject(**{"id": "wave-1", "x": 100.0, "y": 80.0, "yaw_deg": 33.0, **fields})


@pytest.mark.parametrize("curvature", [0.0, 0.7, -0.8])
def test_crests_of_an_object_are_those_of_the_twin(curvature):
    """T06, H08, H09: each within 0.03 s of where the whole sea stands highest at a probe, and as high."""
    level = deep_level()
    level.put_object("wave-1", wave(curvature=curvature, lateral=0.3))
    probe = Probe(id="p", x=112.0, y=71.0, rise_m=0.3)
    seen, t, told = crest_times(level, probe, 0.0, 30.0), 0.0, []
    while t < 30.0:
        found = next_crest(level, t, probe.x, probe.y)
        t += found.in_s + 1e-4
        told.append((t, found.height_m))
        assert found.of == "wave-1"
    assert len(seen) > 4
    for when, high in seen:
        near = min(told, key=lambda one: abs(one[0] - when))
        assert near[0] == pytest.approx(when, abs=0.03)
        assert near[1] == pytest.approx(high, abs=0.02)


def test_the_sentence_names_the_object_and_its_waves_do_not_break():
    """H08: what an artist reads beside the pointer."""
    level = deep_level()
    level.put_object("wave-1", wave())
    found = next_crest(level, 2.0, 100.0, 80.0)
    assert found.sentence == f"next crest of wave-1 in {found.in_s:.1f} s, {found.height_m:.1f} m high"
    assert found.breaks_after_s is None
    assert found.speed_mps == pytest.approx(np.sqrt(9.81 * 28 / (2 * np.pi)), rel=1e-3)  # deep water, straight ahead
    assert next_crest(level, 2.0, 5.0, 5.0) is None  # beyond its radius


def test_the_highest_waves_are_told():
    """T06: of two objects the one that stands higher there; the shore wave where that is highest."""
    level = deep_level()
    level.put_object("a", wave(id="a", amplitude_m=0.3))
    level.put_object("b", wave(id="b", amplitude_m=0.9, x=140.0, radius_m=60.0))
    assert highest_object(level, 0.0, 130.0, 80.0)[0].id == "b"
    assert highest_object(level, 0.0, 60.0, 80.0)[0].id == "a"
    beach = make_beach(rows=81, cols=61, cell_m=2.0, slope=0.04)
    line = np.linspace(10.0, 150.0, 141)
    shore = next(y for y in line if (one := next_crest(beach, 3.0, 60.0, y)) and one.height_m > 0.2)
    own = next_crest(beach, 3.0, 60.0, shore)
    beach.put_object("low", wave(id="low", x=60.0, y=float(shore), amplitude_m=0.05))
    assert next_crest(beach, 3.0, 60.0, shore) == own
    assert object_crest(beach, 3.0, 0.0, -900.0) is None


def test_events_name_the_object():
    """T06: rows of events.json."""
    level = deep_level()
    level.put_object("wave-1", wave())
    level.put_object("buoy", Probe(id="buoy", x=100.0, y=80.0))
    rows = _events(level, 4.0)["events"]
    assert len(rows) > 8
    assert {row["object"] for row in rows} == {"wave-1"}
    assert np.diff([row["time_s"] for row in rows]).min() > 1.0
