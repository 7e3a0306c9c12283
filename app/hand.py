"""The brush in hand: which one, its parameters, and strokes from press to release (part of the session)."""

from __future__ import annotations

from typing import Any

from ..brushes import BRUSHES, Stroke
from ..level import BadInput, Journal, Level, Rect
from ..level.grid import NOWHERE
from ..level.params import Section, replace, row
from . import words
from .steps import Steps


class Hand(Steps):
    """Brushes and strokes of a session."""

    level: Level
    journal: Journal
    brush: str
    tool: str
    params: dict[str, Section]
    stroke: Stroke | None

    def pick_brush(self, name: str) -> None:
        """Take another brush; BadInput when there is none of that name."""
        if name not in BRUSHES:
            raise BadInput(f"no brush is called {name!r}; there are: {', '.join(BRUSHES)}")
        self.stroke_end()
        self.brush = name
        self.tool = "brush"

    def set_param(self, name: str, value: Any, brush: str | None = None) -> None:
        """Change a parameter of a brush; BadInput out of range. No undo step: the level is untouched."""
        brush = brush or self.brush
        self.params[brush] = self.with_params(brush, {name: value})

    def scale_param(self, name: str, factor: float) -> None:
        """Make a parameter of the brush in hand larger or smaller, within its range."""
        params = self.params[self.brush]
        if name in type(params).model_fields:
            self.set_param(name, row(type(params), name).clamp(getattr(params, name) * factor))

    # Strokes

    def stroke_begin(self, x: float, y: float, pressure: float = 1.0, invert=False, smooth=False) -> Rect:
        """Press at a world point; returns the cells that changed."""
        return self._begin(self.brush, self.params[self.brush], (x, y, pressure), invert, smooth)

    def stroke_move(self, x: float, y: float, pressure: float = 1.0) -> Rect:
        """Move while pressed; nothing happens when no stroke is open, or the place is no number."""
        if self.stroke is None:
            return NOWHERE
        try:
            return self.stroke.move(x, y, pressure)
        except BaseException:  # it took itself back
            self.stroke = None
            raise

    def stroke_end(self) -> Rect:
        """Release: the stroke becomes one step."""
        stroke, self.stroke = self.stroke, None
        if stroke is None:
            return NOWHERE
        with self._edit(self._stroke_word(stroke)):
            return stroke.end()

    def stroke_abort(self) -> None:
        """Esc: no trace of the open stroke remains."""
        stroke, self.stroke = self.stroke, None
        if stroke is not None:
            stroke.abort()

    def drag(self, brush: str, *points, invert: bool = False, smooth: bool = False, **params) -> Rect:
        """A whole stroke through world points (x, y[, pressure]); `params` hold for this stroke only."""
        return self.draw(brush, self.with_params(brush, params), points, invert, smooth)

    def draw(self, brush: str, params: Section, points, invert: bool = False, smooth: bool = False) -> Rect:
        """A whole stroke with these parameters, whatever the brush in hand is set to."""
        if not points:
            raise BadInput("a stroke needs at least one point")
        points = [_point(point) for point in points]
        changed = self._begin(brush, params, points[0], invert, smooth)
        try:
            for point in points[1:]:
                changed = changed.union(self.stroke.move(*point))
        except BaseException:
            self.stroke_abort()
            raise
        return changed.union(self.stroke_end())

    def _begin(self, brush: str, params: Section, point, invert: bool, smooth: bool) -> Rect:
        self._end_stroke()
        if self.recovery:
            self.recovery.settle()  # a kill from here on costs this stroke only
        stroke = Stroke(self.level, self.journal, BRUSHES[brush], params, invert, smooth)
        changed = stroke.begin(*point)
        self.stroke = stroke
        return changed

    def _end_stroke(self) -> None:
        if self.stroke:
            self.stroke_end()

    def _stroke_word(self, stroke: Stroke) -> words.Stroke:
        points = [tuple(point) for point in stroke.samples]
        params = stroke.params.model_dump(mode="json")
        return words.Stroke.model_construct(
            do="stroke",
            brush=stroke.brush.name,
            params=params,
            points=points,
            invert=stroke.invert,
            smooth=stroke.smooth,
        )

    def with_params(self, brush: str, values: dict[str, Any], fresh: bool = False) -> Section:
        """The brush's parameters (its defaults when `fresh`) with some changed; BadInput names what cannot be."""
        if brush not in BRUSHES:
            raise BadInput(f"no brush is called {brush!r}; there are: {', '.join(BRUSHES)}")
        section = BRUSHES[brush].params() if fresh else self.params[brush]
        for name, value in values.items():
            known = type(section).model_fields
            if name not in known:
                raise BadInput(f"the brush {brush} has no parameter {name!r}; it has: {', '.join(known)}")
            section = replace(section, name, value)
        return section


def _point(point) -> tuple[float, float, float]:
    """A checked (x, y, pressure)."""
    x, y, pressure = (*point, 1.0)[:3]
    try:
        checked = words.POINT.validate_python((x, y, pressure))
    except ValueError:
        raise BadInput(
            f"{tuple(point)} is no place for a brush: it takes x, y in metres and a pressure 0 to 1"
        ) from None
    return checked
