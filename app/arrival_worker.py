"""A process that solves travel times and wave heights while the window goes on drawing.

Fast marching holds Python's lock for all of its run (measured: a window's thread stood still for 0.62 of 0.64 s), so it
can't be a thread. Maps go by shared memory, the rest by a pipe. The latest request wins: one waits, those it replaces
are dropped.
"""

from __future__ import annotations

import contextlib
import signal
import weakref
from multiprocessing import connection, get_context

from ..level.errors import BadInput
from ..level.swell_request import SwellRequest, SwellResult, solve_request
from .shared_maps import Block, Maps, bytes_of, placed, restored

Answer = tuple[SwellResult, ...] | BadInput
BYTES_PER_CELL = 13 + 30  # of travel time's maps and of the heights', see `TravelTime` and `WaveHeights`
STOPPED = (
    "The process that works out when waves arrive stopped (exit code {code}); it starts anew with the next change."
)


def solve_now(request: SwellRequest) -> tuple[SwellResult, ...]:
    """The answer at once, in this process: for the command line. The same bits as by the worker."""
    return solve_request(request.kept())


class ArrivalWorker:
    """One process, started with the first request and kept; used from one thread."""

    def __init__(self):
        self._process, self._pipe = None, None
        self._into, self._out = Block(), Block()
        self._running: list | None = None  # [key, wanted]
        self._waiting: tuple | None = None  # (key, request)
        self._broken: list = []  # answers without the process: (key, error)
        self._end = None

    @property
    def busy(self) -> bool:
        """Whether an answer is still to come."""
        return bool(self._running or self._waiting or self._broken)

    def ask(self, key, request: SwellRequest) -> None:
        """Asks; what waited is dropped. `key` (a revision, say) comes back with the answer."""
        self._waiting = key, request.kept()
        self._next()

    def forget(self) -> None:
        """Nothing that was asked for so far is wanted any more: no answer to it comes out of `poll`."""
        self._waiting, self._broken = None, []
        if self._running:
            self._running[1] = False

    def poll(self) -> tuple[object, Answer] | None:
        """The next answer with its key, at once; None where there is none. What can't be solved is a `BadInput`."""
        answer = None
        if self._broken:
            return self._broken.pop(0)
        if self._running and self._pipe.poll():
            (key, wanted), self._running = self._running, None
            try:
                found = self._pipe.recv()
            except (EOFError, OSError):
                found = self._stopped()
            if wanted:
                answer = key, found if isinstance(found, BadInput) else self._out.read(found)
        self._next()
        return answer

    def close(self) -> None:
        """Ends the process and gives all shared memory back; may be called again."""
        self.forget()
        self._running = None
        self._shut()
        self._into.release()
        self._out.release()

    def __enter__(self) -> ArrivalWorker:
        return self

    def __exit__(self, *_error) -> None:
        self.close()

    def _next(self) -> None:
        """Hands over what waits, if the process is free."""
        if self._running or not self._waiting:
            return
        (key, request), self._waiting = self._waiting, None
        self._into.fit(bytes_of(request))
        self._out.fit(BYTES_PER_CELL * request.depth_m.size * len(request.swells) + 64 * 16 * len(request.swells))
        try:
            self._start()
            self._pipe.send((self._into.name, self._out.name, self._into.write(request)))
        except (OSError, EOFError):
            self._broken.append((key, self._stopped()))
            return
        self._running = [key, True]

    def _start(self) -> None:
        if self._process is not None and self._process.is_alive():
            return
        self._shut()
        context = get_context("spawn")
        self._pipe, theirs = context.Pipe()
        self._process = context.Process(target=work, args=(theirs,), name="shorewright-arrivals", daemon=True)
        self._process.start()
        theirs.close()  # else the pipe would not end with the process
        self._end = weakref.finalize(self, _end, self._process, self._pipe)

    def _stopped(self) -> BadInput:
        self._process.join(1.0)
        code = self._process.exitcode
        self._shut()
        return BadInput(STOPPED.format(code=code))

    def _shut(self) -> None:
        if self._end is not None:
            self._end()
        self._process, self._pipe, self._end = None, None, None


def _end(process, pipe) -> None:
    """Lets the process go: its pipe ends, and if it is in the middle of something it is stopped."""
    pipe.close()
    process.join(0.2)
    for stop in (process.terminate, process.kill):
        if process.exitcode is None:
            stop()
            process.join(2.0)
    process.close()


def work(pipe: connection.Connection) -> None:
    """The process: one request after the other, until the pipe ends, as it does with its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C in the terminal is for the window
    into, out = Maps(), Maps()
    with contextlib.suppress(EOFError, OSError):
        while True:
            into_name, out_name, request = pipe.recv()
            try:
                found = solve_request(restored(request, into.attached(into_name)))
                pipe.send(placed(found, out.attached(out_name)))
            except BadInput as error:
                pipe.send(error)
            except Exception as error:
                pipe.send(BadInput(f"When waves arrive could not be worked out: {type(error).__name__}: {error}."))
    into.close()
    out.close()
