"""A row of VIEWS (views.py): what it shows, and where it can be shown."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ..level import Settings
from ..level.params import replace

# what only a pixel of the screen knows of
_OF_PIXELS = re.compile(
    r"\bs\.(?!before|material|eye_depth)|\b(lit|under|ray|pixel|plate|gl_FragCoord|sun_glint|crest_light)\b"
)
# passes write something else for these, or they look things up where the pixel itself stands
_OWN_SCENE = ("scatter", "props", "ground", "triangle_area", "plate_a", "plate_b", "reflections", "glint")
RAMPS = ("light", "colour", "direct", "grey", "signed", "normal", "metres")


@dataclass(frozen=True)
class View:
    name: str
    label: str
    doc: str
    value: str = ""
    ramp: str = "grey"
    low: float = 0.0
    high: float = 1.0
    ids: str = "T11"
    layer: str = ""  # the painted layer the value reads as `painted`
    scene: str = ""  # "white": all albedo 1; "lookdev": balls and a card before the camera
    settings: tuple[tuple[str, object], ...] = ()  # what it changes of the level's settings
    sky: bool = False  # the value is an expression of shaders/cloud_view.glsl, over the whole picture

    @property
    def mapped(self) -> bool:
        """Whether it says something of places in the world alone, so that it can be drawn from above."""
        return bool(self.value) and not self.sky and not _OF_PIXELS.search(self.value)

    @property
    def inset(self) -> bool:
        """Whether it can be an inset: not where the scene itself is drawn differently for it."""
        return (
            bool(self.value) and not self.scene and not self.sky and not self.settings and self.name not in _OWN_SCENE
        )

    def changed(self, settings: Settings) -> Settings:
        """A level's settings as the view shows them."""
        for path, value in self.settings:
            settings = replace(settings, path, value)
        return settings
