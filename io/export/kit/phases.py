"""What of a kit's uniforms grows with time: formulas in double, wrapped, so that the sea stands right after a week."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass

FORMULA = (
    "uniform[row][part] = offset + scale * form(cycles), cycles = start + rate_hz * t in double, from the time from_s "
    "on; row -1: the uniform is no array; a later from_s takes over. Forms: fract = cycles - floor(cycles); whole = "
    "floor(cycles), mod turns where turns > 0; ramp = 1 - |2 fract - 1|; cos and sin of 2 pi fract; hop = "
    "fract(first + hop * whole); fold = fract(first + hop * fract)"
)


@dataclass(frozen=True)
class Form:
    """`text` in C and HLSL of {fract}, {whole}, {hop} and {fold}; `value` of cycles and a Phase."""

    text: str
    value: Callable[[float, Phase], float]


@dataclass(frozen=True)
class Phase:
    """Component `part` of row `row` (-1: the uniform has none) of a uniform over time, as FORMULA says."""

    uniform: str
    row: int
    part: int
    start: float
    rate_hz: float
    turns: int = 0
    form: str = "fract"
    scale: float = 1.0
    offset: float = 0.0
    hop: float = 0.0
    first: float = 0.0
    from_s: float = 0.0

    def at(self, t: float) -> float:
        """Its value at a time."""
        return self.offset + self.scale * FORMS[self.form].value(self.start + self.rate_hz * t, self)

    def place(self, value) -> tuple[int, ...]:
        """Its index in the uniform's array."""
        return ((self.row, self.part) if self.row >= 0 else (self.part,))[: value.ndim]

    def told(self) -> dict:
        """What the json says of it."""
        return asdict(self)


def _fract(cycles: float) -> float:
    return cycles - math.floor(cycles)


def _whole(cycles: float, phase: Phase) -> float:
    return math.floor(cycles) % phase.turns if phase.turns else float(math.floor(cycles))


FORMS = {
    "fract": Form("{fract}", lambda cycles, phase: _fract(cycles)),
    "whole": Form("{whole}", _whole),
    "ramp": Form("(1.0 - {abs}(2.0 * {fract} - 1.0))", lambda cycles, phase: 1 - abs(2 * _fract(cycles) - 1)),
    "cos": Form("cos(6.283185307179586 * {fract})", lambda cycles, phase: math.cos(2 * math.pi * _fract(cycles))),
    "sin": Form("sin(6.283185307179586 * {fract})", lambda cycles, phase: math.sin(2 * math.pi * _fract(cycles))),
    "fold": Form("{fold}", lambda cycles, phase: _fract(phase.first + phase.hop * _fract(cycles))),
    "hop": Form("{hop}", lambda cycles, phase: _fract(phase.first + phase.hop * _whole(cycles, phase))),
}


def straight(
    uniform: str, part: int, cycles: Callable[[float], float], knots: list[float], **rest: float | str
) -> list[Phase]:
    """Phases of a number that is not wrapped, a straight line from each of `knots` to the next and on from the last."""
    found = []
    for low, high in zip(knots, [*knots[1:], knots[-1] + 60.0], strict=True):
        rate = (cycles(high) - cycles(low)) / (high - low)
        found.append(Phase(uniform, -1, part, cycles(low) - rate * low, rate, from_s=low, **rest))
    return found
