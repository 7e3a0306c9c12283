"""What an editor lends to a front in the hand so that the window never waits for it (T07): a process that shapes."""

from __future__ import annotations

import itertools
import time
from dataclasses import replace

import numpy as np

from ..level import BadInput, Level
from ..level.shaping import Shaped
from ..level.shaping_request import ShapeRequest, shape_request
from .arrival_worker import ArrivalWorker

LOOK_S = 0.002
numbers = itertools.count(1)  # of drags


class ShapingLender:
    """One drag at a time: `hold` it, `ask` for lines, `take` what came. Of previews the latest line wins."""

    def __init__(self) -> None:
        self._worker = ArrivalWorker()
        self._held: ShapeRequest | None = None
        self._known = False  # the process has the drag's ground
        self._asked = 0
        self._warm = False

    def warm(self) -> None:
        """Start the process, for a drag that is likely."""
        if not self._warm:
            self._warm = True
            self._worker.warm()

    def hold(self, level: Level, t: float, at, radius_m: float, wave: int, slope_deg: float) -> None:
        """A drag begins on a level as it is now; the process gets ready for it."""
        self.forget()
        self._held = shape_request(level, next(numbers), t, at, radius_m, wave, slope_deg)
        self._send(None, True)

    def ask(self, line: np.ndarray, quick: bool) -> int:
        """Ask for a line; returns the number under which it comes."""
        return self._send(np.array(line, np.float64), quick)

    def _send(self, line: np.ndarray | None, quick: bool) -> int:
        self._asked += 1
        known = {"height": None, "paint": ()} if self._known else {}
        self._worker.ask(self._asked, replace(self._held, line=line, quick=quick, **known))
        return self._asked

    @property
    def busy(self) -> bool:
        """Whether an answer is still to come."""
        return self._held is not None and self._worker.busy

    def take(self) -> tuple[int, Shaped | BadInput | None] | None:
        """(number, answer) that came since, at once; None where there is none."""
        found = self._worker.poll()
        if found is not None:
            self._known = not isinstance(found[1], BadInput)  # a process that starts anew knows nothing
        return found

    def wait(self) -> tuple[int, Shaped | BadInput | None]:
        """The next answer, when it has come."""
        while (found := self.take()) is None:
            if not self._worker.busy:
                return self._asked, BadInput("what was asked of shaping got lost")
            time.sleep(LOOK_S)
        return found

    def forget(self) -> None:
        """The drag is over: no answer to it is wanted."""
        self._worker.forget()
        self._held, self._known = None, False

    def close(self) -> None:
        """End the process."""
        self.forget()
        self._worker.close()
