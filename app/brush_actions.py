"""Rows of ACTIONS for brushes, what they paint and how."""

from __future__ import annotations

from collections.abc import Callable

from ..brushes import BRUSHES
from ..level.cloud_types import CLOUD_TYPES
from . import sky_brush
from .action import Action
from .session import Session

SIZE_STEP = 1.12  # one press of [ or ]
STRENGTH_STEP = 1.15


def brush_rows() -> list[Action]:
    """Brushes, their size and strength, the whole sky, types of cloud."""
    return [
        Action("smaller", "Smaller brush", ("[",), "Brush", _scale("size_m", 1 / SIZE_STEP), repeats=True),
        Action("larger", "Larger brush", ("]",), "Brush", _scale("size_m", SIZE_STEP), repeats=True),
        Action("weaker", "Weaker brush", ("{",), "Brush", _scale("strength", 1 / STRENGTH_STEP), repeats=True),
        Action("stronger", "Stronger brush", ("}",), "Brush", _scale("strength", STRENGTH_STEP), repeats=True),
        *(
            Action(f"brush.{brush.name}", brush.label, (brush.key,) if brush.key else (), "Brush", _brush(brush.name))
            for brush in BRUSHES.values()
        ),
        Action("alpha", "Shape of the brush from a file…", (), "Brush", lambda s: s.ask("alpha"), _takes_alpha),
        Action("sky.fill", "Paint all of the sky", (), "Brush", sky_brush.fill),
        Action("sky.erase", "Erase all painted weather", (), "Brush", _erase_sky, _has_sky),
        *(
            Action(f"cloud.{row.name}", row.label, (), "Clouds to paint", _cloud(row.name))
            for row in CLOUD_TYPES.values()
        ),
    ]


def _brush(name: str) -> Callable[[Session], None]:
    return lambda session: session.pick_brush(name)


def _scale(name: str, factor: float) -> Callable[[Session], None]:
    return lambda session: session.scale_param(name, factor)


def _takes_alpha(session: Session) -> bool:
    return "alpha" in type(session.params[session.brush]).model_fields


def _erase_sky(session: Session) -> object:
    return sky_brush.fill(session, "erase")


def _has_sky(session: Session) -> bool:
    return not session.level.layers["weather"].neutral


def _cloud(name: str) -> Callable[[Session], None]:
    return lambda session: sky_brush.choose(session, name)
