"""Long work on a copy of the level in a thread, so that the window goes on drawing: its share, its end, its cancelling.

run = Background(level, lambda copy, told: io.export(copy, "raw", "out", progress=told))
run.share, run.sentence, run.done          # looked at once a frame
run.result()                               # what came of it, or the error it ended with
"""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from typing import Any

from ..level import Level


def copy_of(level: Level) -> Level:
    """The level as it is now, without the maps derived from it and without the editor's solver."""
    return copy.deepcopy(level, {id(level.derived): {}, id(level.solver): None})


class Background:
    """`work(copy, told)` runs at once; `told(share, sentence)` is False from the moment that it is cancelled."""

    def __init__(self, level: Level, work: Callable[[Level, Callable[[float, str], bool]], Any]) -> None:
        self.share, self.sentence = 0.0, ""
        self._wanted = True
        self._made: Any = None
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._run, args=(copy_of(level), work), name="background", daemon=True)
        self._thread.start()

    def _run(self, level: Level, work) -> None:
        try:
            self._made = work(level, self._told)
        except BaseException as error:  # handed to whoever asks for the result
            self._error = error

    def _told(self, share: float, sentence: str) -> bool:
        self.share, self.sentence = share, sentence
        return self._wanted

    def cancel(self) -> None:
        """Stop at the next word about progress."""
        self._wanted = False

    @property
    def cancelled(self) -> bool:
        return not self._wanted

    @property
    def done(self) -> bool:
        return not self._thread.is_alive()

    def result(self) -> Any:
        """What the work returned, once it is done; raises what it raised."""
        self._thread.join()
        if self._error is not None:
            raise self._error
        return self._made
