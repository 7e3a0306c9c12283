"""Long work on a copy of the level in a process of its own, so that the window goes on drawing: much of what an export
asks for holds Python's lock for seconds (measured: a thread made the window stand still for 2.5 s).

run = Background(level, export_work, "raw", "out", "cove", None, False)
run.done, run.share, run.sentence          # looked at once a frame
run.result()                               # what came of it, or the error it ended with
"""

from __future__ import annotations

import contextlib
import copy
import signal
import sys
from collections.abc import Callable
from multiprocessing import connection, get_context
from pathlib import Path
from typing import Any

from ..level import Level

Told = Callable[[float, str], bool]


def copy_of(level: Level) -> Level:
    """The level as it is now, without the maps derived from it and without the editor's solver."""
    return copy.deepcopy(level, {id(level.derived): {}, id(level.solver): None})


def export_work(
    level: Level, told: Told, target: str, folder: Path, stem: str, only: list[str] | None, resample: bool
) -> list[Path] | None:
    """An export as background work; None when it was cancelled."""
    from ..io.export import Cancelled, export

    try:
        return export(level, target, folder, only, stem, resample=resample, progress=told)
    except Cancelled:
        return None


class Background:
    """`work(copy, told, *args)` of a module runs at once; `told(share, sentence)` is False once it is cancelled."""

    def __init__(self, level: Level, work: Callable[..., Any], *args: Any) -> None:
        self.share, self.sentence, self.cancelled = 0.0, "", False
        self._end: tuple[str, Any] | None = None
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=_run, args=(theirs, copy_of(level), work, args), daemon=True)
        self._process.start()
        theirs.close()

    def cancel(self) -> None:
        """Stop at the next word about progress."""
        if not self.cancelled:
            self.cancelled = True
            with contextlib.suppress(OSError):
                self._pipe.send("stop")

    @property
    def done(self) -> bool:
        """Takes in what was told since the last look."""
        while self._end is None and self._pipe.poll():
            self._hear()
        return self._end is not None

    def result(self) -> Any:
        """What the work returned, once it is done; raises what it raised."""
        while self._end is None:
            self._hear()
        self._process.join()
        kind, value = self._end
        if kind == "error":
            raise value
        return value

    def _hear(self) -> None:
        try:
            kind, value = self._pipe.recv()
        except (EOFError, OSError):
            kind, value = "error", OSError("the work beside the window stopped before its end")
        if kind == "told":
            self.share, self.sentence = value
        else:
            self._end = kind, value


def _run(pipe: connection.Connection, level: Level, work: Callable[..., Any], args: tuple) -> None:
    """The process: `Ctrl+C` in the terminal is the window's affair, and its end ends this, half-written files gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))

    def told(share: float, sentence: str) -> bool:
        pipe.send(("told", (share, sentence)))
        return not pipe.poll()

    try:
        end = "made", work(level, told, *args)
    except Exception as error:  # handed to whoever asks for the result
        end = "error", error
    with contextlib.suppress(OSError):  # the window is gone
        pipe.send(end)
