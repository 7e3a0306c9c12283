"""Work beside the window: one request runs, one waits, older ones are dropped.

A worker never reads a live level: the caller hands it a revision and copies of what it needs, and `take` answers only
with the newest result. NumPy, scipy and OpenImageIO release Python's lock, so a thread will do; what holds it
(scikit-fmm, large JSON) goes into a process (`spawn`), with a thread here that waits for it.
"""

from __future__ import annotations

import multiprocessing
import threading
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Result:
    """What came of a request: its revision and a value, or the exception that ended it."""

    revision: int
    value: Any = None
    error: BaseException | None = None


class Worker:
    """Runs `work(*args)` for the latest request; `process` runs it in another process (`work` importable there)."""

    def __init__(self, work: Callable[..., Any], name: str = "worker", process: bool = False) -> None:
        self._work = _Remote(work) if process else work
        self._name = name
        self._ready = threading.Condition()
        self._waiting: tuple[int, tuple] | None = None
        self._running = False
        self._result: Result | None = None
        self._closed = False
        self._thread: threading.Thread | None = None

    def ask(self, revision: int, *args: Any) -> None:
        """Ask for a result as of a revision; a request still waiting is dropped."""
        with self._ready:
            if self._closed:
                return
            self._waiting = (revision, args)
            if self._thread is None:
                self._thread = threading.Thread(target=self._loop, name=self._name, daemon=True)
                self._thread.start()
            self._ready.notify_all()

    def take(self) -> Result | None:
        """The newest result not yet taken, None when there is none; never waits."""
        with self._ready:
            result, self._result = self._result, None
            return result

    @property
    def busy(self) -> bool:
        with self._ready:
            return self._running or self._waiting is not None

    def settle(self, timeout_s: float | None = None) -> bool:
        """Wait until nothing runs or waits; False when that took too long."""
        with self._ready:
            return self._ready.wait_for(lambda: not (self._running or self._waiting), timeout_s)

    def close(self) -> None:
        """Drop what waits and let what runs end unheard."""
        with self._ready:
            self._closed, self._waiting = True, None
            self._ready.notify_all()
        if isinstance(self._work, _Remote):
            self._work.close()
        if self._thread:
            self._thread.join(timeout=5)

    def _loop(self) -> None:
        while True:
            with self._ready:
                self._ready.wait_for(lambda: self._closed or self._waiting)
                if self._closed:
                    return
                (revision, args), self._waiting, self._running = self._waiting, None, True
            try:
                result = Result(revision, self._work(*args))
            except BaseException as error:
                result = Result(revision, error=error)
            with self._ready:
                self._running, self._result = False, result
                self._ready.notify_all()


class _Remote:
    """A function called in one long-lived process of its own."""

    def __init__(self, work: Callable[..., Any]) -> None:
        self._work = work
        self._process = None
        self._pipe = None

    def __call__(self, *args: Any) -> Any:
        if self._process is None or not self._process.is_alive():
            context = multiprocessing.get_context("spawn")
            self._pipe, far = context.Pipe()
            self._process = context.Process(target=_serve, args=(self._work, far), daemon=True)
            self._process.start()
            far.close()
        self._pipe.send(args)
        try:
            done, value = self._pipe.recv()
        except EOFError:
            raise RuntimeError(f"the process for {self._work.__name__} ended unasked") from None
        if not done:
            raise value
        return value

    def close(self) -> None:
        if self._process is not None:
            self._process.terminate()
            self._process.join(timeout=5)
            self._pipe.close()


def _serve(work: Callable[..., Any], pipe) -> None:
    while True:
        try:
            args = pipe.recv()
        except EOFError:
            return
        try:
            pipe.send((True, work(*args)))
        except BaseException as error:
            pipe.send((False, error))
