"""What every object has: an id of its own, and a place in world metres."""

from __future__ import annotations

from typing import ClassVar, Self

from pydantic import Field

from .params import Section, param


class Placed(Section):
    """What every object has: an id of its own, and a place in world metres."""

    id: str = Field(pattern=r"^[A-Za-z0-9_.-]{1,64}$", description="Name, unique in the level.")
    placeless: ClassVar[bool] = False  # it stands nowhere: x and y mean nothing
    x: float = param(0.0, -1e6, 1e6, "m", "East.")
    y: float = param(0.0, -1e6, 1e6, "m", "North.")

    def moved(self, east_m: float, north_m: float) -> Self:
        """The same thing elsewhere, as a crop needs when the origin of its level moves."""
        return self if self.placeless else self.model_copy(update={"x": self.x + east_m, "y": self.y + north_m})
