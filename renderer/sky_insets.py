"""SKY_INSETS: the weather map after each of its stages, seen from above in a corner of any picture (Z04)."""

from __future__ import annotations

from ..level.weather import STAGES
from .views import VIEWS, View, find_view

# red coverage, green precipitation, blue type
SKY_INSETS: dict[str, View] = {
    "weather_map": View(
        "weather_map", "Weather map", "The sky from above as it is drawn, 70 km: red coverage, green precipitation, "
        "blue type; the level's border, the camera, the wind.", "sky", "direct", ids="Z04",
    )
} | {
    f"weather_{stage}": View(
        f"weather_{stage}", f"Weather: {stage}", f"The weather map of stage {stage}, from above.", "sky", "direct",
        ids="Z04 Z05",
    )
    for stage in STAGES
}  # fmt: skip


def stage_of(name: str) -> str:
    """The stage that an inset of SKY_INSETS shows."""
    return "final" if name == "weather_map" else name.removeprefix("weather_")


def find_inset(name: str) -> View:
    """The row of what a corner can show; BadInput names the list when there is none of that name."""
    return SKY_INSETS.get(name) or find_view(name)


def inset_views() -> dict[str, View]:
    """All that a corner can show, by name."""
    return {name: view for name, view in VIEWS.items() if view.inset} | SKY_INSETS
