"""A process that works for the window while it goes on drawing: solves travel times and wave heights, shapes fronts.

Fast marching holds Python's lock for all of its run (measured: a window's thread stood still for 0.62 of 0.64 s), so it
can't be a thread. Maps go by shared memory, the rest by a pipe. The latest request wins: one waits, those it replaces
are dropped.
"""

from __future__ import annotations

import contextlib
import signal
import sys
import weakref
from dataclasses import dataclass, field
from multiprocessing import connection, get_context
from types import ModuleType

from ..level.arrival import Asked
from ..level.arrival_map import ArrivalMap
from ..level.errors import BadInput
from ..level.flow import Current, CurrentRequest
from ..level.shaping import Shaped
from ..level.shaping_request import ShapeRequest
from ..level.shore_bed import Bed, BedRequest
from ..level.swell_request import SwellRequest, SwellResult
from .shared_maps import Block, Maps, bytes_of, placed, restored

Request = SwellRequest | Asked | ShapeRequest | BedRequest | CurrentRequest
Answer = tuple[SwellResult, ...] | ArrivalMap | Shaped | Bed | Current | BadInput | None
STOPPED = "The process that works beside the window stopped (exit code {code}); it starts anew with the next change."


def solve_now(request: SwellRequest) -> tuple[SwellResult, ...]:
    """The answer at once, in this process: for the command line. The same bits as by the worker."""
    return request.kept().answered()


@dataclass
class _Held:
    """What must be given back, in this order: the process first, which may just be attaching a block."""

    process: object = None
    pipe: connection.Connection | None = None
    into: Block = field(default_factory=Block)
    out: Block = field(default_factory=Block)

    def start(self) -> None:
        """Starts the process unless it lives."""
        if self.process is not None and self.process.is_alive():
            return
        self.stop()
        context = get_context("spawn")
        pipe, theirs = context.Pipe()
        process = context.Process(target=work, args=(theirs,), name="shorewright-beside", daemon=True)
        # A new process would import the program that runs (the window, or a script and all that it does) once more.
        program, sys.modules["__main__"] = sys.modules["__main__"], ModuleType("__main__")
        try:
            process.start()
        finally:
            sys.modules["__main__"] = program
        theirs.close()  # else the pipe would not end with the process
        self.process, self.pipe = process, pipe

    def stop(self) -> int | None:
        """Ends the process, in the middle of something if need be; its exit code."""
        if self.process is None:
            return None
        self.pipe.close()
        self.process.join(0.2)
        for stop in (self.process.terminate, self.process.kill):
            if self.process.exitcode is None:
                stop()
                self.process.join(2.0)
        code = self.process.exitcode
        self.process.close()
        self.process = self.pipe = None
        return code

    def release(self) -> None:
        """Everything."""
        self.stop()
        self.into.release()
        self.out.release()


class ArrivalWorker:
    """One process, started with the first request and kept; used from one thread."""

    def __init__(self):
        self._held = _Held()
        self._running: list | None = None  # [key, wanted]
        self._waiting: tuple | None = None  # (key, request)
        self._failed: list = []  # answers that never left this process: (key, error)
        weakref.finalize(self, self._held.release)  # also at the program's end

    @property
    def busy(self) -> bool:
        """Whether an answer is still to come."""
        return bool(self._running or self._waiting or self._failed)

    def ask(self, key, request: Request) -> None:
        """Asks; what waited is dropped. `key` (a revision, say) comes back with the answer."""
        self._waiting = key, request.kept()
        self._next()

    def warm(self) -> None:
        """Starts the process before anything is asked."""
        self._held.start()

    def forget(self) -> None:
        """Nothing that was asked for so far is wanted any more: no answer to it comes out of `poll`."""
        self._waiting, self._failed = None, []
        if self._running:
            self._running[1] = False

    def poll(self) -> tuple[object, Answer] | None:
        """The next answer with its key, at once; None where there is none. What can't be solved is a `BadInput`."""
        if self._failed:
            return self._failed.pop(0)
        answer = None
        if self._running and self._held.pipe.poll():
            (key, wanted), self._running = self._running, None
            try:
                found = self._held.pipe.recv()
            except (EOFError, OSError):
                found = self._stopped()
            if wanted:
                answer = key, found if isinstance(found, BadInput) else self._held.out.read(found)
        self._next()
        return answer

    def close(self) -> None:
        """Ends the process and gives all shared memory back; may be called again."""
        self.forget()
        self._running = None
        self._held.release()

    def __enter__(self) -> ArrivalWorker:
        return self

    def __exit__(self, *_error) -> None:
        self.close()

    def _next(self) -> None:
        """Hands over what waits, if the process is free."""
        if self._running or not self._waiting:
            return
        (key, request), self._waiting = self._waiting, None
        held = self._held
        held.into.fit(bytes_of(request))
        held.out.fit(request.answer_bytes)
        try:
            held.start()
            held.pipe.send((held.into.name, held.out.name, held.into.write(request)))
        except (OSError, EOFError):
            self._failed.append((key, self._stopped()))
            return
        self._running = [key, True]

    def _stopped(self) -> BadInput:
        return BadInput(STOPPED.format(code=self._held.stop()))


def work(pipe: connection.Connection) -> None:
    """The process: one request after the other, until the pipe ends, as it does with its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C in the terminal is for the window
    into, out = Maps(), Maps()
    with contextlib.suppress(EOFError, OSError):
        while True:
            into_name, out_name, request = pipe.recv()
            try:
                found = restored(request, into.attached(into_name)).answered()
                pipe.send(placed(found, out.attached(out_name)))
            except BadInput as error:
                pipe.send(error)
            except Exception as error:
                pipe.send(BadInput(f"What the waves do could not be worked out: {type(error).__name__}: {error}."))
    into.close()
    out.close()
