"""Dataclasses full of arrays by shared memory: the arrays lie in a block, the rest goes with their places by a pipe."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, is_dataclass, replace
from multiprocessing.shared_memory import SharedMemory
from threading import Thread

import numpy as np

ALIGN = 64  # bytes


@dataclass(frozen=True)
class Place:
    """Where an array lies in a block."""

    offset: int
    shape: tuple[int, ...]
    dtype: str


def bytes_of(thing) -> int:
    """Bytes that the arrays of a dataclass (or tuple of them) take in a block."""
    total = 0

    def count(array):
        nonlocal total
        total += array.nbytes + ALIGN

    _mapped(thing, np.ndarray, count)
    return total


def bytes_placed(thing) -> int:
    """Bytes of what its `Place`s hold."""
    total = 0

    def count(place):
        nonlocal total
        total += math.prod(place.shape) * np.dtype(place.dtype).itemsize

    _mapped(thing, Place, count)
    return total


def placed(thing, buffer: memoryview):
    """The same with its arrays written into the buffer, a `Place` for each."""
    end = 0

    def put(array):
        nonlocal end
        place = Place(end, array.shape, array.dtype.str)
        _view(buffer, place)[...] = array
        end += -(-array.nbytes // ALIGN) * ALIGN
        return place

    return _mapped(thing, np.ndarray, put)


def restored(thing, buffer: memoryview):
    """The same with arrays of its own, read from the buffer."""
    return _mapped(thing, Place, lambda place: _view(buffer, place).copy())


def _view(buffer: memoryview, place: Place) -> np.ndarray:
    return np.ndarray(place.shape, place.dtype, buffer, place.offset)


def _mapped(thing, kind: type, change):
    if isinstance(thing, kind):
        return change(thing)
    if isinstance(thing, tuple):
        parts = (_mapped(one, kind, change) for one in thing)
        return type(thing)(*parts) if hasattr(thing, "_fields") else tuple(parts)
    if is_dataclass(thing):
        values = {field.name: getattr(thing, field.name) for field in fields(thing)}
        return replace(thing, **{name: _mapped(value, kind, change) for name, value in values.items()})
    return thing


class Block:
    """Shared memory that this process owns: grows when asked; whoever holds it must `release` it."""

    def __init__(self):
        self._memory = None

    @property
    def name(self) -> str:
        return self._memory.name

    def fit(self, size: int) -> None:
        """Makes room; only while nobody else reads or writes."""
        if self._memory is not None and self._memory.size >= size:
            return
        self.release()
        self._memory = SharedMemory(create=True, size=size)

    def write(self, thing):
        return placed(thing, self._memory.buf)

    def read(self, thing):
        return restored(thing, self._memory.buf)

    def release(self) -> None:
        if self._memory is not None:
            self._memory.close()
            self._memory.unlink()
            self._memory = None


class Reading:
    """An answer being copied out of a block by a thread: NumPy gives up Python's lock while it copies, so the thread
    that draws goes on. `answer` waits."""

    def __init__(self, block: Block, thing) -> None:
        self._answer = None
        self._thread = Thread(target=self._read, args=(block, thing), name="shorewright-reading")
        self._thread.start()

    def _read(self, block: Block, thing) -> None:
        self._answer = block.read(thing)

    @property
    def done(self) -> bool:
        return not self._thread.is_alive()

    @property
    def answer(self):
        self._thread.join()
        return self._answer


class Maps:
    """Another process's block, attached by name; one at a time."""

    def __init__(self):
        self._memory = None

    def attached(self, name: str) -> memoryview:
        if self._memory is None or self._memory.name != name:
            self.close()
            self._memory = SharedMemory(name)
        return self._memory.buf

    def close(self) -> None:
        if self._memory is not None:
            self._memory.close()
            self._memory = None
