"""What the editor has to tell: the log's lines, and the last one as a passing message over the viewport."""

from __future__ import annotations

import logging
import time
from collections import deque
from dataclasses import dataclass, field

MOST_LINES = 500
TOAST_S = 4.0
BAD_TOAST_S = 8.0


@dataclass(frozen=True)
class Line:
    """One message; `level` as in logging."""

    level: int
    text: str
    detail: str = ""
    at: float = field(default_factory=time.time)

    @property
    def bad(self) -> bool:
        return self.level >= logging.WARNING


class Messages(logging.Handler):
    """Collects what is told by `tell` and what the package logs; any thread may write."""

    def __init__(self) -> None:
        super().__init__(logging.INFO)
        self.lines: deque[Line] = deque(maxlen=MOST_LINES)
        self._passing: Line | None = None
        self._shown_at = -1e9

    def emit(self, record: logging.LogRecord) -> None:
        detail = logging.Formatter().formatException(record.exc_info) if record.exc_info else ""
        line = Line(record.levelno, record.getMessage(), detail)
        self._add(line, passing=line.bad)  # what goes well is for the log's panel alone

    def tell(self, text: str, level: int = logging.INFO) -> None:
        """Say something to the person at the window."""
        self._add(Line(level, text))

    def warn(self, text: str) -> None:
        self.tell(text, logging.WARNING)

    def toast(self) -> Line | None:
        """The last line while it is fresh."""
        line = self._passing
        lasts = BAD_TOAST_S if line is not None and line.bad else TOAST_S
        return line if time.monotonic() - self._shown_at < lasts else None

    def attach(self, name: str = "shorewright") -> None:
        logging.getLogger(name).addHandler(self)
        logging.getLogger(name).setLevel(logging.INFO)

    def detach(self, name: str = "shorewright") -> None:
        logging.getLogger(name).removeHandler(self)

    def _add(self, line: Line, passing: bool = True) -> None:
        self.lines.append(line)
        if passing:
            self._passing, self._shown_at = line, time.monotonic()
