"""Works rivers in the real window; run by test_window_rivers.py like window_drive.py."""

import numpy as np
import window_drive
from shorewright.app import river_gizmo
from shorewright.app.camera_control import to_screen
from shorewright.app.tools import LAKE, SELECT
from shorewright.level.objects import Camera
from window_drive import CTRL, SHIFT, Hands, imgui


def river(hands: Hands) -> None:
    """Drop a river by a click, draw a point about, widen it, raise its water, put a point in and take it out, carve."""
    ctx, session = hands.ctx, hands.session
    hands.key(imgui.Key.space)
    hands.editor.move_camera(Camera(id="high", x=128.0, y=-20.0, z=170.0, yaw_deg=0.0, pitch_deg=-50.0))
    ctx.menu_click("//##MainMenuBar/Place/Drop: river")
    hands.until(lambda: session.selected, lambda: hands.drag((0.5, 0.22)))
    name = session.selected
    hands.note(dropped=name, downhill=bool((np.diff([p[3] for p in thing(hands, name).points]) <= 0).all()))
    hands.until(lambda: session.tool == SELECT, lambda: hands.key(imgui.Key.v))
    session.selected = name
    session.alter(name, {"points": ((0, 0, 8, 9, 1), (10, -60, 8, 6, 1), (0, -120, 10, 1, 1))})
    ctx.yield_(3)

    def handle(which: str) -> tuple[float, float]:
        at = river_gizmo.handles(session.level, thing(hands, name), session.river_point)[which]
        pixel = to_screen(session.camera, hands.window.viewport.size, at[None])[0][0]
        return tuple(np.array(pixel) / np.array(hands.window.viewport.size))

    def drawn(which: str, dx: float, dy: float) -> list:
        """Which numbers of which points a drag of a handle changes, and how many steps it leaves."""
        before, steps, start = thing(hands, name).points, len(session.journal.done), handle(which)
        hands.drag(start, (start[0] + dx / 2, start[1] + dy / 2), (start[0] + dx, start[1] + dy))
        after = thing(hands, name).points
        changed = [(n, i) for n in range(len(before)) for i in range(5) if before[n][i] != after[n][i]]
        return [changed, len(session.journal.done) - steps]

    hands.note(moved=drawn("point 1", 0.04, 0.0), widened=drawn("width 1", 0.03, 0.0))
    ctx.key_down(SHIFT)
    hands.note(raised=drawn("point 1", 0.0, -0.02))
    ctx.key_up(SHIFT)
    middle = tuple((a + b) / 2 for a, b in zip(handle("point 0"), handle("point 1"), strict=True))
    ctx.key_down(CTRL)
    hands.until(lambda: len(thing(hands, name).points) == 4, lambda: hands.drag(middle))
    ctx.key_up(CTRL)
    hands.note(inserted=session.river_point)
    hands.until(lambda: len(thing(hands, name).points) == 3, lambda: hands.key(imgui.Key.delete))
    before = hands.height()
    hands.editor.do("river.carve")
    hands.note(carved=hands.height() != before, undone=_undone(hands) == before)
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])
    ctx.menu_click("//##MainMenuBar/Place/Fill with water")
    hands.note(tool=session.tool == LAKE)
    hands.drag((0.5, 0.22))
    hands.note(dry=[line.text for line in hands.editor.messages.lines if line.bad][-1:])
    hands.settle()


def thing(hands: Hands, name: str):
    return hands.session.level.objects[name]


def _undone(hands: Hands) -> str:
    hands.editor.do("undo")
    return hands.height()


if __name__ == "__main__":
    window_drive.main(globals())
