"""The real window under Xvfb, worked through its widgets: strokes, keys, camera, files (T01 T05 T08 T11 D31)."""

import hashlib

import pytest
from shorewright import io
from shorewright.app.recovery_offer import offers

pytestmark = pytest.mark.window


def ground(path) -> str:
    return hashlib.sha256(io.read_level(path).height.tobytes()).hexdigest()


def test_ramp_pause_undo_save(drive):
    """T01, T05, T08, D31: picks ramp, drags across the beach, pauses, undoes, saves; Esc gives a stroke up."""
    found = drive("sculpt")
    assert found["ran"]
    assert found["paused"]
    assert found["brush"] == "ramp"
    assert len({found["start"], found["during"], found["after"]}) >= 2
    assert found["start"] not in (found["during"], found["after"])
    assert found["preview"] > 0
    assert found["steps"] == ["Ramp"]
    assert found["title"] == "beach.shore •"
    assert found["undone"] == found["start"]
    assert found["redone"] == found["saved"] == found["after"]
    assert not found["dirty"]
    assert found["before_escape"] != found["after"]
    assert found["escaped"] == found["at_last"] == found["after"]
    assert found["steps_at_last"] == 1
    assert found["time_at_last"] == found["time_s"]
    assert ground(drive.path) == found["after"]


def test_keys_and_modifiers(drive):
    """T11, D31: the keys of ACTIONS; Ctrl inverts, Shift smooths with any brush."""
    found = drive("keys")
    assert found["brush"] == "raise"
    assert found["larger"]
    assert found["weaker"]
    assert found["plain"][0] == "Raise"
    assert found["plain"][1] > 0
    assert found["inverted"][0] == "Lower"
    assert found["inverted"][1] < 0
    assert found["smoothed"][0] == "Smooth"
    assert found["second"] == "lower"
    assert not found["water"]
    assert found["walkable"]
    assert not found["walkable_again"]
    assert found["view"] == "clock_depth"
    assert not found["palette"]
    assert found["hidden"] == ["vertex_animation", "water"]
    assert 0 < found["stepped"] <= found["step_s"] + 1e-9


def test_camera_and_stillness(drive):
    """D40: orbit, zoom and flight move the camera and nothing else; a still picture is drawn once, at full size."""
    found = drive("look")
    places = [(c["x"], c["y"], c["z"]) for c in found["cameras"]]
    assert len(set(places)) == len(places)
    assert found["same"]
    assert found["steps"] == 0
    assert found["water_while_flying"]
    assert found["still_frames"] >= 20
    assert found["still_draws"] == 0
    assert found["full"] == found["viewport"]


def test_files_by_dialog(drive):
    """Save as, export and open by typed paths; what cannot be opened is told in the dialog."""
    original = ground(drive.path)
    found = drive("files")
    saved = drive.path.parent / "other.shore"
    assert found["path"] == str(saved)
    assert not found["dirty"]
    assert ground(saved) == found["height"] != original
    assert found["suggested"].endswith("other_raw")
    assert any(name.endswith(".glb") for name in found["exported"])
    assert found["all_maps"] == "all"
    assert "nothing was chosen" in found["no_map"]
    assert found["two_maps"].startswith("2 of ")
    assert not any(name.endswith(".png") for name in found["exported"])
    assert found["frames"] < 4000
    assert found["begun"]
    assert not found["cancelled"]
    assert "cancelled" in found["told"]
    assert "nowhere.shore" in found["error"]
    assert found["still_open"]
    assert found["reopened"] == str(drive.path)
    assert found["closed"]
    assert found["original"] == original
    assert found["picture"] == ""
    assert found["recent"] == [str(drive.path), str(saved)]


def test_a_killed_editor_offers_what_it_had(drive):
    """T08: at most the stroke in progress is lost; leaving with unsaved work asks first."""
    killed = drive("killed", code=9)
    assert ground(drive.path) != killed["after"]
    assert len(offers(drive.state / "shorewright" / "recovery")) == 1
    restored = drive("restored")
    assert "beach.shore" in restored["asked"]
    assert restored["after"] == killed["after"]
    assert restored["dirty"]
    assert restored["leaving"] == "Quit"
    assert not restored["shall_exit"]
