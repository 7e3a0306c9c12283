"""What an editor lends to its level so that no window waits for an arrival map (T06, T14): a process, and the last map.

level.solver = ArrivalLender()
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from scipy import ndimage

from ..level import BadInput
from ..level.arrival import Asked
from ..level.arrival_map import BREAKS, HEIGHTS, TIMES, ArrivalMap


class ArrivalLender:
    """Answers with the map of just these waters, else with the last good one until that has come.

    Under the brush times alone are asked for; heights and how waves break go on as they were.
    """

    def __init__(self) -> None:
        from .arrival_worker import ArrivalWorker

        self._worker = ArrivalWorker()
        self._asked: tuple = ()  # key of what was asked for last
        self._held: tuple = ()  # key of what `made` answers
        self._tall: ArrivalMap | None = None  # the last map that had heights
        self.made: ArrivalMap | None = None
        self.failure = ""  # why there is no newer one

    def answer(self, asked: Asked) -> ArrivalMap | None:
        """The newest map that `look` took in; `settled` False where it is of other waters or has but times."""
        if asked.key not in (self._asked, self._held):
            self._asked = asked.key
            self._worker.ask(asked.key, asked)
        if self.made is not None:
            settled = self._held == asked.key and asked.request.swells[0].height_m > 0
            if settled != self.made.settled:
                self.made = replace(self.made, settled=settled)
        return self.made

    @property
    def busy(self) -> bool:
        """Whether a newer map is on its way."""
        return self._worker.busy

    def look(self) -> bool:
        """Take in what has come, once a frame; True when that is something new."""
        found = self._worker.poll()
        if found is None:
            return False
        key, made = found
        if isinstance(made, BadInput):
            self.failure, self._asked = str(made), key
            return True
        self.failure = ""
        if made.block(HEIGHTS).any():
            self._tall = made
        elif self._tall is not None:
            others = [_resized(self._tall.block(which), made.shape) for which in (HEIGHTS, BREAKS)]
            made = replace(made, packed=np.concatenate([made.block(TIMES), *others]).astype(np.float32))
        self._held, self.made = key, made
        return True

    def forget(self) -> None:
        """Another level: nothing known so far counts."""
        self._worker.forget()
        self._asked, self._held, self._tall, self.made, self.failure = (), (), None, None, ""

    def close(self) -> None:
        """End the process."""
        self.forget()
        self._worker.close()


def _resized(values: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """A map `(rows, cols, channels)` at as many samples as another has, over the same ground."""
    if values.shape[:2] == shape:
        return values
    row, col = (np.linspace(0, had - 1, has) for had, has in zip(values.shape[:2], shape, strict=True))
    at = np.meshgrid(row, col, indexing="ij")
    channels = [ndimage.map_coordinates(values[..., i], at, order=1) for i in range(values.shape[2])]
    return np.stack(channels, axis=-1)
