"""Works the clock in the real window: markers, steps, probes, the timing panel; see window_drive.py."""

import numpy as np
from imgui_bundle import imgui
from window_drive import CTRL, LEFT, SHIFT, Hands, main


def time_by_hand(hands: Hands) -> None:
    """Time by hand: a marker by its button, dragged on the bar, jumped to; steps by a wave."""
    ctx, session = hands.ctx, hands.session
    session.set_all("Tide", {"tide.on": True, "tide.period_s": 40.0})
    session.pause()
    session.scrub(12.0)
    hands.until(lambda: "marker-1" in session.level.objects, lambda: ctx.item_click("//Timeline/###time_marker"))
    hands.note(marked=[thing.time_s for thing in session.level.objects.values() if thing.kind == "marker"])
    hands.until(lambda: session.clock.time_s > 20.0, lambda: ctx.item_click("//Timeline/###time_wave"))
    hands.note(wave=session.clock.time_s)
    hands.until(lambda: session.clock.time_s < 13.0, lambda: ctx.item_click("//Timeline/###time_wave_back"))
    hands.until(lambda: session.clock.time_s > 12.5, lambda: hands.key(SHIFT, imgui.Key.period))
    hands.note(tenth=session.clock.time_s)
    bar = ctx.item_info("//Timeline/###scrub").rect_full
    steps = len(session.journal.done)

    def place(time_s: float) -> tuple[float, float]:
        return bar.min.x + (bar.max.x - bar.min.x) * time_s / 60.0, 0.5 * (bar.min.y + bar.max.y)

    def drag() -> None:
        ctx.mouse_move_to_pos(place(12.0))
        ctx.yield_(2)
        ctx.mouse_down(LEFT)
        ctx.yield_(2)
        for time_s in (16.0, 24.0):
            ctx.mouse_move_to_pos(place(time_s))
            ctx.yield_(2)
        ctx.mouse_up(LEFT)
        ctx.yield_(2)

    hands.until(lambda: session.level.objects["marker-1"].time_s > 20.0, drag)
    hands.note(dragged=session.level.objects["marker-1"].time_s, drag_steps=len(session.journal.done) - steps)
    session.scrub(3.0)
    hands.until(lambda: session.clock.time_s > 3.0, lambda: hands.key(SHIFT, imgui.Key.k))
    hands.note(jumped=session.clock.time_s, selected=session.selected)
    hands.key(imgui.Key.delete)
    hands.note(deleted="marker-1" not in session.level.objects)
    hands.key(CTRL, imgui.Key.z)
    hands.note(back="marker-1" in session.level.objects)
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])


def water_probes(hands: Hands) -> None:
    """Two probes dropped in the sea, their panel, and the form that writes crest times (T06)."""
    ctx, session = hands.ctx, hands.session
    session.pause()
    session.scrub(20.0)
    ctx.window_focus("//Probes")
    ctx.yield_(4)
    hands.until(lambda: session.tool == "probe", lambda: ctx.item_click("//Probes/###probes_tool.probe"))
    for number, spot in enumerate(((0.5, 0.55), (0.3, 0.5)), 1):
        hands.until(lambda n=number: f"probe-{n}" in session.level.objects, lambda at=spot: hands.drag(at))
    for _ in range(60):
        ctx.yield_(1)
        if hands.window.probes.record.complete and hands.window.probes.drawn == 2:
            break
    _, heights = hands.window.probes.record.lines(10.0, 30.0)
    names = sorted(name for name in session.level.objects if name.startswith("probe"))
    hands.note(probes=names, drawn=hands.window.probes.drawn, moves=float(np.nanmax(np.ptp(heights, axis=1))))
    hands.until(lambda: hands.window.dialogs.open, lambda: ctx.item_click("//Probes/###probes_events"))
    hands.note(asked=type(hands.window.dialogs.form).__name__)
    hands.key(imgui.Key.escape)
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])
    hands.settle()


def timing(hands: Hands) -> None:
    """Overlays by key and by box, what the pointer reads on the water, a hot spot gone to (T06); nothing broke."""
    ctx, session, fronts = hands.ctx, hands.session, hands.editor.fronts
    session.pause()
    session.scrub(14.0)
    session.set("timing.fast_mps", 1.0)  # then an even beach is too fast
    ctx.window_focus("//Timing")
    ctx.yield_(10)
    _patiently(hands, lambda: fronts.on["crests"], lambda: hands.key(imgui.Key.t))
    for name in ("isochrones", "speed", "breakers"):
        box = f"//Timing/**/###front_{name}"
        _patiently(hands, lambda name=name: fronts.on[name], lambda box=box: ctx.item_click(box))
    hands.note(on=sorted(name for name, on in fronts.on.items() if on), drawn=hands.editor.overlays.fronts is not None)
    places = [(x, y) for y in (0.55, 0.62, 0.7, 0.8) for x in (0.3, 0.5, 0.7)]
    for place in places:
        hands.move(place)
        for _ in range(20):
            ctx.yield_(1)
        if fronts.reading(session):
            break
    found = fronts.reading(session)
    hands.note(said=found.lines if found else [], at=[found.x, found.y] if found else [])
    hands.settle()
    before = session.camera
    hands.note(spots=[spot.kind for spot in fronts.hot_spots(session)], labels=len(fronts.isochrones(session)))
    _patiently(hands, lambda: session.camera != before, lambda: ctx.item_click("//Timing/**/###spot_1"))
    hands.note(moved=session.camera != before, steps=[step.label for step in session.journal.done])
    hands.note(bad=[line.text for line in hands.editor.messages.lines if line.bad])


def _patiently(hands: Hands, done, work) -> None:
    """`Hands.until` for what a second time would undo: once more only after a long wait."""
    for _ in range(5):
        work()
        for _ in range(60):
            if done():
                return
            hands.ctx.yield_(1)


if __name__ == "__main__":
    main(globals())
