"""A row of EXPORTERS, and what one run of it is given."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from ...level import BadInput, Level
from .records import Manifest


@dataclass(frozen=True)
class Job:
    """One export under way: write the chosen `maps` of `level` into `folder`, which is new and empty."""

    level: Level
    name: str
    folder: Path
    maps: frozenset[str]


@dataclass(frozen=True)
class Exporter:
    """A target: `maps` are the (name, sentence) pairs that `only` picks from; `function` writes and describes files."""

    name: str
    label: str
    doc: str
    maps: tuple[tuple[str, str], ...]
    function: Callable[[Job], Manifest]

    def choose(self, only: Iterable[str] | str | None) -> frozenset[str]:
        """The names in `only`, all of them for None; BadInput lists the names when one is unknown."""
        names = [name for name, _ in self.maps]
        wanted = names if only is None else [only] if isinstance(only, str) else list(only)
        unknown = [name for name in wanted if name not in names]
        if unknown or not wanted:
            asked = ", ".join(map(repr, unknown)) or "nothing"
            raise BadInput(f"the {self.name} export has no map called {asked}; it has: {', '.join(names)}")
        return frozenset(wanted)


def file_stem(name: str) -> str:
    """A level's name as the beginning of file names that every system and Unreal take.

    `4033x4033` in a name would be read by Unreal as a tile index (research, authoring 4), so the x goes.
    """
    stem = re.sub(r"\.shore$", "", name.strip())
    stem = re.sub(r"[^\w.\- ]", "_", stem).strip(". ")[:100]
    return re.sub(r"(?<=\d)[xX](?=\d)", "-", stem) or "level"
