"""Brushes change layers of a level: a row of BRUSHES is effect × footprint × path × layer; a `Stroke` plays it."""

from .catalog import BRUSHES, Brush
from .stroke import Stroke

__all__ = ["BRUSHES", "Brush", "Stroke"]
