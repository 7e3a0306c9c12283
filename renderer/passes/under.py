"""Copies what lies under the water before the water is drawn over it (D02); overlays find the ground there too."""

from __future__ import annotations

from ..frame import Frame


def draw(frame: Frame) -> None:
    frame.targets.copy_under()
