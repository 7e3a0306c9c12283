"""The tool that takes crests in hand (T07): hover shows the crest under the pointer, press pauses and grabs it."""

from __future__ import annotations

import numpy as np

from ..level.shaping_lines import crest_near
from .editor import Editor
from .front_drag import FrontDrag
from .tools import FRONT

STILL_PX_M = 0.05  # a hand that came no farther moves nothing


class FrontTool:
    """`crest` (n, 2) is the one that a press would take, None where there is none."""

    def __init__(self, editor: Editor) -> None:
        self.editor = editor
        self.crest: np.ndarray | None = None
        self._key: tuple = ()
        self._seen: tuple = ()  # the level as it was a frame ago
        self._last = (0.0, 0.0)

    @property
    def drag_now(self) -> FrontDrag | None:
        """What is in the hand."""
        stroke = self.editor.session.stroke
        return stroke if isinstance(stroke, FrontDrag) else None

    def hover(self, point) -> None:
        """Find the crest near the pointer; while time runs it moves on by itself."""
        session = self.editor.session
        if session.tool != FRONT or self.drag_now or point is None:
            self.crest, self._key = None, ()
            return
        radius_m = session.front.radius_m
        self.editor.shapings.warm()
        seen, self._seen = self._seen, (id(session.level), session.level.revision)
        if seen != self._seen or self.editor.arrivals.behind:
            return  # a frame in which the level changed has enough to do, and those after it
        near = tuple(int(v // max(0.03 * radius_m, 0.2)) for v in point[:2])
        key = near, radius_m, round(session.clock.time_s, 2), session.level.revision
        if key != self._key:
            self._key = key
            found = self.editor.attempt(crest_near, session.level, session.clock.time_s, point[:2], radius_m)
            self.crest = None if found is None else found[1]

    def press(self, point, anew: bool) -> bool:
        """Take hold of a crest; False where there is none."""
        session = self.editor.session
        if point is None:
            return False
        if not session.clock.paused:
            session.pause()
        self._last = point[:2]
        return self.editor.attempt(session.front_begin, *point[:2], anew, self.editor.shapings) is not None

    def drag(self, point) -> bool:
        """Follow the pointer; False when Esc or an undo has ended it."""
        session, held = self.editor.session, self.drag_now
        if held is None or not held.open:
            session.stroke_abort()
            return False
        if point is not None and np.hypot(point[0] - self._last[0], point[1] - self._last[1]) > STILL_PX_M:
            self._last = point[:2]
            self.editor.attempt(session.stroke_move, *point[:2])
        return True

    def release(self) -> None:
        """Let go; the settled bed comes with a later frame (`Editor.tick`)."""
        self.editor.attempt(self.editor.session.front_release)
