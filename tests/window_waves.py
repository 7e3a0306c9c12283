"""Works wave objects in the real window; run by test_window_waves.py like window_drive.py."""

import numpy as np
import window_drive
from shorewright.app import wave_gizmo
from shorewright.app.camera_control import to_screen
from shorewright.app.tools import SELECT
from shorewright.level.objects import Camera
from window_drive import CTRL, Hands, imgui, shown


def wave_object(hands: Hands) -> None:
    """Drop a wave object by a click, drag its marker, turn it with Ctrl, draw its handles, fit it to the shore."""
    ctx, session = hands.ctx, hands.session
    hands.key(imgui.Key.space)
    hands.editor.move_camera(Camera(id="high", x=110.0, y=-40.0, z=90.0, yaw_deg=0.0, pitch_deg=-42.0))
    ctx.menu_click("//##MainMenuBar/Place/Drop: wave object")
    hands.until(lambda: session.selected, lambda: hands.drag((0.5, 0.6)))
    name = session.selected
    hands.note(dropped=name, steps=[step.label for step in session.journal.done])
    session.alter(name, {"radius_m": 30.0, "length_m": 9.0, "curvature": 0.5, "yaw_deg": 0.0})
    hands.until(lambda: session.tool == SELECT, lambda: hands.key(imgui.Key.v))
    session.selected = name
    ctx.yield_(3)

    def thing():
        return session.level.objects[name]

    def part(pixel) -> tuple[float, float]:
        return tuple(np.array(pixel) / np.array(hands.window.viewport.size))

    def marker() -> tuple[float, float]:
        found = {m.id: pixel for m, pixel in shown(session.level, session.camera, hands.window.viewport.size)}
        return part(found[name])

    def handle(which: str) -> tuple[float, float]:
        at = wave_gizmo.handles(session.level, thing())[which]
        return part(to_screen(session.camera, hands.window.viewport.size, at[None])[0][0])

    def drawn(start, *ways) -> tuple:
        before, steps = thing(), len(session.journal.done)
        hands.drag(start, *((start[0] + dx, start[1] + dy) for dx, dy in ways))
        changed = [f for f in type(before).model_fields if getattr(before, f) != getattr(thing(), f)]
        return changed, len(session.journal.done) - steps

    hands.note(moved=drawn(marker(), (0.03, 0.0), (0.06, 0.02)))
    ctx.key_down(CTRL)
    hands.note(turned=drawn(marker(), (0.03, 0.0), (0.06, 0.0)))
    ctx.key_up(CTRL)
    session.alter(name, {"yaw_deg": 0.0})
    ctx.yield_(2)
    for which in ("size", "bend", "aim"):
        hands.note(**{which: drawn(handle(which), (0.01, 0.015), (0.02, 0.03))})
    steps = len(session.journal.done)
    session.alter(name, {"radius_m": 60.0})
    hands.editor.do("wave.fit")
    hands.note(fitted=thing().curvature, fit_steps=len(session.journal.done) - steps - 1)
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])
    hands.settle()


if __name__ == "__main__":
    window_drive.main(globals())
