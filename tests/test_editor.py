"""The window's state without a window: governor, brush ring, probe, keys, messages, guard (T05 T08 T11 D31)."""

import logging

import numpy as np
import pytest
from imgui_bundle import imgui
from shorewright.app import keys, timeline
from shorewright.app import window as window_module
from shorewright.app.actions import ACTIONS
from shorewright.app.brush_ring import along, circle, hidden_by_land, on_screen
from shorewright.app.editor import INSETS, Editor
from shorewright.app.governor import MARGIN, SCALES, Governor
from shorewright.app.layout import PANELS
from shorewright.app.menus import INNER, ORDER
from shorewright.app.messages import Messages
from shorewright.app.panels.brush_bar import PROFILES
from shorewright.app.panels.history_panel import bytes_text, go_to
from shorewright.app.panels.layers_panel import memory
from shorewright.app.preferences import Preferences
from shorewright.app.probe import probe, sentence
from shorewright.app.recovery_offer import offers
from shorewright.app.session import Session
from shorewright.app.viewport_overlay import ramp_text
from shorewright.brushes import BRUSHES
from shorewright.level import LAYERS, BadInput, Grid
from shorewright.level.objects import Camera
from shorewright.level.pick import ground_at
from shorewright.level.shore_waves import front_speed_mps


@pytest.fixture
def editor(tmp_path):
    with Session.new(Grid(120, 140), spill_root=tmp_path) as session:
        session.clock.paused = True
        yield Editor(session, Preferences(), tmp_path / "preferences.json")


def settle(governor: Governor, cost_at_full_s: float, frames: int = 200) -> float:
    for _ in range(frames):
        governor.note(cost_at_full_s * governor.scale**2)
    return governor.scale


@pytest.mark.parametrize("cost_s", [0.002, 0.03, 0.05, 0.1, 0.2, 0.4])
def test_the_governor_holds_the_rate_with_the_largest_picture_that_fits(cost_s):
    governor = Governor(30.0)
    scale = settle(governor, cost_s)
    assert cost_s * scale**2 <= 1 / 30 or scale == SCALES[-1]
    if scale < 1:
        larger = SCALES[SCALES.index(scale) - 1]
        assert cost_s * larger**2 > MARGIN / 30
    assert settle(governor, cost_s, 400) == scale  # no hunting


def test_the_governor_recovers_and_knows_where_to_start():
    governor = Governor(30.0, start=0.35)
    assert governor.scale == 0.35
    assert settle(governor, 10.0) == SCALES[-1]
    assert settle(governor, 0.001) == 1.0
    governor.note(float("nan"))
    governor.note(-1.0)
    assert governor.scale == 1.0


def test_the_ring_follows_the_ground(beach_level):
    """D31: every point of the ring lies on the ground, at the brush's radius."""
    points = circle(beach_level, 80, 60, 12)
    assert np.hypot(points[:, 0] - 80, points[:, 1] - 60) == pytest.approx(12)
    assert points[:, 2] == pytest.approx(ground_at(beach_level, points[:, 0], points[:, 1]), abs=0.05)
    line = along(beach_level, (10, 10), (40, 50))
    assert line[0, :2] == pytest.approx((10, 10))
    assert line[-1, :2] == pytest.approx((40, 50))


def test_land_hides_what_is_behind_it(beach_level):
    """A ridge between camera and ring hides the far ring, not the near one."""
    beach_level.write("height", beach_level.grid.rect_along(64, 80, 64, 80, 20), 15.0)
    camera = Camera(id="low", x=80, y=5, z=4, yaw_deg=0, pitch_deg=0)
    near, far = circle(beach_level, 80, 25, 5), circle(beach_level, 80, 110, 5)
    assert not hidden_by_land(beach_level, camera, near).any()
    assert hidden_by_land(beach_level, camera, far).all()
    assert on_screen(beach_level, camera, (400, 300), far).hidden.all()


def test_probe_tells_depth_slope_and_front_speed(beach_level):
    """D31: on a planar beach the front has the speed its slope gives it; on dry land there is none."""
    found = probe(beach_level, 80, 50)
    assert found.depth_m == pytest.approx((64 - 50) * 0.06, abs=1e-4)
    assert found.slope_deg == pytest.approx(np.degrees(np.arctan(0.06)), abs=1e-3)
    expected = float(front_speed_mps(beach_level.settings.shore, 0.06))
    assert found.front_mps == pytest.approx(expected, rel=0.1)
    assert probe(beach_level, 80, 120).front_mps is None
    assert "depth 0.84 m" in sentence(found)
    assert "over the sea" in sentence(probe(beach_level, 80, 120))


def test_ramp_text_has_grade_and_speed():
    preview = {"grade": -0.05, "heights": (1.0, -1.0), "slope_deg": 2.862, "front_speed_mps": 4.16, "length_m": 40.0}
    assert ramp_text(preview) == ["1 : 20.0   2.9°", "wave front 4.2 m/s", "1.00 m to -1.00 m over 40.0 m"]
    assert "flat" in ramp_text({**preview, "grade": 0.0, "front_speed_mps": None})[1]


@pytest.mark.parametrize("text", [key for action in ACTIONS.values() for key in action.keys])
def test_every_shortcut_is_a_key_that_exists(text):
    assert keys.chord(text) > 0


def test_chords():
    assert keys.chord("Ctrl+Shift+Z") == int(imgui.Key.mod_ctrl) | int(imgui.Key.mod_shift) | int(imgui.Key.z)
    assert keys.chord("{") == int(imgui.Key.mod_shift) | int(imgui.Key.left_bracket)
    assert keys.chord("7") == int(imgui.Key._7)
    for wrong in ("Hyper+A", "Ctrl+Nothing", "ä"):
        with pytest.raises(ValueError, match=wrong.rpartition("+")[2]):
            keys.chord(wrong)


def test_every_action_has_a_menu_that_is_drawn():
    assert {action.menu for action in ACTIONS.values()} <= {*ORDER, *INNER, ""}


def test_panels_and_profiles_match_their_tables():
    assert len({panel.name for panel in PANELS}) == len(PANELS)
    assert PROFILES.keys() >= BRUSHES.keys()


def test_actions_wait_while_a_stroke_is_open(editor):
    """Ctrl+Z in mid-stroke gives the stroke up; what would replace the level waits for the release."""
    session = editor.session
    session.stroke_begin(40, 40)
    editor.do("save_as")
    editor.do("brush.lower")
    editor.tick()
    assert editor.asked == []
    assert session.brush == "raise"
    before = session.level.height.copy()
    editor.do("undo")
    assert session.stroke is None
    assert not np.array_equal(session.level.height, before)


def test_bad_input_is_told_not_raised(editor):
    assert editor.attempt(editor.session.set, "sea.nothing", 1) is None
    assert "sea.nothing" in editor.messages.toast().text
    editor.set("sea.swell_m", 1e9)
    assert editor.messages.toast().bad
    assert editor.session.level.settings.sea.swell_m < 1e9


def test_insets_are_switched_by_keys(editor):
    """T12, Z04: the pushed water and the weather map, each on and off alone."""
    for _ in range(2):
        for request, inset in INSETS.items():
            editor.do(request)
            editor.tick()
            assert inset in editor.overlays.insets
        for request in INSETS:
            editor.do(request)
        editor.tick()
        assert editor.overlays.insets == ()


def test_framing_glides_and_overlays_answer_requests(editor):
    session = editor.session
    start = session.camera
    session.cursor = (60.0, 60.0, 0.0)
    editor.do("frame")
    assert editor.gliding
    assert session.camera == start
    editor._glide.at -= 10
    editor.tick()
    assert not editor.gliding
    assert session.camera != start
    editor.do("walkable")
    editor.tick()
    assert editor.overlays.walkable
    assert editor.overlays.streamlines is None
    assert not editor.currents.busy
    editor.do("streamlines")
    editor.tick()
    assert editor.streamlines


def test_undo_is_told_with_its_label(editor):
    editor.session.drag("raise", (40, 40), (50, 50))
    editor.do("undo")
    assert editor.messages.lines[-1].text == "Undone: Raise"


def test_going_to_a_step_and_back(editor):
    """T08: the history goes to any step, and nothing is lost on the way."""
    session = editor.session
    states = [session.level.height.copy()]
    for x in (30, 60, 90):
        session.drag("raise", (x, 40), (x, 60))
        states.append(session.level.height.copy())
    for target in (1, 3, 0, 2):
        go_to(editor, target)
        assert len(session.journal.done) == target
        assert np.array_equal(session.level.height, states[target])


def test_the_memory_table_has_every_layer(editor):
    editor.session.drag("raise", (40, 40), (50, 50))
    held = memory(editor, {"height": 123, "other": 9})
    assert held.keys() == LAYERS.keys()
    assert held["height"].cpu >= editor.session.level.height.nbytes
    assert held["height"].gpu == 123
    assert held["height"].undo == editor.session.journal.bytes > 0
    assert held["foam"].cpu == 0


@pytest.mark.parametrize("started", [True, False])
def test_a_window_that_breaks_leaves_the_recovery_log(editor, tmp_path, monkeypatch, started):
    """T08: whatever ends the window, what was not saved is offered by the next one; no OpenGL is one sentence."""
    session = editor.session
    session.keep_log(tmp_path)
    session.drag("raise", (40, 40), (50, 50))
    window = window_module.Window(session, Preferences())

    def run(params) -> None:
        window.picture = object() if started else None
        raise RuntimeError("the driver fell over")

    monkeypatch.setattr(window_module.hello_imgui, "run", run)
    with pytest.raises(RuntimeError if started else BadInput, match="driver" if started else "OpenGL 4.1"):
        window.run()
    session.close()
    assert [offer.labels for offer in offers(tmp_path)] == [["Raise"]]


def test_messages_collect_the_log_and_fade():
    messages = Messages()
    messages.attach("shorewright.test")
    try:
        try:
            raise RuntimeError("inside")
        except RuntimeError as error:
            logging.getLogger("shorewright.test.panel").error("a panel failed", exc_info=error)
    finally:
        messages.detach("shorewright.test")
    line = messages.toast()
    assert line.text == "a panel failed"
    assert "RuntimeError: inside" in line.detail
    messages._shown_at -= 100
    assert messages.toast() is None


def test_timeline_shows_the_page_or_the_loop():
    """T05."""
    assert timeline.span(0.0, None) == (0, 60)
    assert timeline.span(125.0, None) == (120, 180)
    assert timeline.span(12.0, (10.0, 22.0)) == (10.0, 22.0)
    assert timeline.span(70.0, (10.0, 22.0)) == (60, 120)
    assert timeline.clock_text(0) == "0:00.00"
    assert timeline.clock_text(59.999) == "1:00.00"
    assert timeline.clock_text(83.5) == "1:23.50"


def test_bytes_as_people_read_them():
    assert [bytes_text(n) for n in (0, 999, 5400, 123_456, 2_500_000, 3e9)] == [
        "0 B", "999 B", "5.4 kB", "123 kB", "2.5 MB", "3.00 GB",
    ]  # fmt: skip
