"""Works skies in the real window: named weather, storms, shots, paint, maps, curves; see window_drive.py."""

import sys
from pathlib import Path

import numpy as np
from imgui_bundle import imgui
from shorewright.app import timeline
from shorewright.app.panels import curve_editor
from shorewright.app.status_bar import day_text
from shorewright.app.timeline_marks import Strip, bars
from shorewright.level.cloud_profile import curve_samples
from shorewright.level.weather import weather_at
from shorewright.level.weather_presets import weather_of
from window_drive import CTRL, LEFT, RIGHT, SHIFT, Hands, main


def story(hands: Hands) -> None:
    """A weather from the menu and the panel, a storm that comes and goes, a shot made, dragged, renamed, removed."""
    hands.session.pause()
    hands.session.scrub(12.0)
    hands.editor.choose_quality("low")
    hands.ctx.yield_(3)
    _named(hands)
    _storm(hands)
    _shot(hands)
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])


def _menu(hands: Hands, title: str) -> None:
    """Something of the menu Weather that is a step."""
    steps = len(hands.session.journal.done)
    row = f"//##MainMenuBar/Weather/{title}"
    hands.until(lambda: len(hands.session.journal.done) > steps, lambda: hands.ctx.menu_click(row))


def _undo(hands: Hands) -> None:
    left = len(hands.session.journal.done) - 1
    hands.until(lambda: len(hands.session.journal.done) <= left, lambda: hands.key(CTRL, imgui.Key.z))


def _named(hands: Hands) -> None:
    """Gale by the menu; calm by the panel over a sky that is all painted, which is told."""
    ctx, session = hands.ctx, hands.session
    before = session.level.settings
    _menu(hands, "Gale")
    hands.note(menu=weather_of(session.level.settings), menu_steps=[s.label for s in session.journal.done])
    _undo(hands)
    hands.note(menu_undone=session.level.settings == before, told_before=len(hands.editor.messages.lines))
    ctx.window_focus("//Weather map")
    ctx.yield_(3)
    hands.until(lambda: session.journal.done, lambda: ctx.item_click("//Weather map/**/###sky.fill"))
    hands.note(filled=float(session.level.layers["weather"].array[..., 3:].min()))

    def choose() -> None:
        ctx.item_click("//Weather map/###weather_preset")
        ctx.item_click("//$FOCUSED/###preset_calm")

    hands.until(lambda: weather_of(session.level.settings) == "calm", choose)
    hands.note(panel=weather_of(session.level.settings), panel_steps=[s.label for s in session.journal.done])
    ctx.yield_(3)
    hands.note(told=[line.text for line in hands.editor.messages.lines])
    _undo(hands)
    _undo(hands)
    hands.note(panel_undone=session.level.settings == before and session.level.layers["weather"].neutral)


def _storm(hands: Hands) -> None:
    """By the menu it sets out now; the panel's button ends it."""
    ctx, session = hands.ctx, hands.session
    before = session.level.settings

    def storm() -> list:
        settings = session.level.settings
        return [settings.clouds.on, settings.storm.chance, settings.storm.start_s]

    _menu(hands, "Bring a storm")
    hands.note(storm=storm())
    button = "//Weather map/**/###weather_storm"
    hands.until(lambda: session.level.settings.storm.chance == 0, lambda: ctx.item_click(button))
    hands.note(storm_ended=storm(), storm_steps=[s.label for s in session.journal.done])
    _undo(hands)
    _undo(hands)
    hands.note(storm_undone=session.level.settings == before)


def _shot(hands: Hands) -> None:
    """At the clock's place; its ends and all of it by the mouse; another name; away; each is undone."""
    ctx, session = hands.ctx, hands.session

    def times(name: str = "shot-1") -> list:
        shot = session.level.objects.get(name)
        return [shot.start_s, shot.end_s] if shot else []

    _menu(hands, "New shot from the sky now")
    hands.note(made=times(), taken=session.selected, skies=len(session.level.skies), made_at=session.clock.time_s)
    for name, at_s, to_s in (("end", 32.0, 42.0), ("start", 12.0, 6.0), ("moved", 20.0, 25.0)):
        steps = len(session.journal.done)
        hands.until(lambda: len(session.journal.done) > steps, lambda: _pull(hands, at_s, to_s))  # noqa: B023
        hands.note(**{name: times(), f"{name}_steps": len(session.journal.done) - steps})
    hands.note(clock=session.clock.time_s)
    _press(hands, 20.0)
    hands.note(clicked=session.clock.time_s, clicked_steps=len(session.journal.done) - steps)
    back = []
    for _ in range(3):
        _undo(hands)
        back.append(times())
    hands.note(back=back)
    ctx.window_focus("//Objects")
    ctx.yield_(3)
    ctx.item_input_value("//Objects/**/###object_name", "dawn")
    ctx.yield_(3)
    hands.note(
        renamed=times("dawn"), in_hand=session.selected, shown=[bar.shot.id for bar in bars(session.level, 0, 60)]
    )
    hands.note(button=ctx.item_exists("//Objects/**/###shot_to_paint"))
    hands.until(lambda: "dawn" not in session.level.objects, lambda: hands.key(imgui.Key.delete))
    hands.note(removed=times("dawn"))
    _undo(hands)
    hands.note(unremoved=times("dawn"))
    _undo(hands)
    hands.note(unrenamed=times())
    _undo(hands)
    hands.note(unmade=times(), steps_left=len(session.journal.done))
    session.set_all("Day", {"light.sun_from": "date", "light.day_rate": 600.0})
    ctx.yield_(3)
    hands.note(hour=day_text(hands.editor).strip())


def _strip(hands: Hands) -> Strip:
    box = hands.ctx.item_info("//Timeline/###scrub").rect_full
    first, last = timeline.span(hands.session.clock.time_s, hands.session.clock.loop)
    return Strip(box.min.x, box.min.y + 2, box.max.x, box.max.y, first, last)


def _press(hands: Hands, at_s: float) -> Strip:
    """A click in the lowest lane."""
    strip = _strip(hands)
    hands.ctx.mouse_move_to_pos((strip.x_of(at_s), strip.foot(0) - 2))
    hands.ctx.yield_(2)
    hands.ctx.mouse_click(LEFT)
    hands.ctx.yield_(2)
    return strip


def _pull(hands: Hands, at_s: float, to_s: float) -> None:
    """Drag what lies in the lowest lane at a moment to another."""
    ctx, strip = hands.ctx, _strip(hands)
    ctx.mouse_move_to_pos((strip.x_of(at_s), strip.foot(0) - 2))
    ctx.yield_(2)
    ctx.mouse_down(LEFT)
    for part in (0.4, 0.7, 1.0):
        ctx.mouse_move_to_pos((strip.x_of(at_s + part * (to_s - at_s)), strip.foot(0) - 2))
        ctx.yield_(2)
    ctx.mouse_up(LEFT)
    ctx.yield_(2)


def weather(hands: Hands) -> None:
    """A sky by its swatch, painted in the picture and on the map, taken back; nothing over land; the eyedropper."""
    ctx, session = hands.ctx, hands.session
    session.pause()
    session.camera = session.camera.model_copy(update={"x": 110.0, "y": 20.0, "z": 6.0, "yaw_deg": 10, "pitch_deg": 8})
    hands.note(start=hands.sky())
    hands.until(lambda: session.brush == "weather", lambda: hands.key(imgui.Key._9))
    hands.drag((0.5, 0.85), (0.6, 0.9))
    hands.note(brush=session.brush, over_land=hands.sky(), pointed=session.sky_cursor)
    ctx.window_focus("//Weather map")
    ctx.yield_(3)
    params = session.params
    swatch = "//Weather map/**/###cloud_thunderstorm"
    hands.until(lambda: params["weather"].precipitation == 1, lambda: ctx.item_click(swatch))
    hands.note(targets=[params["weather"].coverage, params["weather"].precipitation, params["weather"].type])

    def over_the_sky() -> None:
        hands.press((0.4, 0.15))
        hands.move((0.5, 0.2))
        hands.move((0.6, 0.12))
        if session.stroke is not None:
            hands.note(ring=session.sky_cursor, during=hands.sky())
        hands.release()

    hands.until(lambda: session.journal.done, over_the_sky)
    hands.note(after=hands.sky(), steps=[s.label for s in session.journal.done])
    session.scrub(session.clock.time_s + 60)  # the wind carries it on; the recorded stroke stays
    hands.until(lambda: session.journal.undone, lambda: hands.key(CTRL, imgui.Key.z))
    hands.note(undone=hands.sky())
    hands.until(lambda: not session.journal.undone, lambda: hands.key(CTRL, SHIFT, imgui.Key.z))
    hands.note(redone=hands.sky())
    _paint_map(hands)
    for left in (1, 0):
        hands.until(lambda left=left: len(session.journal.done) <= left, lambda: hands.key(CTRL, imgui.Key.z))
    hands.note(undone_at_last=hands.sky(), bad=[line.text for line in hands.editor.messages.lines if line.bad])


def _paint_map(hands: Hands) -> None:
    """A stroke on the panel, its wheel, its eyedropper."""
    ctx, session, panel = hands.ctx, hands.session, hands.window.weather
    ctx.scroll_to_top("//Weather map")
    ctx.yield_(3)
    side = panel.sight.side

    def go(x: float, y: float) -> None:
        ctx.mouse_move_to_pos((panel.corner[0] + side * x, panel.corner[1] + side * y))
        ctx.yield_(2)

    def stroke() -> None:
        go(0.3, 0.3)
        ctx.mouse_down(LEFT)
        ctx.yield_(2)
        go(0.6, 0.35)
        hands.note(map_pointer=hands.editor.map_pointer)
        ctx.mouse_up(LEFT)

    def take() -> None:
        ctx.key_down(int(imgui.Key.p))
        ctx.yield_(2)
        ctx.mouse_click(LEFT)
        ctx.yield_(2)
        ctx.key_up(int(imgui.Key.p))

    hands.until(lambda: len(session.journal.done) > 1, stroke)
    hands.note(on_map=hands.sky(), map_steps=[s.label for s in session.journal.done])
    session.set_param("coverage", 0.1)
    hands.until(lambda: session.params["weather"].coverage > 0.5, take)
    hands.note(taken=session.params["weather"].coverage, took_steps=len(session.journal.done))
    hands.until(lambda: panel.sight.span_m < 60_000, lambda: ctx.mouse_wheel_y(3))
    hands.note(zoomed_m=panel.sight.span_m)


def skies(hands: Hands) -> None:
    """A weather map by its dialog, told about first; height curves of clouds by the mouse; the sky written out."""
    ctx, session, folder = hands.ctx, hands.session, Path(sys.argv[2]).parent
    hands.key(imgui.Key.space)
    ctx.menu_click("//##MainMenuBar/File/Import weather map…")
    ctx.yield_(2)
    ctx.item_click("//$FOCUSED/###open_path")
    ctx.key_chars_replace(str(folder / "cut.png"))
    ctx.item_click("//$FOCUSED/Channels")
    ctx.key_chars_replace("r,q,b")
    ctx.item_click("//$FOCUSED/Import")
    ctx.yield_(4)
    hands.note(error=hands.window.dialogs.error)
    ctx.item_click("//$FOCUSED/Channels")
    ctx.key_chars_replace("r,0,0.6")
    ctx.mouse_move("//$FOCUSED/Import")
    ctx.mouse_click(0)
    ctx.yield_(6)
    form = hands.window.dialogs.form
    if form is not None:  # the click that took the field's focus away
        ctx.item_click("//$FOCUSED/Import")
        ctx.yield_(4)
    hands.note(told=[line.text for line in hands.editor.messages.lines])
    layer = session.level.layers["weather"]
    hands.note(steps=[s.label for s in session.journal.done], painted=int(layer.written.sum()))
    ctx.menu_click("//##MainMenuBar/File/Export weather map…")
    ctx.item_input_value("//$FOCUSED/###save_path", str(folder / "out.png"))
    ctx.yield_(4)
    hands.note(written=(folder / "out.png").exists())
    _curves(hands)


def _curves(hands: Hands) -> None:
    """Drag a point of cumulus, add one on its line, remove it; each is a step."""
    ctx, session = hands.ctx, hands.session
    ctx.item_input_value("//Settings/**/###filter", "density by height")
    ctx.yield_(4)
    box = ctx.item_info("//Settings/**/###curves").rect_full
    corner, width = box.min, box.max.x - box.min.x

    def at(height: float, density: float) -> tuple[float, float]:
        x, y = curve_editor._to_px(corner, width, height, density)
        return float(x), float(y)

    def curve() -> tuple:
        return session.level.settings.clouds.cumulus

    before, count = curve(), len(session.journal.done)
    ctx.mouse_move_to_pos(at(*before[4:6]))
    ctx.yield_(2)
    ctx.mouse_down(LEFT)
    for part in (0.3, 0.6, 1.0):
        ctx.mouse_move_to_pos(at(before[4] + 0.08 * part, before[5] - 0.3 * part))
        ctx.yield_(2)
    ctx.mouse_up(LEFT)
    ctx.yield_(2)
    hands.note(dragged=curve(), drag_steps=len(session.journal.done) - count)
    line = float(np.interp(0.5, np.linspace(0, 1, 1001), curve_samples(curve(), 1001)))
    ctx.mouse_move_to_pos(at(0.5, line))
    ctx.yield_(2)
    ctx.mouse_click(LEFT)
    ctx.yield_(2)
    hands.note(added=curve(), add_steps=len(session.journal.done) - count)
    ctx.mouse_move_to_pos(at(*curve()[8:10]))
    ctx.yield_(2)
    ctx.mouse_click(RIGHT)
    ctx.yield_(2)
    hands.note(removed=curve(), remove_steps=len(session.journal.done) - count)
    hands.key(CTRL, imgui.Key.z)
    hands.key(CTRL, imgui.Key.z)
    hands.key(CTRL, imgui.Key.z)
    hands.note(undone=curve() == before, before=before)
    ctx.item_click("//Settings/**/###curve_above")
    ctx.yield_(2)
    place = (session.camera.x, session.camera.y)
    sky = weather_at(session.level, session.clock.time_s, *(np.array([part]) for part in place), place)
    hands.note(above=curve_editor._state["type"], sky_above=float(sky[0, 2]))
    ctx.mouse_move_to_pos(at(*before[4:6]))
    ctx.yield_(2)
    hands.settle()


if __name__ == "__main__":
    main(globals())
