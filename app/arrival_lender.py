"""What an editor lends to its level so that no window waits for an arrival map (T06, T14): a process, and the last map.

level.solver = ArrivalLender()
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from ..level import BadInput
from ..level.arrival import Asked
from ..level.arrival_map import HEIGHTS, ArrivalMap
from ..level.request import Parts, Request

ARRIVALS = "arrivals"  # the name of arrival maps among what is asked for
BUSY_S = 0.01  # of processor time, from which on works in parts wait for the next frame
PATIENCE = 2  # frames that one waits in a row
GIVEN_UP = 60  # and after which nobody seems to ask for it any more


class ArrivalLender:
    """Answers with the map of just these waters, else with the last good one until that has come.

    Under the brush times alone are asked for; heights and how waves break go on as they were. What a release asks for
    (`beside`: the shore map, the current) goes through the same process; of one name the latest request wins. What is
    too short for that and too long for a frame is done in parts, some a frame (`in_parts`: the shore field).
    """

    def __init__(self) -> None:
        from .arrival_worker import ArrivalWorker

        self._worker = ArrivalWorker()
        self._due: dict[str, tuple] = {}  # by name: (key, request) not yet handed over
        self._asked: dict[str, tuple] = {}  # by name: key of what was asked for last
        self._came: dict[str, tuple] = {}  # by name: (key, answer)
        self._held: tuple = ()  # key of what `made` answers
        self._tall: ArrivalMap | None = None  # the last map that had heights
        self._others: np.ndarray | None = None  # its heights and breaks, at as many samples as were last wanted
        self._began_s = time.thread_time()  # the frame
        self._impatient = False  # whether one that had waited long enough had its turn in this frame
        self._behind: dict[str, int] = {}  # works in parts that are not done: for how many frames each has waited
        self.made: ArrivalMap | None = None
        self.failure = ""  # why there is no newer one

    def answer(self, asked: Asked) -> ArrivalMap | None:
        """The newest map that `look` took in; `settled` False where it is of other waters or has but times."""
        if asked.key not in (self._asked.get(ARRIVALS), self._held):
            self._ask(ARRIVALS, asked.key, asked)
        return self._told(self._held == asked.key and asked.request.swells[0].height_m > 0)

    def latest(self) -> ArrivalMap | None:
        """The newest map, `settled` False."""
        return self._told(False)

    def _told(self, settled: bool) -> ArrivalMap | None:
        if self.made is not None and settled != self.made.settled:
            self.made = replace(self.made, settled=settled)
        return self.made

    def beside(self, name: str, key: tuple, request: Callable[[], Request]) -> Any:
        """The answer of that name and key once it has come, else None."""
        if self._asked.get(name) != key:
            if self._waits(name):
                return None
            del self._behind[name]
            self._ask(name, key, request())
        came = self._came.get(name)
        return came[1] if came is not None and came[0] == key else None

    def in_parts(self, name: str, parts: Parts) -> bool:
        """Go on with a work as far as this frame has time for it; True when it is done."""
        while not self._waits(name):
            self._behind[name] = 0
            if next(parts, self) is self:
                del self._behind[name]
                return True
        return False

    @property
    def behind(self) -> bool:
        """Whether works are left for coming frames."""
        return bool(self._behind)

    def _waits(self, name: str) -> bool:
        """Whether this frame has done so much that a work had better be left for the next."""
        waited = self._behind.setdefault(name, 0)
        if time.thread_time() - self._began_s < BUSY_S:
            return False
        if waited < PATIENCE or self._impatient:
            return True
        self._impatient = True
        return False

    def _ask(self, name: str, key: tuple, request: Request) -> None:
        self._asked[name] = key
        waits = self._worker.busy or self._due
        self._due[name] = key, request.kept() if waits else request
        self._next()

    def _next(self) -> None:
        if self._due and not self._worker.busy:
            name = next(iter(self._due))
            key, request = self._due.pop(name)
            self._worker.ask((name, key), request)

    @property
    def busy(self) -> bool:
        """Whether something newer is on its way."""
        return self._worker.busy or bool(self._due or self._behind)

    def look(self) -> bool:
        """Take in what has come, once a frame; True when that is something new, or something goes on in parts."""
        self._began_s, self._impatient = time.thread_time(), False
        self._behind = {name: waited + 1 for name, waited in self._behind.items() if waited < GIVEN_UP}
        found = self._worker.poll()
        self._next()
        if found is None:
            return bool(self._behind)
        (name, key), made = found
        if isinstance(made, BadInput):
            self.failure, self._asked[name] = str(made), key
            return True
        self.failure = ""
        if name == ARRIVALS:
            self._take(key, made)
        else:
            self._came[name] = key, made
        return True

    def _take(self, key: tuple, made: ArrivalMap) -> None:
        if made.block(HEIGHTS).any():
            self._tall, self._others = made, None
        elif self._tall is not None:
            if self._others is None or self._others.shape[0] != 2 * made.shape[0]:
                self._others = self._tall.rest_at(made.shape)
            made = made.with_rest(self._others)
        self._held, self.made = key, made

    def forget(self) -> None:
        """Another level: nothing known so far counts."""
        self._worker.forget()
        for known in (self._due, self._asked, self._came, self._behind):
            known.clear()
        self._held, self._tall, self._others, self.made, self.failure = (), None, None, None, ""

    def close(self) -> None:
        """End the process."""
        self.forget()
        self._worker.close()
