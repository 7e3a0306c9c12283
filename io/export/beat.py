"""The pulse of long work: makers of maps call `beat` between their steps, whoever runs them hears it.

A maker knows nothing of the export it works for; without one, nobody listens and `beat` does nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_heard: ContextVar[Callable[[float], object] | None] = ContextVar("heard", default=None)


def beat(share: float) -> None:
    """Say that this share of the present map is done; whoever listens may stop the work by raising."""
    heard = _heard.get()
    if heard:
        heard(share)


@contextmanager
def hearing(heard: Callable[[float], object]) -> Iterator[None]:
    """Hear the beats of all that runs inside."""
    token = _heard.set(heard)
    try:
        yield
    finally:
        _heard.reset(token)
