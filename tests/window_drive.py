"""Works the real window by imgui's test engine, as a person would, and writes down what came of it.

Run by the fixture `drive` in a process of its own: `python window_drive.py SCENARIO LEVEL RECORD.json [SCREENSHOT]`.
Skies, shots and named weather are worked by window_weather.py.
docs/pictures/editor.jpg is `portrait` of a copy of sample_levels/cove.shore.
"""

import hashlib
import json
import os
import sys
from pathlib import Path

import numpy as np
from imgui_bundle import hello_imgui, imgui
from shorewright.app import picture as picture_module
from shorewright.app import window as editor_window
from shorewright.app.object_markers import shown
from shorewright.app.panels import gradient, history_panel
from shorewright.app.preferences import Preferences
from shorewright.app.session import Session
from shorewright.io.images import write_image
from shorewright.level.environments import environment_of

CTRL, SHIFT, ALT = imgui.Key.mod_ctrl, imgui.Key.mod_shift, imgui.Key.mod_alt
LEFT, RIGHT, MIDDLE = 0, 1, 2
SIZE = (1100, 700)


class Hands:
    """A person at the window: `ctx` is the test engine's context."""

    def __init__(self, ctx, window) -> None:
        self.ctx, self.window, self.editor = ctx, window, window.editor
        self.record: dict = {}
        ctx.yield_(4)

    @property
    def session(self) -> Session:
        return self.editor.session

    def height(self) -> str:
        """Digest of the ground's bytes."""
        return hashlib.sha256(self.session.level.height.tobytes()).hexdigest()

    def sky(self) -> str:
        """Digest of the painted weather."""
        return hashlib.sha256(self.session.level.layers["weather"].array.tobytes()).hexdigest()

    def volume(self) -> float:
        """Sum of all heights."""
        return float(self.session.level.height.sum(dtype=np.float64))

    def note(self, **facts) -> None:
        self.record.update(facts)

    def at(self, x: float, y: float) -> tuple[float, float]:
        """Screen pixels of a place in the viewport, given as parts of its sides."""
        corner, size = self.window.viewport.corner, self.window.viewport.size
        return corner[0] + size[0] * x, corner[1] + size[1] * y

    def press(self, place, button=LEFT) -> None:
        self.ctx.mouse_move_to_pos(self.at(*place))
        self.ctx.yield_(2)
        self.ctx.mouse_down(button)
        self.ctx.yield_(2)

    def move(self, place) -> None:
        self.ctx.mouse_move_to_pos(self.at(*place))
        self.ctx.yield_(2)

    def release(self, button=LEFT) -> None:
        self.ctx.mouse_up(button)
        self.ctx.yield_(2)

    def drag(self, *places, button=LEFT) -> None:
        self.press(places[0], button)
        for place in places[1:]:
            self.move(place)
        self.release(button)

    def key(self, *chord) -> None:
        total = 0
        for part in chord:
            total |= int(part)
        self.ctx.key_press(total)
        self.ctx.yield_(2)

    def until(self, done, work, tries: int = 4) -> None:
        """Do something by hand, again while it had no effect: a busy computer may miss a click."""
        for _ in range(tries):
            work()
            self.ctx.yield_(4)
            if done():
                return

    def settle(self) -> None:
        """Wait for the still picture."""
        for _ in range(400):
            self.ctx.yield_(1)
            if not self.window.picture.waiting:
                return


def sculpt(hands: Hands) -> None:
    """The issue's own story: pick ramp, drag across the beach, pause, undo, save; and Esc gives a stroke up."""
    ctx, session = hands.ctx, hands.session
    hands.note(start=hands.height(), ran=not session.clock.paused)
    ctx.item_click("//Brushes/###ramp")
    hands.key(imgui.Key.space)
    hands.note(brush=session.brush, paused=session.clock.paused, time_s=session.clock.time_s)
    hands.press((0.42, 0.42))
    hands.move((0.5, 0.5))
    hands.move((0.58, 0.6))
    hands.note(during=hands.height(), preview=session.stroke.preview()["front_speed_mps"])
    hands.release()
    hands.note(after=hands.height(), steps=[s.label for s in session.journal.done], title=session.title)
    hands.key(CTRL, imgui.Key.z)
    hands.note(undone=hands.height())
    hands.key(CTRL, SHIFT, imgui.Key.z)
    hands.note(redone=hands.height())
    hands.key(CTRL, imgui.Key.s)
    hands.note(dirty=session.dirty, saved=hands.height())
    hands.press((0.4, 0.6))
    hands.move((0.5, 0.7))
    hands.note(before_escape=hands.height())
    hands.key(imgui.Key.escape)
    hands.move((0.6, 0.5))
    hands.note(escaped=hands.height())
    hands.release()
    hands.note(at_last=hands.height(), steps_at_last=len(session.journal.done), time_at_last=session.clock.time_s)


def keys(hands: Hands) -> None:
    """Modifiers while brushing, and the keys of ACTIONS."""
    ctx, session = hands.ctx, hands.session
    hands.key(imgui.Key.space)
    hands.key(imgui.Key._1)
    size = session.params["raise"].size_m
    hands.key(imgui.Key.right_bracket)
    hands.note(brush=session.brush, larger=session.params["raise"].size_m > size)
    strength = session.params["raise"].strength
    hands.key(SHIFT, imgui.Key.left_bracket)
    hands.note(weaker=session.params["raise"].strength < strength)
    for name, modifier in (("plain", None), ("inverted", CTRL), ("smoothed", SHIFT)):
        before = hands.volume()
        if modifier:
            ctx.key_down(int(modifier))
        hands.drag((0.5, 0.5), (0.56, 0.5))
        if modifier:
            ctx.key_up(int(modifier))
        hands.note(**{name: [session.journal.done[-1].label, hands.volume() - before]})
    hands.key(imgui.Key._2)
    hands.note(second=session.brush)
    hands.key(SHIFT, imgui.Key.w)
    hands.note(water="water" in session.show)
    hands.key(imgui.Key.n)
    hands.note(walkable=hands.editor.walkable)
    hands.key(ALT, imgui.Key._1)
    hands.note(hidden=sorted(session.show.hidden))
    time_s = session.clock.time_s
    hands.key(imgui.Key.period)
    hands.note(stepped=session.clock.time_s - time_s, step_s=session.clock.step_s)
    hands.key(CTRL, imgui.Key.p)
    ctx.key_chars("clock dep")
    hands.key(imgui.Key.enter)
    ctx.yield_(2)
    hands.note(view=session.view, palette=hands.window.palette.open)
    ctx.item_click("//Viewport/###walkable")
    hands.note(walkable_again=hands.editor.walkable)


def look(hands: Hands) -> None:
    """The camera by mouse; nothing of it touches the level. A still picture isn't drawn again."""
    ctx, session = hands.ctx, hands.session
    hands.key(imgui.Key.space)
    start = hands.height()
    cameras = [session.camera.model_dump()]
    hands.drag((0.5, 0.5), (0.6, 0.55), button=MIDDLE)
    cameras.append(session.camera.model_dump())
    ctx.key_down(int(ALT))
    hands.drag((0.5, 0.5), (0.45, 0.55))
    ctx.key_up(int(ALT))
    cameras.append(session.camera.model_dump())
    hands.move((0.5, 0.5))
    ctx.mouse_wheel_y(2)
    ctx.yield_(3)
    cameras.append(session.camera.model_dump())
    hands.press((0.5, 0.5), RIGHT)
    ctx.key_hold(int(imgui.Key.w), 0.3)
    hands.note(water_while_flying="water" in session.show)
    hands.release(RIGHT)
    cameras.append(session.camera.model_dump())
    hands.note(cameras=cameras, same=hands.height() == start, steps=len(session.journal.done))
    hands.settle()
    draws, frames = hands.window.picture.draws, imgui.get_frame_count()
    ctx.yield_(20)
    hands.note(still_draws=hands.window.picture.draws - draws, still_frames=imgui.get_frame_count() - frames)
    drawn = hands.window.picture.drawn
    hands.note(full=list(drawn.size), viewport=list(hands.window.viewport.size))


def light(hands: Hands) -> None:
    """An environment by its button in the settings, another by the menu; each is one step to undo."""
    ctx, session = hands.ctx, hands.session
    hands.key(imgui.Key.space)
    before = session.level.settings
    ctx.item_open("//Settings/**/###section_light")
    ctx.yield_(2)
    ctx.item_click("//Settings/**/###environment_storm")
    hands.settle()
    hands.note(button=environment_of(session.level.settings), steps=[s.label for s in session.journal.done])
    ctx.menu_click("//##MainMenuBar/Light/Moonlit")
    hands.settle()
    hands.note(menu=environment_of(session.level.settings), steps_then=len(session.journal.done))
    hands.note(picture=hands.window.picture.failure, view_before=session.view)
    hands.key(CTRL, imgui.Key.z)
    hands.key(CTRL, imgui.Key.z)
    hands.note(undone=session.level.settings == before)
    ctx.key_down(int(imgui.Key.l))
    hands.drag((0.5, 0.5), (0.6, 0.4), (0.65, 0.35))
    ctx.key_up(int(imgui.Key.l))
    turned = session.level.settings.light
    hands.note(sun=[turned.sun_azimuth_deg, turned.sun_elevation_deg], sun_before=before.light.sun_azimuth_deg)
    hands.note(sun_lower=before.light.sun_elevation_deg, sun_steps=[s.label for s in session.journal.done])
    picture_module.LONGEST_SAMPLE_S, picture_module.SETTLE_S = 1e9, 0.01  # as on a computer with a graphics card
    hands.settle()
    hands.note(samples=hands.window.picture.drawn.samples)


def panels(hands: Hands) -> None:
    """A slider drag is one step, history and timeline go where they are clicked, broken code costs one panel."""
    ctx, session = hands.ctx, hands.session
    hands.key(imgui.Key.space)
    ctx.item_drag_with_delta("//Settings/**/shore.range_m/##value", (40, 0))
    ctx.yield_(3)
    hands.note(steps=[s.label for s in session.journal.done], range_m=session.level.settings.shore.range_m)
    ctx.item_drag_with_delta("//Settings/**/shore.range_m/##value", (-20, 0))
    ctx.yield_(3)
    hands.note(steps_after_second=len(session.journal.done))
    ctx.window_focus("//History")
    ctx.yield_(2)
    ctx.item_click("//History/**/###step_1")
    ctx.yield_(3)
    hands.note(went_to=len(session.journal.done), redoable=len(session.journal.undone))
    item = ctx.item_info("//Timeline/###scrub")
    left, right = item.rect_full.min, item.rect_full.max
    ctx.mouse_move_to_pos((left.x + (right.x - left.x) / 2, (left.y + right.y) / 2))
    ctx.mouse_click(0)
    ctx.yield_(2)
    hands.note(scrubbed_s=session.clock.time_s)
    good, hands.record["told"] = history_panel.draw, ""

    def broken(editor) -> None:
        imgui.begin_child("half open")
        imgui.push_id("left behind")
        raise RuntimeError("the history broke")

    history_panel.draw = broken
    ctx.yield_(3)
    history_panel.draw = good
    hands.note(told=hands.editor.messages.lines[-1].text, failures=dict(hands.window.guard.failures))
    ctx.yield_(3)
    hands.note(healed=not hands.window.guard.failures)
    renderer = hands.window.picture.renderer
    renderer.draw = lambda *args, **named: 1 / 0
    session.scrub(7.0)
    ctx.yield_(3)
    hands.note(picture_failed=hands.window.picture.failure, heights=hands.height())
    hands.window.picture._failed_at = -1e9  # don't wait for the retry
    ctx.yield_(3)
    hands.note(picture_healed=hands.window.picture.drawn is not None)


def _exported(hands: Hands) -> int:
    """Frames that the window drew until an export was through."""
    frames = 0
    while hands.window.dialogs.open and frames < 4000:
        hands.ctx.yield_(1)
        frames += 1
    return frames


def files(hands: Hands) -> None:
    """Save as, export and open through the dialogs, by typed paths; a bad path is told and the dialog stays."""
    ctx, folder = hands.ctx, Path(sys.argv[2]).parent
    hands.key(imgui.Key.space)
    hands.drag((0.42, 0.42), (0.55, 0.55))
    hands.key(CTRL, SHIFT, imgui.Key.s)
    ctx.item_input_value("//$FOCUSED/###save_path", str(folder / "other"))  # ends with Enter, which confirms
    ctx.yield_(4)
    hands.note(path=str(hands.session.path), dirty=hands.session.dirty, height=hands.height())
    hands.key(CTRL, imgui.Key.e)
    ctx.item_click("//$FOCUSED/###target_raw")
    hands.note(suggested=hands.window.dialogs.form.field.text)
    form = hands.window.dialogs.form
    hands.note(all_maps=form.choice.told(form.targets[form.target].maps))
    ctx.item_click("//$FOCUSED/###export_maps")
    ctx.item_click("//$FOCUSED/###maps_none")
    ctx.key_press(imgui.Key.escape)
    ctx.item_click("//$FOCUSED/Export")
    ctx.yield_(4)
    hands.note(no_map=hands.window.dialogs.error)
    ctx.item_click("//$FOCUSED/###export_maps")
    ctx.item_click("//$FOCUSED/###map_height")
    ctx.item_click("//$FOCUSED/###map_mesh")
    ctx.key_press(imgui.Key.escape)
    hands.note(two_maps=form.choice.told(form.targets[form.target].maps))
    ctx.item_input_value("//$FOCUSED/###folder_path", str(folder / "out"))
    hands.note(frames=_exported(hands))
    hands.key(CTRL, imgui.Key.e)
    ctx.item_input_value("//$FOCUSED/###folder_path", str(folder / "cancelled"))
    hands.note(begun=hands.window.dialogs.form.background is not None)
    ctx.item_click("//$FOCUSED/Cancel")
    _exported(hands)
    hands.note(cancelled=(folder / "cancelled").exists(), told=hands.editor.messages.lines[-1].text)
    hands.note(exported=sorted(p.name for p in (folder / "out").iterdir()))
    hands.key(CTRL, imgui.Key.o)
    ctx.item_input_value("//$FOCUSED/###folder_path", str(folder / "nowhere.shore"))
    ctx.yield_(4)
    hands.note(error=hands.window.dialogs.error, still_open=hands.window.dialogs.open)
    ctx.item_click("//$FOCUSED/###folder_path")
    ctx.key_chars_replace(sys.argv[2])
    ctx.item_click("//$FOCUSED/Open")
    ctx.yield_(6)
    hands.note(reopened=str(hands.session.path), closed=not hands.window.dialogs.open, original=hands.height())
    hands.note(picture=hands.window.picture.failure, recent=hands.editor.preferences.recent)


def objects(hands: Hands) -> None:
    """Drop a lamp by a click, drag it, undo; rename and delete in the panel; drag a stop of a water table."""
    ctx, session = hands.ctx, hands.session
    hands.key(imgui.Key.space)
    start = hands.height()
    ctx.menu_click("//##MainMenuBar/Place/Drop: lamp")
    hands.until(lambda: session.selected, lambda: hands.drag((0.5, 0.55)))
    lamp = session.level.objects[session.selected]
    hands.note(dropped=lamp.id, tool=session.tool, steps=[s.label for s in session.journal.done])
    hands.key(imgui.Key.v)
    size = hands.window.viewport.size
    at = {marker.id: pixel for marker, pixel in shown(session.level, session.camera, size)}[lamp.id]
    east, north = at / np.array(size)
    hands.drag((east, north), (east + 0.1, north), (east + 0.2, north + 0.02))
    moved = session.level.objects[lamp.id]
    hands.note(moved=moved.x - lamp.x, steps_moved=len(session.journal.done))
    hands.key(CTRL, imgui.Key.z)
    hands.note(back=session.level.objects[lamp.id] == lamp)
    ctx.window_focus("//Objects")
    ctx.yield_(2)
    _choose(hands, lamp.id)
    ctx.item_input_value("//Objects/**/###object_name", "pier")
    ctx.yield_(3)
    hands.note(renamed="pier" in session.level.objects and session.selected == "pier")
    _gradient(hands)
    _choose(hands, "pier")
    hands.until(lambda: "pier" not in session.level.objects, lambda: hands.key(imgui.Key.delete))
    hands.note(deleted="pier" not in session.level.objects)
    hands.key(imgui.Key.escape)
    hands.key(imgui.Key.escape)
    hands.note(tool_at_last=session.tool, same_ground=hands.height() == start)
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])
    hands.settle()


def _choose(hands: Hands, name: str) -> None:
    """An object by its row in the panel, found by the filter."""
    hands.ctx.item_input_value("//Objects/###object_filter", name)
    hands.ctx.yield_(3)
    row = f"//Objects/**/###object_{name}"
    hands.until(lambda: hands.session.selected == name, lambda: hands.ctx.item_click(row))


def _gradient(hands: Hands) -> None:
    """A water table by the palette, and a drag of one of its stops."""
    ctx, session = hands.ctx, hands.session

    def add() -> None:
        hands.key(CTRL, imgui.Key.p)
        ctx.key_chars("water table")
        hands.key(imgui.Key.enter)

    hands.until(lambda: session.selected == "water-1", add)
    table = session.level.objects[session.selected]
    ctx.yield_(3)
    box = ctx.item_info("//Objects/**/###gradient").rect_full
    x = box.min.x + (box.max.x - box.min.x) * gradient.to_axis(table.stops[5][0])
    y = box.min.y + gradient.STRIP_PX + gradient.HANDLE_PX / 2
    steps = len(session.journal.done)

    def pull() -> None:
        ctx.mouse_move_to_pos((x, y))
        ctx.mouse_down(LEFT)
        for way in (1, 2, 3):
            ctx.mouse_move_to_pos((x + way, y))
            ctx.yield_(2)
        ctx.mouse_up(LEFT)

    hands.until(lambda: session.level.objects[table.id] != table, pull)
    hands.note(stop=[table.stops[5][0], session.level.objects[table.id].stops[5][0]])
    hands.note(stop_steps=len(session.journal.done) - steps)
    hands.note(in_use=session.level.settings.water.table == table.id)


def portrait(hands: Hands) -> None:
    """The picture of the documentation: a ramp being dragged at a paused moment."""
    hands.session.pause()
    hands.session.scrub(14.0)
    hands.ctx.item_click("//Brushes/###ramp")
    hands.press((0.52, 0.72))
    hands.move((0.44, 0.6))
    hands.move((0.36, 0.5))
    hands.settle()


def waves(hands: Hands) -> None:
    """The clock's masks along a cut through the pointer (D03, H28); nothing in the panel broke."""
    hands.session.pause()
    hands.session.scrub(14.0)
    hands.ctx.window_focus("//Waves")
    hands.move((0.3, 0.55))
    hands.settle()
    kept = hands.window.waves.kept
    cut, (lowest, highest), before_after = (kept[name][1] for name in ("cut", "band", "ghosts"))
    hands.note(line=float((cut.a - cut.b).max()), samples=len(cut.along_m), ghosts=len(before_after))
    hands.note(band=float((highest - lowest).max()))
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])


def killed(hands: Hands) -> None:
    """The editor dies without a word after a stroke."""
    hands.session.keep_log()
    hands.key(imgui.Key.space)
    hands.drag((0.42, 0.42), (0.55, 0.55))
    hands.note(after=hands.height())
    hands.session.recovery.settle()
    write(hands.record)
    os._exit(9)


def restored(hands: Hands) -> None:
    """The next start offers what the killed one had."""
    hands.window.dialogs.offer_recovery()
    hands.ctx.yield_(3)
    hands.note(asked=hands.window.dialogs.form.text if hands.window.dialogs.form else "")
    hands.ctx.item_click("//$FOCUSED/Restore")
    hands.ctx.yield_(4)
    hands.note(after=hands.height(), dirty=hands.session.dirty)
    hands.ctx.key_press(int(CTRL) | int(imgui.Key.q))
    hands.ctx.yield_(3)
    hands.note(leaving=hands.window.dialogs.form.title, shall_exit=hands.editor.shall_exit)
    hands.ctx.item_click("//$FOCUSED/Cancel")
    hands.ctx.yield_(2)


def write(record: dict) -> None:
    Path(sys.argv[3]).write_text(json.dumps(record))


def main(scenarios: dict) -> None:
    scenario = scenarios[sys.argv[1]]
    hands: list[Hands] = []

    def drive(ctx, window) -> None:
        hands.append(Hands(ctx, window))
        scenario(hands[0])

    size = (1600, 900) if sys.argv[1] == "portrait" else SIZE
    preferences = Preferences(window_width=size[0], window_height=size[1])
    with Session.open(sys.argv[2]) as session:
        editor_window.run(session, preferences, drive)
    write(hands[0].record)
    if len(sys.argv) > 4:
        write_image(sys.argv[4], np.ascontiguousarray(hello_imgui.final_app_window_screenshot()[..., :3]))


if __name__ == "__main__":
    main(globals())
