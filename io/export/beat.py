"""The pulse of long work (level/beat.py), for exporters."""

from ...level.beat import beat, hearing

__all__ = ["beat", "hearing"]
