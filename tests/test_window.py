"""The real window under Xvfb, worked through its widgets (T01 T05 T08 T11 D31)."""

import hashlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from coasts import make_beach
from shorewright import io
from shorewright.app.recovery_offer import offers
from shorewright.io.images import write_image
from shorewright.level.framing import cameras
from shorewright.level.next_crest import next_crest

pytestmark = pytest.mark.window
HERE = Path(__file__).parent


@pytest.fixture(scope="module")
def display():
    """A display of its own; without Xvfb these tests skip, unless SHOREWRIGHT_EXPECT_GL demands it."""
    if shutil.which("Xvfb") is None:
        if os.environ.get("SHOREWRIGHT_EXPECT_GL"):
            pytest.fail("Xvfb is missing, and SHOREWRIGHT_EXPECT_GL demands the window")
        pytest.skip("Xvfb is missing, so no window can be opened")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp", "-noreset"]
    server = subprocess.Popen(command, pass_fds=(write,), stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as answer:
        number = answer.readline().strip()
    yield f":{number}"
    server.terminate()
    server.wait(timeout=20)


@pytest.fixture
def drive(display, tmp_path):
    """`drive(scenario)` runs it on a level in a temporary folder and returns its record; files go nowhere else."""
    level = make_beach(rows=193, cols=225, slope=0.05)
    for camera in cameras(level):
        level.put_object(camera.id, camera)
    path = tmp_path / "beach.shore"
    io.write_level(level, path)

    def run(scenario: str, code: int = 0, by: str = "window_drive.py") -> dict:
        record = tmp_path / f"{scenario}.json"
        places = {f"XDG_{kind}_HOME": str(tmp_path / kind.lower()) for kind in ("STATE", "CONFIG", "CACHE")}
        env = {**os.environ, **places, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"}
        env.pop("WAYLAND_DISPLAY", None)
        done = subprocess.run(
            [sys.executable, str(HERE / by), scenario, str(path), str(record)],
            env=env, capture_output=True, text=True, timeout=600, cwd=HERE,
        )  # fmt: skip
        assert done.returncode == code, done.stderr[-4000:]
        assert record.exists(), done.stderr[-4000:]
        return json.loads(record.read_text())

    run.path, run.state = path, tmp_path / "state"
    return run


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


def test_panels_and_broken_code(drive):
    """T05, T08: a slider drag is one step; history and timeline go where clicked; a broken panel is outlived."""
    found = drive("panels")
    assert found["steps"] == ["Set shore.range_m"]
    assert found["range_m"] != 5.0
    assert found["steps_after_second"] == 2
    assert found["went_to"] == 1
    assert found["redoable"] == 1
    assert 29 < found["scrubbed_s"] < 31
    assert "the history broke" in found["told"]
    assert found["failures"] == {"History": "RuntimeError: the history broke"}
    assert found["healed"]
    assert "ZeroDivisionError" in found["picture_failed"]
    assert found["picture_healed"]


def test_environments_by_button_and_menu(drive):
    """L02: all of a named light and air is one click and one step."""
    found = drive("light")
    assert found["button"] == "storm"
    assert found["steps"] == ["Storm light"]
    assert found["menu"] == "moonlit"
    assert found["steps_then"] == 2
    assert found["picture"] == ""
    assert found["undone"]
    assert found["sun"][0] > found["sun_before"]
    assert found["sun"][1] > found["sun_lower"]
    assert found["sun_steps"] == ["Turn the sun"]
    assert found["samples"] == 16  # L04: a picture that stands still gathers samples


def test_objects_are_dropped_dragged_renamed_and_deleted(drive):
    """D01, H15: a click drops, a drag is one step, the panel renames, a gradient's stop follows the mouse."""
    found = drive("objects")
    assert found["bad"] == []
    assert found["dropped"] == "lamp-1"
    assert found["tool"] == "lamp"
    assert found["steps"] == ["Place lamp-1"]
    assert abs(found["moved"]) > 1.0
    assert found["steps_moved"] == 2
    assert found["back"]
    assert found["renamed"]
    assert found["in_use"]
    assert found["stop"][0] != found["stop"][1]
    assert found["stop_steps"] == 1
    assert found["deleted"]
    assert found["tool_at_last"] == "brush"
    assert found["same_ground"]


def test_waves_panel_cuts_through_the_pointer(drive):
    """D03, H28: A, B and A − B at this moment along a cut, without a fault in the log."""
    found = drive("waves")
    assert found["samples"] > 100
    assert found["line"] > 0.9
    assert found["ghosts"] == 6
    assert found["band"] > 0.3
    assert found["bad"] == []


def test_time_is_worked_by_hand(drive):
    """T05: a marker made, dragged, jumped to and deleted; steps by waves."""
    found = drive("time_by_hand", by="window_time.py")
    assert found["marked"] == [12.0]
    assert found["wave"] == pytest.approx(21.0)
    assert found["tenth"] == pytest.approx(12.9)
    assert found["dragged"] == pytest.approx(24.0, abs=0.5)
    assert found["drag_steps"] == 1
    assert found["jumped"] == found["dragged"]
    assert found["selected"] == "marker-1"
    assert found["deleted"]
    assert found["back"]
    assert found["bad"] == []


def test_probes_are_dropped_and_drawn(drive):
    """T06: two clicks, two lines; the form for crest times."""
    found = drive("water_probes", by="window_time.py")
    assert found["probes"] == ["probe-1", "probe-2"]
    assert found["drawn"] == 2
    assert found["moves"] > 0.1
    assert found["asked"] == "EventForm"
    assert found["bad"] == []


def test_the_timing_is_read_on_the_water(drive):
    """T06: overlays by key and box, the sentence under the pointer equals the level's, a hot spot is gone to."""
    found = drive("timing", by="window_time.py")
    assert found["bad"] == []
    assert found["on"] == ["breakers", "crests", "isochrones", "speed"]
    assert found["drawn"]
    level = io.read_level(drive.path)
    expected = next_crest(level, 14.0, *found["at"])
    assert found["said"][0].lower() == expected.sentence
    assert expected.type in found["said"][1]
    assert found["labels"] > 3
    assert found["spots"][0] == "too_fast"
    assert found["moved"]
    assert len(found["steps"]) == 1  # the setting alone


def test_weather_is_painted_on_the_sky_and_on_the_map(drive):
    """T04: strokes begin where the pointer meets the shell of clouds, or on the panel's map; both are undone."""
    found = drive("weather", by="window_weather.py")
    assert found["bad"] == []
    assert found["brush"] == "weather"
    assert found["over_land"] == found["start"]
    assert found["pointed"] is None
    assert found["targets"] == [0.9, 1.0, 1.0]
    assert 1300 < found["ring"][2] < 1600
    assert len({found["start"], found["during"], found["after"], found["on_map"]}) == 4
    assert found["steps"] == ["Paint weather"]
    assert found["undone"] == found["undone_at_last"] == found["start"]
    assert found["redone"] == found["after"]
    assert found["map_steps"] == ["Paint weather", "Paint weather"]
    assert found["map_pointer"] is not None
    assert found["taken"] == pytest.approx(0.9, abs=0.02)
    assert found["took_steps"] == 2
    assert 20_000 < found["zoomed_m"] < 60_000


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
    assert "'sand'" in found["no_map"]
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


def test_skies_by_dialog_and_curves_by_mouse(drive):
    """Z03, T04: what is wrong with a map is told in the dialog; each import, drag, point is one step."""
    values = np.random.default_rng(1).integers(0, 256, (64, 96, 3)).astype(np.uint8)
    values[:, 48:] = 255
    write_image(drive.path.parent / "cut.png", values, data=True)
    found = drive("skies", by="window_weather.py")
    assert "'q'" in found["error"]
    assert any("stretched" in line for line in found["told"])
    assert found["steps"] == ["Weather map cut.png"]
    assert found["painted"] == 16
    assert found["written"]
    assert found["drag_steps"] == 1
    before, dragged = found["before"], found["dragged"]
    assert dragged[4] == pytest.approx(before[4] + 0.08, abs=0.02)
    assert dragged[5] == pytest.approx(before[5] - 0.3, abs=0.03)
    assert dragged[:4] + dragged[6:] == before[:4] + before[6:]
    assert len(found["added"]) == len(before) + 2
    assert found["add_steps"] == 2
    assert found["removed"] == dragged
    assert found["remove_steps"] == 3
    assert found["undone"]
    assert found["above"] == found["sky_above"]


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


def test_weather_storms_and_shots_by_mouse_and_menu(drive):
    """D36 Z23 Z20 Z25: each is a step to undo; marks on the timeline are dragged; what is covered is told."""
    found = drive("story", by="window_weather.py")
    assert found["bad"] == []
    assert found["menu"] == "gale"
    assert found["menu_steps"] == ["Gale weather"]
    assert found["menu_undone"]
    assert found["filled"] == 1.0
    assert found["panel"] == "calm"
    assert found["panel_steps"] == ["Paint weather", "Calm weather"]
    assert "all of the sky is painted; the preset shows only once paint is erased" in found["told"]
    assert found["panel_undone"]
    assert found["storm"] == [True, 1.0, 12.0]
    assert found["storm_ended"][1] == 0.0
    assert found["storm_steps"] == ["Bring a storm", "End the storm"]
    assert found["storm_undone"]
    assert found["made"] == [found["made_at"], found["made_at"] + 20] == [12.0, 32.0]
    assert found["taken"] == "shot-1"
    assert found["skies"] == 1
    assert found["end"] == [12.0, pytest.approx(42, abs=0.5)]
    assert found["start"] == [pytest.approx(6, abs=0.5), found["end"][1]]
    assert found["moved"] == pytest.approx([at + 5 for at in found["start"]], abs=0.5)
    assert found["moved"][1] - found["moved"][0] == pytest.approx(found["start"][1] - found["start"][0], abs=0.011)
    assert found["end_steps"] == found["start_steps"] == found["moved_steps"] == 1
    assert found["clock"] == 12.0
    assert found["clicked"] == pytest.approx(20, abs=0.3)
    assert found["clicked_steps"] == 1
    assert found["back"] == [found["start"], found["end"], found["made"]]
    assert found["renamed"] == found["unremoved"] == found["unrenamed"] == found["made"]
    assert found["in_hand"] == "dawn"
    assert found["shown"] == ["dawn"]
    assert found["button"]
    assert found["removed"] == found["unmade"] == []
    assert found["steps_left"] == 0
    assert found["hour"] == "21 June, 18:20"
