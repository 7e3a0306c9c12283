"""How long the window's main thread is held up while a coast is sculpted: processor time of frames (T01 T06 T14).

    xvfb-run -a -s "-screen 0 1280x800x24" python tests/window_stalls.py sculpt sample_levels/cove.shore OUT.json

Work on a copy of a level. `by_travel` and `by_depth` do all of it, in either source of the timing. A stall is what a
frame took of the main thread but for drawing: OpenGL in software, and the widgets' own, are left out. Prints a row an
action: its longest stall, how many frames were over the limit, and what the longest was made of. A busy computer takes
longer for the same: `quiet` is the longest stall times how much quicker the quickest frame did a fixed piece of work.
"""

import gc
import sys
import time
from collections import Counter, defaultdict
from functools import wraps

import moderngl
import numpy as np
import window_drive
import window_fronts
from imgui_bundle import imgui
from shorewright.app import picture as picture_module
from shorewright.app.arrival_lender import ArrivalLender
from shorewright.app.camera_control import to_screen
from shorewright.app.editor import Editor
from shorewright.app.front_drag import FrontDrag
from shorewright.app.picture import Picture
from shorewright.app.shaping_lender import ShapingLender
from shorewright.app.viewport import Viewport
from shorewright.app.viewport_pointer import Pointer
from shorewright.app.window import Window
from shorewright.brushes import Stroke
from shorewright.level import Journal, arrival, beach_map, flow, shaping_lines, shore, shore_field
from shorewright.renderer import uniforms
from shorewright.renderer.bounds import HeightBounds
from shorewright.renderer.renderer import Renderer
from shorewright.renderer.upload import Uploader
from window_drive import CTRL, SHIFT, Hands

DRAWN = ("_run", "finish", "widgets", "yardstick")  # parts that are the drawing itself
LIMIT_MS = 30.0
FIXED = np.ones(1 << 18, np.float32)
FUNCTIONS = {
    arrival: ("asked_of",),
    beach_map: ("beach_map",),
    flow: ("current",),
    shaping_lines: ("crest_near", "phase_at"),
    shore: ("shore_map",),
    shore_field: ("shore_field", "joined_water"),
    uniforms: ("frame_uniforms",),
}
METHODS = {
    ArrivalLender: ("look", "answer", "beside"),
    Editor: ("tick", "probe"),
    FrontDrag: ("_write", "move", "end"),
    HeightBounds: ("update",),
    Journal: ("commit", "undo", "redo", "abort"),
    Picture: ("_draw",),
    Pointer: ("update", "_pick"),
    Renderer: ("prepare", "_run"),
    ShapingLender: ("hold", "ask", "take"),
    Stroke: ("begin", "move", "end"),
    Uploader: ("_send", "sync"),
    Viewport: ("draw",),
    moderngl.Context: ("finish",),
}


class Frames:
    """Milliseconds of the main thread by frame and part; a part's time is its own, without that of parts inside."""

    def __init__(self) -> None:
        self.action = ""
        self.rows: dict[str, list[Counter]] = defaultdict(list)
        self._parts: Counter = Counter()
        self._inside: list[str] = []
        self._at = 0.0

    def mark(self) -> None:
        """Book the time since the last mark."""
        now = time.thread_time()
        self._parts[self._inside[-1] if self._inside else "rest"] += 1000 * (now - self._at)
        self._at = now

    def enter(self, part: str) -> None:
        self.mark()
        self._inside.append(part)

    def leave(self) -> None:
        self.mark()
        self._inside.pop()

    def next(self) -> None:
        """A frame begins."""
        self.mark()
        self.rows[self.action].append(self._parts)
        self._parts = Counter()
        self.enter("yardstick")
        for _ in range(4):
            np.sqrt(FIXED, out=FIXED)
        sorted(map(str, range(1000)))
        self.leave()

    def watched(self, part: str, work):
        @wraps(work)
        def timed(*args, **named):
            self.enter(part)
            try:
                return work(*args, **named)
            finally:
                self.leave()

        return timed

    def watch(self) -> None:
        """Put a clock round every part, wherever its name was imported to."""
        for kind, names in METHODS.items():
            for name in names:
                setattr(kind, name, self.watched(name, getattr(kind, name)))
        modules = [m for name, m in sys.modules.items() if name.startswith("shorewright")]
        for home, names in FUNCTIONS.items():
            for name in names:
                work = getattr(home, name)
                timed = self.watched(name, work)
                for module in modules:
                    if vars(module).get(name) is work:
                        setattr(module, name, timed)
        gc.callbacks.append(lambda phase, _: self.enter("garbage") if phase == "start" else self.leave())
        before, made = Window._before_frame, Window._callbacks

        def begin(window) -> None:
            self.next()
            before(window)

        def callbacks(window, kept) -> None:
            made(window, kept)
            kept.before_imgui_render = lambda: self.enter("widgets")
            kept.after_swap = self.leave

        Window._before_frame, Window._callbacks = begin, callbacks

    def told(self) -> dict[str, dict]:
        """By action: frames, the longest stall and its three largest parts."""
        found = {}
        quickest = min(row["yardstick"] for rows in self.rows.values() for row in rows if row["yardstick"] > 0)
        for action, rows in self.rows.items():
            stalls = [sum(ms for part, ms in row.items() if part not in DRAWN) for row in rows]
            worst = rows[int(np.argmax(stalls))]
            parts = [(part, ms) for part, ms in worst.most_common() if part not in DRAWN]
            found[action] = {"frames": len(rows), "ms": max(stalls), "over": sum(ms > LIMIT_MS for ms in stalls)}
            slower = float(np.median([row["yardstick"] for row in rows])) / quickest
            found[action]["quiet"] = max(stalls) / max(slower, 1.0)
            found[action]["parts"] = {part: round(ms, 1) for part, ms in parts[:4]}
        return found


FRAMES = Frames()


def _quiet(hands: Hands, frames: int = 6) -> None:
    """Until nothing is on its way any more."""
    editor = hands.editor
    hands.until(lambda: not (editor.arrivals.busy or editor.shapings.busy), lambda: hands.ctx.yield_(frames), tries=200)


def _do(hands: Hands, action: str, work) -> None:
    FRAMES.action = action
    work()
    FRAMES.action = f"{action}, then"
    _quiet(hands)
    FRAMES.action = "between"


def _ready(hands: Hands) -> None:
    picture_module.SETTLE_S = 1e9  # still pictures are drawing alone, and slow in software
    hands.editor.choose_quality("low")
    hands.session.pause()
    hands.session.scrub(14.0)
    hands.ctx.yield_(20)
    _quiet(hands)


def _drag(hands: Hands, name: str, first, *places) -> None:
    _do(hands, f"{name} press", lambda: hands.press(first))
    _do(hands, f"{name} drag", lambda: [hands.move(place) for place in places])
    _do(hands, f"{name} release", hands.release)


def sculpt(hands: Hands) -> None:
    """Strokes across the shoreline, undo, redo, scrub, an object in the hand."""
    session, ctx = hands.session, hands.ctx
    _ready(hands)
    for brush in ("raise", "ramp"):
        ctx.item_click(f"//Brushes/###{brush}")
        hands.ctx.yield_(4)
        _quiet(hands)
        ways = [(0.4 + 0.02 * n, 0.55 + 0.03 * n) for n in range(12)]
        _drag(hands, brush, *ways)
        _do(hands, "undo", lambda: hands.key(CTRL, imgui.Key.z))
        _do(hands, "redo", lambda: hands.key(CTRL, SHIFT, imgui.Key.z))
    _do(hands, "scrub", lambda: [(session.scrub(t), ctx.yield_(2)) for t in np.linspace(10, 20, 8)])
    _object(hands)


def _object(hands: Hands) -> None:
    """A lamp dropped and dragged."""
    session = hands.session
    hands.ctx.menu_click("//##MainMenuBar/Place/Drop: lamp")
    hands.until(lambda: session.selected, lambda: hands.drag((0.5, 0.55)))
    hands.key(imgui.Key.v)
    _quiet(hands)
    size, lamp = hands.window.viewport.size, session.level.objects[session.selected]
    pixels, _ = to_screen(session.camera, size, np.array([[lamp.x, lamp.y, lamp.z]]))
    x, y = pixels[0, 0] / size[0], pixels[0, 1] / size[1]
    _drag(hands, "object", (x, y), *((x + 0.02 * n, y) for n in range(1, 8)))


def by_depth(hands: Hands) -> None:
    """The same by the clock of the depth."""
    hands.session.set("timing.source", "depth")
    sculpt(hands)
    fronts(hands)


def by_travel(hands: Hands) -> None:
    """All of it by travel time."""
    hands.session.set("timing.source", "travel_time")
    sculpt(hands)
    fronts(hands)


def fronts(hands: Hands) -> None:
    """A crest moved seaward by hand."""
    session = hands.session
    _ready(hands)
    session.set_front("radius_m", 40.0)
    hands.key(imgui.Key.c)
    x, y = _crest(hands)
    session.camera = session.camera.model_copy(
        update={"x": x, "y": y - 60.0, "z": 55.0, "yaw_deg": 0.0, "pitch_deg": -45.0}
    )
    _quiet(hands)
    part = window_fronts._part
    _do(hands, "front hover", lambda: [hands.move(part(hands, x + d, y)) for d in (-4, -2, 0)])
    _do(hands, "front press", lambda: hands.press(part(hands, x, y)))
    held = session.stroke
    _do(hands, "front drag", lambda: [hands.move(part(hands, x, y - way)) for way in (1, 2, 3, 4, 5, 6)])
    hands.note(shaped=held is not None and held.shaped is not None)
    FRAMES.action = "front release"
    hands.release()
    window_fronts._until(hands, lambda: session.stroke is None)
    FRAMES.action = "front release, then"
    _quiet(hands)
    _do(hands, "front undo", lambda: hands.key(CTRL, imgui.Key.z))


def _crest(hands: Hands) -> tuple[float, float]:
    """A place on a crest in front of the camera's beach."""
    level = hands.session.level
    east, north = level.grid.extent_m
    for x in np.linspace(0.35, 0.65, 7) * east:
        for y in np.linspace(0.3, 0.7, 9) * north:
            found = shaping_lines.crest_near(level, 14.0, (x, y), 20.0)
            if found is not None and len(found[1]) > 20:
                return shaping_lines.middle(found[1])
    raise RuntimeError("no crest was found")


def table() -> None:
    for action, row in FRAMES.told().items():
        parts = ", ".join(f"{part} {ms:g}" for part, ms in row["parts"].items())
        longest = f"longest {row['ms']:6.1f} ms, quiet {row['quiet']:6.1f}, over {row['over']:3}"
        print(f"{action:24} {row['frames']:4} frames  {longest}  {parts}")


if __name__ == "__main__":
    FRAMES.watch()
    window_drive.main(globals())
    table()
