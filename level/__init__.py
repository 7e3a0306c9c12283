"""What a level is and what follows from it: arrays, settings, undo, waves, analysis. No GL, no files, no window."""

from .clock import Clock
from .errors import BadInput
from .grid import SECTOR, TILE, Grid, Rect
from .journal import Journal
from .layers import LAYERS, Layer
from .level import Level
from .settings import Settings

__all__ = ["LAYERS", "SECTOR", "TILE", "BadInput", "Clock", "Grid", "Journal", "Layer", "Level", "Rect", "Settings"]
