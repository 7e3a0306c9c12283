"""What verbs share: tables and JSON on stdout, notes and progress on stderr, values given as text."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from ...level.errors import BadInput

LevelPath = Annotated[Path, Parameter(help="A level's folder, NAME.shore.")]


def put(text: str) -> None:
    """A line on stdout, never wrapped."""
    print(text)


def put_json(rows: Any) -> None:
    print(json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False))


def put_notes(notes: Iterable[str]) -> None:
    """What is worth telling beside the result: on stderr, a line each."""
    for note in notes:
        print(f"note: {' '.join(note.split())}", file=sys.stderr)


def put_table(rows: list[tuple[str, ...]], indent: str = "") -> None:
    """Columns as wide as they need; the last one runs free."""
    widths = [max((len(row[i]) for row in rows), default=0) for i in range(len(rows[0]) - 1)] if rows else []
    for row in rows:
        cells = [cell.ljust(width) for cell, width in zip(row, widths)]
        print((indent + "  ".join([*cells, row[-1]])).rstrip())


class Progress:
    """Tells how far long work is; lines put meanwhile wait until the bar is gone from the terminal."""

    held: list[str] | None = None
    update: Callable[[int, int, str | None], object] | None = None

    def __call__(self, done: int, total: int, what: str | None = None) -> None:
        """`what` replaces the bar's title."""
        if self.update:
            self.update(done, total, what)

    def put(self, text: str) -> None:
        put(text) if self.held is None else self.held.append(text)


@contextmanager
def progress(title: str) -> Iterator[Progress]:
    """A bar on a terminal, and nothing elsewhere."""
    told = Progress()
    if not sys.stderr.isatty():
        yield told
        return
    from rich import progress as rich_progress
    from rich.console import Console

    # rich would take stdout over too, and wrap what is printed there
    with rich_progress.Progress(
        console=Console(stderr=True), transient=True, redirect_stdout=False, redirect_stderr=False
    ) as bar:
        task = bar.add_task(title, total=None)
        told.held, told.update = (
            [],
            lambda done, total, what: bar.update(task, completed=done, total=total, description=what),
        )
        yield told
    for line in told.held:
        put(line)


# Values given as text


def size(text: str, flag: str = "--size", most: int = 16384) -> tuple[int, int]:
    """`1280x720` as (width, height)."""
    found = re.fullmatch(r"\s*(\d{1,6})\s*[x×,]\s*(\d{1,6})\s*", text)
    pair = (int(found[1]), int(found[2])) if found else (0, 0)
    if not all(1 <= side <= most for side in pair):
        raise BadInput(f"{flag} {text} is no size: give WIDTHxHEIGHT such as 1280x720, at most {most} a side")
    return pair


def numbers(text: str, count: int, flag: str, what: str) -> list[float]:
    """`1,2.5,-3` as that many finite numbers."""
    try:
        values = [float(part) for part in text.split(",")]
    except ValueError:
        values = []
    if len(values) != count or not all(abs(value) < 1e12 for value in values):
        raise BadInput(f"{flag} {text} is not {what}")
    return values


def assignment(text: str) -> tuple[str, str]:
    """`sea.swell_m=1.2` as (name, value)."""
    name, sign, value = text.partition("=")
    if not (sign and name.strip()):
        raise BadInput(f"--set {text} is no assignment: write NAME=VALUE such as sea.swell_m=1.2")
    return name.strip(), value.strip()


def words(texts: list[str] | None) -> list[str] | None:
    """Names given once or often, with or without commas; None when none was given."""
    found = [part.strip() for text in texts or [] for part in text.split(",") if part.strip()]
    return found or None


def finite(value: float, flag: str, low: float, high: float) -> float:
    """A number within its range."""
    if not low <= value <= high:
        raise BadInput(f"{flag} {value:g} is outside {low:g} to {high:g}")
    return value


def writable_parent(path: Path) -> None:
    """Refuse a file in a folder that isn't there or takes none, before any work is done for it."""
    if not path.parent.is_dir():
        raise BadInput(f"the folder {path.parent} does not exist, so {path.name} cannot be written into it")
    if path.is_dir():
        raise BadInput(f"{path} is a folder: name a file")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise BadInput(f"the folder {path.parent} is read-only, so {path.name} cannot be written into it")
