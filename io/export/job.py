"""A row of EXPORTERS, and what one run of it is given: the level, the folder, and which maps are to be made anew."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from pathlib import Path

from ...level import BadInput, Level
from ...level.beat import hearing
from .earlier import Earlier, Piece
from .engine_records import Options
from .follows import follows_sha256
from .records import Manifest

Told = Callable[[float, str], object]  # (share done, what comes next); False stops the export


STEM_BYTES = 150  # of a file name's 255, the most that file systems take; the rest is for what follows the stem


class Cancelled(Exception):  # noqa: N818 - no fault, somebody's wish
    """Whoever was told of the progress wanted no more of it; what was there before is untouched."""


@dataclass
class Job:
    """One export under way: write the chosen `maps` of `level` into `folder`, which is new and empty."""

    level: Level
    name: str
    target: str
    folder: Path
    maps: frozenset[str]
    options: Options = field(default_factory=Options)
    earlier: Earlier | None = None
    progress: Told | None = None
    empty: dict[str, str] = field(default_factory=dict)
    done: int = 0
    hashes: dict[str, str] = field(default_factory=dict)

    def piece(self, name: str, make: Callable[[], Piece], follows: tuple[str, ...] = ()) -> Piece:
        """The files of a map, nothing when it wasn't chosen: the earlier export's when they would be the same.

        `follows` are the layers that they are made of, with grid and sea level; () stands for all a level holds.
        """
        if name not in self.maps:
            return Piece()
        self.tell(name)
        asked = [self.target, self.name, name, self.options.model_dump_json()]
        key = follows_sha256(self.level, asked, follows, self.hashes)
        found = self.earlier.take(name, key, self.folder) if self.earlier else None
        if found is None:
            with hearing(lambda share: self.tell(name, share)):
                found = make()
            found.files = [record.model_copy(update={"follows_sha256": key}) for record in found.files]
        if not found.files:
            self.empty[name] = key
        self.done += 1
        return found

    def tell(self, name: str, share: float = 0.0) -> None:
        """Report that this share of a map is done; Cancelled when no more of it is wanted."""
        if self.progress and self.progress((self.done + share) / len(self.maps), name) is False:
            raise Cancelled("the export was cancelled")


@dataclass(frozen=True)
class Exporter:
    """A target: `maps` are the (name, sentence) pairs that `only` picks from; `function` writes and describes files.

    `sizes` are the sides that its height maps may have, () for any; `tiles` says whether it takes several of them.
    `groups` are words of `only` that stand for several maps.
    """

    name: str
    label: str
    doc: str
    maps: tuple[tuple[str, str], ...]
    function: Callable[[Job], Manifest]
    sizes: tuple[int, ...] = ()
    tiles: bool = False
    groups: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def choose(self, only: Iterable[str] | str | None, others: Iterable[Exporter] = ()) -> frozenset[str]:
        """The names in `only`, all of them for None; BadInput tells a near name, or who of `others` has it."""
        names = [name for name, _ in self.maps]
        asked = names if only is None else [only] if isinstance(only, str) else list(only)
        if not asked:
            raise BadInput(f"nothing was chosen for the {self.name} export")
        wanted = [name for word in asked for name in self.groups.get(word, (word,))]
        unknown = next((name for name in wanted if name not in names), None)
        if unknown is not None:
            raise BadInput(f"the {self.name} export has no map called {unknown!r}{self._hint(unknown, others)}")
        return frozenset(wanted)

    def _hint(self, unknown: str, others: Iterable[Exporter]) -> str:
        """The end of the sentence on an unknown map: who has it, what is near, else all there is."""
        having = [row.name for row in others if unknown in (name for name, _ in row.maps)]
        if having:
            return f": only {' and '.join(having)} {'has' if len(having) == 1 else 'have'} it"
        known = [*self.groups, *(name for name, _ in self.maps)]
        near = get_close_matches(unknown, known, 1)
        return f": did you mean {near[0]}?" if near else f"; it has: {', '.join(known)}"

    def options(self, resample: bool, tile: int | None) -> Options:
        """Both, if this target knows them; BadInput says why not."""
        if resample and not self.sizes:
            raise BadInput(f"the {self.name} export writes the level's own samples: there is nothing to resample")
        if tile is not None and not self.tiles:
            raise BadInput(f"the {self.name} export has no tiles")
        if tile is not None and tile not in self.sizes:
            sizes = ", ".join(map(str, self.sizes))
            raise BadInput(f"a tile of {tile} samples a side is none that {self.label} takes; use one of: {sizes}")
        if resample and tile is not None:
            raise BadInput("a level is either resampled to one height map or cut into tiles, not both")
        return Options(resample=resample, tile=tile)


def file_stem(name: str) -> str:
    """A level's name as the beginning of file names that every system and engine takes.

    `4033x4033` in a name would be read by Unreal as a tile index (research, authoring 4), so the x goes.
    """
    stem = re.sub(r"\.shore$", "", name.strip())
    stem = re.sub(r"[^\w.\- ]", "_", stem).strip(". ")
    stem = stem.encode()[:STEM_BYTES].decode(errors="ignore")
    return re.sub(r"(?<=\d)[xX](?=\d)", "-", stem) or "level"
