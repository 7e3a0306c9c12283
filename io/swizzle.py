"""Which channel of an image is which of a map: `r,0,0.6`, `b,0,r`, `1-r,g,b`; `-` leaves what was there (T04)."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..level import BadInput

TERM = re.compile(r"(1\s*[-−]\s*)?([rgba])")
KEEP = "-"


@dataclass(frozen=True)
class Term:
    """A channel by its letter, turned round or not; or a constant; or (neither) nothing."""

    letter: str = ""
    inverted: bool = False
    constant: float | None = None

    @property
    def kept(self) -> bool:
        return not self.letter and self.constant is None


def parse(text: str) -> tuple[Term, ...]:
    """Terms of coverage, precipitation, type and, where given, the weight of all or of each; BadInput in a sentence."""
    parts = [part.strip().lower() for part in text.split(",")]
    if len(parts) == 1 and re.fullmatch(r"[rgba]{3}", parts[0]):
        parts = list(parts[0])
    if len(parts) not in (3, 4, 6):
        raise BadInput(
            f"the swizzle {text!r} has {len(parts)} parts: give coverage, precipitation and type, such as r,0,0.6"
        )
    terms = [_term(part, text) for part in parts]
    if all(term.kept for term in terms[:3]):
        raise BadInput(f"the swizzle {text!r} takes nothing from the image")
    return tuple(terms + terms[3:] * 2 if len(terms) == 4 else terms)


def _term(part: str, text: str) -> Term:
    if part == KEEP:
        return Term()
    if found := TERM.fullmatch(part):
        return Term(found[2], bool(found[1]))
    try:
        value = float(part)
    except ValueError:
        value = math.nan
    if not 0 <= value <= 1:
        raise BadInput(f"{part!r} in the swizzle {text!r} is neither r, g, b, a, 1-r …, a number from 0 to 1, nor -")
    return Term(constant=value)


def letters(channels: Sequence[str]) -> dict[str, int]:
    """Where each letter is found among an image's channels; grey counts as red."""
    found: dict[str, int] = {}
    for number, name in enumerate(channels):
        letter = name.rpartition(".")[2][:1].lower()
        letter = {"y": "r", "l": "r", "i": "r"}.get(letter, letter)
        if letter in "rgba":
            found.setdefault(letter, number)
    return found or dict(zip("rgba", range(len(channels))))


def picked(pixels: np.ndarray, channels: Sequence[str], terms: Sequence[Term], name: str) -> np.ndarray:
    """float32 `(rows, cols, terms)`: whole samples as 0 … 1, floats as they are; BadInput for a missing one."""
    places = letters(channels)
    out = np.zeros((*pixels.shape[:2], len(terms)), np.float32)
    for number, term in enumerate(terms):
        if term.constant is not None:
            out[..., number] = term.constant
        elif term.letter:
            if term.letter not in places:
                raise BadInput(
                    f"{name} has no channel {term.letter}, only {', '.join(places)}: give a swizzle such as r,0,0.6"
                )
            part = pixels[..., places[term.letter]]
            top = np.iinfo(part.dtype).max if part.dtype.kind in "iu" else 1.0
            part = np.divide(part, np.float32(top), dtype=np.float32) if top != 1.0 else part
            out[..., number] = 1 - part if term.inverted else part
    return out
