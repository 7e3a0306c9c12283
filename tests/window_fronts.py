"""Scenarios of fronts shaped by hand in the real window, for test_window_fronts.py (T07)."""

import numpy as np
import window_drive
from imgui_bundle import hello_imgui, imgui
from shorewright.app.camera_control import to_screen
from window_drive import CTRL, SHIFT, Hands

PLACE = (112.0, 66.0)  # in the sea of the beach that the test makes


def _part(hands: Hands, x: float, y: float) -> tuple[float, float]:
    """A world point of the still sea as parts of the viewport's sides."""
    size = hands.window.viewport.size
    level = hands.session.level
    pixels, _ = to_screen(hands.session.camera, size, np.array([[x, y, level.sea_level_m]]))
    return pixels[0, 0] / size[0], pixels[0, 1] / size[1]


def _ready(hands: Hands) -> None:
    """The tool in hand, a camera over the sea; the test engine waits for slow computers, instead of a minute."""
    session = hands.session
    imgui.test_engine.get_io(hello_imgui.get_imgui_test_engine()).config_watchdog_kill_test = 600.0
    hands.editor.choose_quality("low")
    session.set_front("radius_m", 30.0)
    session.camera = session.camera.model_copy(
        update={"x": PLACE[0], "y": PLACE[1] - 60.0, "z": 55.0, "yaw_deg": 0.0, "pitch_deg": -45.0}
    )
    hands.key(imgui.Key.c)


def _until(hands: Hands, done) -> None:
    """Let frames pass until what is worked out beside the window has come."""
    hands.until(done, lambda: hands.ctx.yield_(10), tries=400)


def _let_go(hands: Hands) -> None:
    hands.release()
    hands.note(waits=hands.session.stroke is not None and hands.session.stroke.settling)
    _until(hands, lambda: hands.session.stroke is None)


def shape(hands: Hands) -> None:
    """Drags a crest seaward while time runs, lets time run on, undoes; then Esc in mid-drag."""
    session, viewport = hands.session, hands.window.viewport
    _ready(hands)
    hands.note(tool=session.tool, ran=not session.clock.paused, start=hands.height())
    hands.until(lambda: viewport.pointer.front.crest is not None, lambda: hands.move(_part(hands, *PLACE)))
    hands.note(highlighted=viewport.pointer.front.crest is not None)
    hands.press(_part(hands, *PLACE))
    held = session.stroke
    hands.note(paused=session.clock.paused, held=held is not None)
    x, y = PLACE
    for way_m in (3.0, 6.0):
        hands.move(_part(hands, x, y - way_m))
    _until(hands, lambda: held.shaped is not None)
    hands.note(during=hands.height(), line=held.shaped is not None)
    _let_go(hands)
    hands.note(after=hands.height(), steps=[s.label for s in session.journal.done],
               left_m=float(np.quantile(held.shaped.left_m, 0.95)))  # fmt: skip
    time_s = session.clock.time_s
    hands.key(imgui.Key.space)
    hands.note(runs=not session.clock.paused, later_s=session.clock.time_s - time_s)
    hands.key(imgui.Key.space)
    hands.key(CTRL, imgui.Key.z)
    hands.note(undone=hands.height(), left_steps=len(session.journal.done))
    hands.press(_part(hands, x, y))
    hands.move(_part(hands, x, y - 5.0))
    _until(hands, lambda: session.stroke.shaped is not None)
    hands.note(before_escape=hands.height())
    hands.key(imgui.Key.escape)
    hands.move(_part(hands, x, y - 8.0))
    hands.release()
    hands.note(escaped=hands.height(), tool_after=session.tool, steps_after=len(session.journal.done))
    hands.key(imgui.Key.right_bracket)
    hands.note(larger=session.front.radius_m)


def anew(hands: Hands) -> None:
    """With Shift the hand draws where the crest shall stand."""
    ctx, session = hands.ctx, hands.session
    _ready(hands)
    x, y = PLACE
    hands.note(start=hands.height())
    ctx.key_down(int(SHIFT))
    hands.press(_part(hands, x - 10, y - 3))
    for off in (-6, -2, 2, 6, 10):
        hands.move(_part(hands, x + off, y - 3))
    _until(hands, lambda: session.stroke.shaped is not None)
    hands.note(drawing=session.stroke.anew, line=[list(point) for point in session.stroke.line])
    _let_go(hands)
    ctx.key_up(int(SHIFT))
    hands.note(drawn=[s.label for s in session.journal.done], drawn_ground=hands.height())


def held(hands: Hands) -> None:
    """A drag that a limit cuts short, for a picture of it while the hand is there."""
    session = hands.session
    session.set_front("slope_deg", 4.0)
    _ready(hands)
    x, y = PLACE
    hands.press(_part(hands, x, y))
    for way_m in (3.0, 9.0):
        hands.move(_part(hands, x, y - way_m))
    _until(hands, lambda: session.stroke.shaped is not None and not hands.editor.shapings.busy)
    hands.settle()
    hands.note(forbidden=[short.text for short in session.stroke.shaped.forbidden])


if __name__ == "__main__":
    window_drive.main(globals())
