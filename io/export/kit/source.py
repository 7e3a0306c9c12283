"""One text of the GLSL of a part of the kit: includes put in, conditions decided by what the level has, comments kept.

What is left is only what this level needs, which keeps the files of the kit short. `level/NAME.glsl` is the editor's
own; one of the same name among the kit's `shaders` takes its place.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from ....level import BadInput

SHADERS = Path(__file__).parents[3] / "level" / "shaders"
OWN = Path(__file__).parent / "shaders"
_DIRECTIVE = re.compile(r"^\s*#\s*(\w+)\s*(.*?)\s*(?://.*)?$")


def one_text(defines: Iterable[str], part: str = "sea") -> str:
    """The text of a part of the kit with every file that it includes once; BadInput for a directive it doesn't know.

    `KIT_` before a name becomes the part's own: a game may include several parts in one shader.
    """
    lines: list[str] = []
    _put(f"kit/{part}.glsl", set(defines), set(), lines)
    return "\n".join(lines).replace("KIT_", f"{part}_") + "\n"


def _path(name: str) -> Path:
    own = OWN / name.split("/")[-1]
    return own if own.is_file() else SHADERS / name.removeprefix("level/")


def _put(name: str, defines: set[str], seen: set[str], lines: list[str]) -> None:
    if name in seen:
        return
    seen.add(name)
    lines.append(f"\n// ---- {name}\n")
    kept: list[bool] = []
    for number, line in enumerate(_path(name).read_text("utf-8").splitlines(), 1):
        found = _DIRECTIVE.match(line)
        if not found:
            if all(kept):
                lines.append(line)
            continue
        word, rest = found.groups()
        if word in ("ifdef", "ifndef"):
            kept.append((rest in defines) == (word == "ifdef"))
        elif word == "else":
            kept[-1] = not kept[-1]
        elif word == "endif":
            kept.pop()
        elif word == "include":
            if all(kept):
                _put(rest.strip('"'), defines, seen, lines)
        else:
            raise BadInput(f"{name}:{number}: the runtime kit knows no #{word}")
