"""Recorded strokes: what is needed to play one again to the same bytes, as plain values that fit in JSON."""

from __future__ import annotations

from ..level import BadInput, Journal, Level
from .catalog import BRUSHES
from .stroke import Stroke, usable


def recorded(stroke: Stroke) -> dict:
    """A stroke as brush, parameters, modifiers and samples (x m, y m, pressure)."""
    return {
        "brush": stroke.brush.name,
        "params": stroke.params.model_dump(mode="json"),
        "invert": stroke.invert,
        "smooth": stroke.smooth,
        "samples": [list(sample) for sample in stroke.samples],
    }


def replay(level: Level, journal: Journal, record: dict) -> Stroke:
    """Play a recorded stroke as one undo step; BadInput, and nothing changed, when it cannot be played."""
    brush = BRUSHES.get(record.get("brush", ""))
    if brush is None:
        raise BadInput(f"no brush is called {record.get('brush')!r}; there are: {', '.join(BRUSHES)}")
    samples = _samples(record.get("samples"))
    params = brush.with_params(record.get("params"))
    stroke = Stroke(level, journal, brush, params, bool(record.get("invert")), bool(record.get("smooth")))
    stroke.begin(*samples[0])
    for sample in samples[1:]:
        stroke.move(*sample)
    stroke.end()
    return stroke


def _samples(samples: object) -> list[tuple]:
    if not isinstance(samples, list | tuple) or not samples:
        raise BadInput("a recorded stroke has no samples: it needs at least one (x m, y m, pressure)")
    for number, sample in enumerate(samples):
        try:
            fine = 2 <= len(sample) <= 3 and usable(*sample, *(() if len(sample) == 3 else (1.0,)))
        except (TypeError, ValueError):
            fine = False
        if not fine:
            raise BadInput(f"sample {number} of a recorded stroke is {sample!r}: it takes x m, y m and a pressure")
    return [tuple(sample) for sample in samples]
