"""A crest in the hand: the bed follows in an open step while it is dragged, one step on release (T07).

It stands where a stroke does (`session.stroke`), so that Esc, undo and everything that waits for a release know it.
With a process beside (`shaping_lender`) the hand never waits: `take` brings in what came, once a frame, and from
`settle` on the last preview stands until the settled bed has come.
"""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np

from ..level import BadInput, Journal, Level, Rect
from ..level.grid import NOWHERE
from ..level.shaping import Shaped, Shaping, shape_front
from ..level.shaping_lines import crest_near, dragged
from . import words
from .shaping_lender import ShapingLender

LABEL = "Shape front"
MOST_POINTS = 200  # of a line in a script


class FrontDrag:
    """From press to release. `anew` draws a new line for the part near the hand; else that part is moved."""

    invert = smooth = False
    brush = SimpleNamespace(name="front", layer="height")

    def __init__(
        self, level: Level, journal: Journal, t: float, at, radius_m: float, slope_deg: float, anew: bool = False,
        beside: ShapingLender | None = None,
    ) -> None:  # fmt: skip
        self.level, self.journal, self.t, self.anew = level, journal, t, anew
        self.radius_m, self.slope_deg = radius_m, slope_deg
        found = crest_near(level, t, at, radius_m)
        if found is None:
            raise BadInput(f"no crest is within {radius_m:g} m of there at {t:.2f} s")
        self.wave, self.crest = found
        self.grabbed = tuple(float(v) for v in self.crest[np.hypot(*(self.crest - at).T).argmin()])
        self.off = (0.0, 0.0) if anew else (at[0] - self.grabbed[0], at[1] - self.grabbed[1])
        self.beside = beside
        if beside:
            beside.hold(level, t, self.grabbed, radius_m, self.wave, slope_deg)
        else:
            self.shaping = Shaping(level, t, self.grabbed, radius_m, self.wave, slope_deg, quick=True)
        self.line = self.crest
        self.shaped: Shaped | None = None
        self.refused = ""
        self.settling = False  # released; the bed at rest is on its way
        self._lines: dict[int, np.ndarray] = {}  # asked for beside, by number
        self._rest: Shaped | BadInput | None = None  # what came of that
        self.samples: list = []
        self._drawn: list[tuple[float, float]] = []
        self._window = self._disc()
        self._base = level.height[self._window.slices].copy()
        self._last = NOWHERE
        self.step = journal.begin(LABEL)

    def _disc(self) -> Rect:
        cell_m, reach = self.level.grid.cell_m, self.radius_m
        low, high = ([int((c + side * reach) // cell_m) + (side > 0) for c in self.grabbed] for side in (-1, 1))
        return Rect(low[1] - 3, low[0] - 3, high[1] + 4, high[0] + 4).intersect(self.level.grid.rect)

    @property
    def open(self) -> bool:
        return self.step is not None and self.journal.open is self.step

    def preview(self) -> None:
        """Nothing that a brush tells; front_overlay.py shows the line."""
        return

    def move(self, x: float, y: float, pressure: float = 1.0) -> Rect:
        """The hand has come to a world point; returns the cells that changed."""
        if not self.open or self.settling or not np.isfinite([x, y]).all():
            return NOWHERE
        if self.anew:
            if self._drawn and np.hypot(x - self._drawn[-1][0], y - self._drawn[-1][1]) < self.level.grid.cell_m:
                return NOWHERE
            self._drawn.append((x, y))
            if len(self._drawn) < 3:
                return NOWHERE
            return self._follow(np.array(self._drawn))
        by = x - self.off[0] - self.grabbed[0], y - self.off[1] - self.grabbed[1]
        return self._follow(dragged(self.crest, self.grabbed, by, self.radius_m))

    def _follow(self, line: np.ndarray) -> Rect:
        if self.beside:
            self._lines[self.beside.ask(line, quick=True)] = line
            return NOWHERE
        try:
            return self._show(line, self.shaping.shape(line))
        except BadInput as error:
            self.refused = str(error)
            return NOWHERE

    def _show(self, line: np.ndarray, shaped: Shaped) -> Rect:
        self.refused, self.line, self.shaped = "", line, shaped
        return self._write(shaped)

    # Beside the window

    def take(self) -> bool:
        """Bring in what has come from beside; True when the settled bed is there, for `end` to put down."""
        while self.beside and self.open and self._rest is None and (found := self.beside.take()):
            self._took(*found)
        return self._rest is not None

    def _took(self, number: int, answer: Shaped | BadInput | None) -> None:
        line = self._lines.pop(number, None)
        if self.settling and number == self._last_asked:
            if isinstance(answer, BadInput) and self.shaped is not None and self.line is not line:
                self._ask_rest(self.line)  # the hand's last line can't be: the one before it stays
            else:
                self._rest, self.line = answer, line
        elif isinstance(answer, BadInput):
            self.refused = str(answer)
        elif answer is not None and not self.settling:
            self._show(line, answer)
        for gone in [asked for asked in self._lines if asked < number]:
            del self._lines[gone]

    def settle(self) -> bool:
        """Release without waiting; False where nothing was moved."""
        if not self.settling and self.open:
            wanted = self._lines[max(self._lines)] if self._lines else self.line if self.shaped else None
            if wanted is None:
                return False
            self.settling = True
            self._ask_rest(wanted)
        return self.settling

    def _ask_rest(self, line: np.ndarray) -> None:
        said = np.array(_said(line))
        self._last_asked = self.beside.ask(said, quick=False)
        self._lines[self._last_asked] = line

    def wait(self) -> None:
        """Release, and wait for what is asked beside: before anything else is done with the level."""
        if self.beside and self.settle():
            while self.open and self._rest is None:
                self._took(*self.beside.wait())

    def _write(self, shaped: Shaped) -> Rect:
        """The ground as it was, and the change on it."""
        data = self.level.layers["height"]
        if not self._last.empty:
            data.array[self._last.slices] = self._base[self._last.shifted(self._window).slices]
        rect = shaped.rect.intersect(self._window)
        if not rect.empty:
            self.step.save(data, rect)
            change = shaped.change[rect.shifted(shaped.rect).slices]
            data.array[rect.slices] = self._base[rect.shifted(self._window).slices] + change
        changed, self._last = rect.union(self._last), rect
        self.level.mark("height", changed)
        return changed

    @property
    def word(self) -> words.ShapeFront:
        """What a script says for it."""
        return words.ShapeFront(
            t=self.t, line=_said(self.line), radius_m=self.radius_m, at=self.grabbed, wave=self.wave,
            slope_deg=self.slope_deg,
        )  # fmt: skip

    def end(self) -> Rect:
        """Release: worked out at rest from the word alone, as a script would; one step, none where nothing moved."""
        moved, rest = self.shaped is not None, self._rest
        if self.open and self.settling and rest is None:
            self.wait()
            rest = self._rest
        self.abort()
        if isinstance(rest, BadInput):
            raise rest
        if rest is not None:
            self.shaped = put_down(self.level, self.journal, rest)
        elif moved and not self.beside:
            self.shaped = settled(self.level, self.journal, self.word)
        else:
            return NOWHERE
        return self.shaped.rect

    def abort(self) -> None:
        """Leave no trace."""
        if self.beside and self.open:
            self.beside.forget()
        if self.open:
            self.journal.abort()


def settled(level: Level, journal: Journal, word: words.ShapeFront) -> Shaped:
    """Shape a front as a step of its own."""
    shaped = shape_front(
        level, word.t, np.array([point[:2] for point in word.line]), word.radius_m, at=word.at, wave=word.wave,
        slope_deg=word.slope_deg,
    )  # fmt: skip
    return put_down(level, journal, shaped)


def put_down(level: Level, journal: Journal, shaped: Shaped) -> Shaped:
    """Write a change as a step."""
    with journal.step(LABEL) as step:
        data = level.layers["height"]
        step.save(data, shaped.rect)
        data.array[shaped.rect.slices] += shaped.change
        level.mark("height", shaped.rect)
    return shaped


def _said(line: np.ndarray) -> list[tuple[float, float]]:
    """A line as a script says it."""
    return [(float(x), float(y)) for x, y in line[:: max(1, -(-len(line) // MOST_POINTS))]]
