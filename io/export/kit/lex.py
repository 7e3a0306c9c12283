"""Words of GLSL, each with the comment that stands on the lines before it."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from ....level import BadInput

_WORD = re.compile(
    r"(?P<space>[ \t]+)|(?P<line>\n)|(?P<note>//[^\n]*)"
    r"|(?P<num>(?:\d+\.\d*|\.\d+|\d+)(?:[eE][-+]?\d+)?u?)|(?P<name>[A-Za-z_]\w*)"
    r"|(?P<sign><<=|>>=|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||\+=|-=|\*=|/=|\|=|&=|[-+*/%<>=!&|^~?:;,.(){}\[\]])"
)


@dataclass
class Word:
    kind: str  # num, name, sign, end
    text: str
    line: int
    doc: list[str] = field(default_factory=list)


def words(text: str) -> list[Word]:
    """The words of a text, an `end` last; BadInput where there is none that GLSL knows."""
    found: list[Word] = []
    notes: list[str] = []
    at, line, fresh, blank = 0, 1, True, 0
    while at < len(text):
        match = _WORD.match(text, at)
        if not match:
            raise BadInput(f"line {line} of the shader: {text[at : at + 20]!r} is no word the runtime kit knows")
        at, kind = match.end(), match.lastgroup
        if kind == "line":
            line, fresh, blank = line + 1, True, blank + 1
            if blank > 1:
                notes = []
        elif kind == "note":
            blank = 0
            if fresh:
                notes.append(match.group())
        elif kind != "space":
            found.append(Word(kind or "", match.group(), line, notes))
            notes, fresh, blank = [], False, 0
    return [*found, Word("end", "", line)]
