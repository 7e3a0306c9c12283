"""The pulse of long work: what takes long calls `beat` between its steps, whoever runs it hears that.

The work knows nothing of the export that it is for; without one, nobody listens and `beat` does nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_heard: ContextVar[Callable[[float | None], object] | None] = ContextVar("heard", default=None)


def beat(share: float | None = None) -> None:
    """Say that this share of the present work is done, None: some more; whoever listens may stop it by raising."""
    heard = _heard.get()
    if heard:
        heard(share)


@contextmanager
def hearing(heard: Callable[[float], object]) -> Iterator[None]:
    """Hear the beats of all that runs inside: the largest share that was told."""
    most = 0.0

    def told(share: float | None) -> None:
        nonlocal most
        most = max(most, share or 0.0)
        heard(most)

    token = _heard.set(told)
    try:
        yield
    finally:
        _heard.reset(token)
