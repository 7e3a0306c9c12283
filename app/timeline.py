"""The timeline: run or pause, steps, scrub, markers, rate, loop; ticks stand where a wave leaves the outer edge (T05),
bands where a key changes the weather (D36), a thin line where the tide stands (D31).
"""

from __future__ import annotations

import math

from imgui_bundle import imgui

from ..level.params import row
from ..level.settings import Settings
from ..level.weather_keys import keys_of
from . import theme, timeline_marks
from .editor import Editor
from .param_widgets import slider, tooltip
from .time_edits import wave_s
from .timeline_drag import SLACK_PX, Grip, dragged, grip_at, hint
from .timeline_marks import Strip

PAGE_S = 60.0  # without a loop the bar shows the page of this length that time is on
BAR_PX = 24
RATE = row(Settings, "time.rate")


def span(time_s: float, loop: tuple[float, float] | None) -> tuple[float, float]:
    """What the bar shows: the loop while time is in it, else a page."""
    if loop and loop[1] > loop[0] and loop[0] <= time_s <= loop[1]:
        return loop
    start = math.floor(time_s / PAGE_S) * PAGE_S
    return start, start + PAGE_S


def clock_text(time_s: float) -> str:
    """Minutes, seconds and hundredths."""
    minutes, seconds = divmod(round(time_s * 100) / 100, 60)
    return f"{int(minutes)}:{seconds:05.2f}"


class Timeline:
    """Draws itself into the current imgui window."""

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self._ran = False  # time ran before the scrubbing began
        self._grip: Grip | None = None  # the mark in the mouse's hand
        self._pressed_px, self._moved = 0.0, False

    def draw(self) -> None:
        clock = self.editor.session.clock
        self._transport()
        imgui.same_line(0, 14)
        imgui.align_text_to_frame_padding()
        with theme.bold():
            imgui.text_colored(theme.colour(theme.WARM if clock.paused else theme.INK), clock_text(clock.time_s))
        tooltip("Time of the world. Everything that moves is a function of it.")
        rest = 222
        imgui.same_line(imgui.get_cursor_start_pos().x + 290)
        self._bar(max(imgui.get_content_region_avail().x - rest, 60))
        imgui.same_line(0, 12)
        self._rate()
        imgui.same_line(0, 10)
        self._loop()

    def _transport(self) -> None:
        session = self.editor.session
        rows = (
            ("backward_fast", "wave_back", "«", "One wave back (Ctrl+,); Shift+, goes a tenth of one"),
            ("backward_step", "step_back", "Back", "One step back ( , )"),
            ("play" if session.clock.paused else "pause", "pause", "Run", "Run or pause (Space)"),
            ("forward_step", "step", "Step", "One step on ( . )"),
            ("forward_fast", "wave", "»", "One wave on (Ctrl+.); Shift+. goes a tenth of one"),
            ("bookmark", "marker", "Mark", "Mark this moment (K); Shift+K and Ctrl+K go to the next marker and back"),
        )
        for number, (glyph, action, word, doc) in enumerate(rows):
            if number:
                imgui.same_line(0, 3)
            lit = action == "pause" and session.clock.paused
            if lit:
                imgui.push_style_color(imgui.Col_.button, theme.colour(theme.ACCENT_DEEP))
            wide = imgui.ImVec2(46 if action == "pause" else 28, 0)
            if imgui.button(f"{theme.icon(glyph) or word}###time_{action}", wide):
                self.editor.do(action)
            if lit:
                imgui.pop_style_color()
            tooltip(doc)

    def _bar(self, width: float) -> None:
        session = self.editor.session
        clock = session.clock
        first, last = span(clock.time_s, clock.loop)
        corner = imgui.get_cursor_screen_pos()
        strip = Strip(corner.x, corner.y + 2, corner.x + width, corner.y + BAR_PX, first, last)
        imgui.invisible_button("###scrub", imgui.ImVec2(width, BAR_PX))
        mouse = imgui.get_mouse_pos()
        under = timeline_marks.under(session.level, strip, *mouse)
        over = self._grip or (
            grip_at(session.level, strip, *mouse, session.selected) if imgui.is_item_hovered() else None
        )
        if imgui.is_item_activated():
            self._press(over, mouse.x)
        if imgui.is_item_active():
            self._drag(strip, mouse.x)
        if imgui.is_item_deactivated():
            self._release(strip, mouse.x)
        if over:
            imgui.set_mouse_cursor(imgui.MouseCursor_.resize_ew if over.edge else imgui.MouseCursor_.hand)
        self._paint(strip, imgui.is_item_hovered())
        told = "\n".join(timeline_marks.sentence(session.level.objects.get(thing.id, thing)) for thing in under)
        told = f"{told}\n{hint(over)}".strip() if over else told
        tooltip(told or "Drag to scrub. A tick for every wave that sets out, a bar for every shot, a band for weather.")

    def _press(self, over: Grip | None, x: float) -> None:
        session, clock = self.editor.session, self.editor.session.clock
        self._ran, self._grip, self._pressed_px, self._moved = not clock.paused, over, x, False
        clock.paused = True
        if over:
            session.selected = over.thing.id

    def _drag(self, strip: Strip, x: float) -> None:
        """A mark follows the mouse, all in one step; elsewhere time does."""
        session, grip = self.editor.session, self._grip
        if grip is None:
            session.scrub(strip.time_of(x))
            return
        self._moved = self._moved or abs(x - self._pressed_px) > SLACK_PX
        if self._moved and grip.thing.id in session.level.objects:
            values = dragged(grip, strip.time_of(x))
            self.editor.attempt(session.alter, grip.thing.id, values, True)
            if grip.thing.kind == "marker":
                session.scrub(values["time_s"])

    def _release(self, strip: Strip, x: float) -> None:
        session = self.editor.session
        if self._moved:
            session.seal()
        elif self._grip:
            marker = self._grip.thing.kind == "marker"
            session.scrub(self._grip.thing.time_s if marker else strip.time_of(x))
        session.clock.paused, self._grip, self._moved = not self._ran, None, False

    def _paint(self, strip: Strip, hovered: bool) -> None:
        clock = self.editor.session.clock
        draw_list = imgui.get_window_draw_list()
        low, high = imgui.ImVec2(strip.left, strip.top), imgui.ImVec2(strip.right, strip.bottom)
        draw_list.add_rect_filled(low, high, theme.packed(theme.FIELD_HOVER if hovered else theme.FIELD), 4)
        now = min(max(strip.x_of(clock.time_s), low.x), high.x)
        done = imgui.ImVec2(now, high.y)
        draw_list.add_rect_filled(low, done, theme.packed(theme.ACCENT_DEEP, 0.75), 4)
        for key in keys_of(self.editor.session.level):
            begin, end = (min(max(strip.x_of(t), low.x), high.x) for t in (key.time_s, key.time_s + key.fade_s))
            if end > begin:
                band = imgui.ImVec2(begin, high.y - 4), imgui.ImVec2(end, high.y)
                draw_list.add_rect_filled(*band, theme.packed(theme.WARM, 0.8), 2)
        for time_s in self._waves(strip.first_s, strip.last_s):
            x = strip.x_of(time_s)
            draw_list.add_line(
                imgui.ImVec2(x, high.y - 8), imgui.ImVec2(x, high.y - 1), theme.packed(theme.INK, 0.35), 1.5
            )
        timeline_marks.draw(self.editor.session.level, strip, self.editor.session.selected)
        draw_list.add_line(imgui.ImVec2(now, low.y - 2), imgui.ImVec2(now, high.y + 2), theme.packed(theme.INK), 2)
        for time_s, right in ((strip.first_s, False), (strip.last_s, True)):
            text = f"{time_s:g}"
            size = imgui.calc_text_size(text)
            x = high.x - size.x - 6 if right else low.x + 6
            draw_list.add_text(imgui.ImVec2(x, low.y + 2), theme.packed(theme.INK, 0.45), text)

    def _waves(self, first: float, last: float) -> list[float]:
        """Moments in the bar at which a wave sets out, at most a hundred."""
        interval = wave_s(self.editor.session)
        if (last - first) / interval > 100:
            return []
        count = math.ceil(first / interval)
        return [k * interval for k in range(count, math.floor(last / interval) + 1)]

    def _rate(self) -> None:
        session = self.editor.session
        imgui.set_next_item_width(96)
        rate = session.level.settings.time.rate
        changed, new = slider("###rate", rate, *RATE.soft, "speed %.2f×")
        if imgui.is_item_clicked(imgui.MouseButton_.right):
            changed, new = True, RATE.default
        if changed:
            self.editor.set(RATE.name, RATE.clamp(new), merge=True)
        if imgui.is_item_deactivated():
            session.seal()
        tooltip("Speed of time; right click for 1×, Ctrl+click types a value, negative runs backwards.")

    def _loop(self) -> None:
        clock = self.editor.session.clock
        on = clock.loop is not None
        if on:
            imgui.push_style_color(imgui.Col_.button, theme.colour(theme.ACCENT_DEEP))
        clicked = imgui.button(theme.titled("repeat", "Loop", "loop"))
        if on:
            imgui.pop_style_color()
        tooltip("Loop over one wave's whole way from here on, or over time.loop_s, which comes round without a seam.\n"
                "Settings, section Time, hold start and end.")  # fmt: skip
        if clicked:
            self._toggle_loop(on)

    def _toggle_loop(self, on: bool) -> None:
        session = self.editor.session
        settings = session.level.settings
        start = 0.0 if on else round(session.clock.time_s, 2)
        long_s = settings.time.loop_s or wave_s(session) * settings.shore.count
        end = 0.0 if on else start + long_s
        values = {"time.loop_start_s": start, "time.loop_end_s": end}
        self.editor.attempt(session.set_all, "Stop looping" if on else "Loop", values)
