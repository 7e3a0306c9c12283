"""What is asked of the process beside a window, and work that a window does a part a frame (T14).

A request is a frozen dataclass of arrays and plain values, so is its answer: `app/shared_maps.py` carries both.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterator
from typing import Any, Protocol, TypeVar

from .beat import beat

Answer = TypeVar("Answer", covariant=True)
Made = TypeVar("Made")
Parts = Iterator[None]  # a work that pauses now and then, to go on in a later frame


class Request(Protocol[Answer]):
    """All that an answer follows from: asked at once or of another process, the answer has the same bits."""

    def kept(self) -> Request[Answer]:
        """With arrays of its own, which no later edit of the level reaches."""

    @property
    def answer_bytes(self) -> int:
        """Bytes of the arrays of its answer, at most."""

    def answered(self) -> Answer:
        """The answer, worked out now."""


class Beside(Protocol):
    """What an editor lends to a level, so that no window waits for what a release asks for."""

    def beside(self, name: str, key: tuple, request: Callable[[], Request[Any]]) -> Any:
        """The answer of that name and key, worked out by another process; None till it has come."""

    def in_parts(self, name: str, parts: Parts) -> bool:
        """Go on with a work as far as this frame has time for that name; True when it is done."""


def finished(parts: Generator[None, None, Made]) -> Made:
    """What a work in parts returns, done at once."""
    while True:
        beat()
        try:
            next(parts)
        except StopIteration as end:
            return end.value
