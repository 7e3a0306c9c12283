"""CLOUD_TYPES: skies with a name, as targets of the weather brush: its swatches (T04).

The numbers are those of the weather map before rain pulls at them (Z04): coverage, precipitation, type.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class CloudType:
    """A row; `type` runs from 0 stratus to 1 cumulus, and what rains becomes cumulonimbus by its precipitation."""

    name: str
    label: str
    coverage: float
    precipitation: float
    type: float
    doc: str

    @property
    def values(self) -> dict[str, float]:
        """Targets of the weather brush by the name of the parameter."""
        return {"coverage": self.coverage, "precipitation": self.precipitation, "type": self.type}


CLOUD_TYPES: dict[str, CloudType] = {
    row.name: row
    for row in (
        CloudType("clear", "Clear", 0.0, 0.0, 0.7, "No clouds at all: a hole in the sky."),
        CloudType("fair", "Fair cumulus", 0.27, 0.0, 1.0, "Small heaps far apart, flat below: a fine day."),
        CloudType("broken", "Broken cumulus", 0.48, 0.0, 0.95, "Heaps that nearly touch, with sun between them."),
        CloudType("stratocumulus", "Stratocumulus", 0.72, 0.0, 0.45, "A low layer of rolls and patches with gaps."),
        CloudType("stratus", "Stratus", 1.0, 0.0, 0.05, "A flat grey sheet from horizon to horizon."),
        CloudType("drizzle", "Drizzle", 1.0, 0.2, 0.1, "A thick low sheet from which a little falls."),
        CloudType("towering", "Towering cumulus", 0.5, 0.35, 1.0, "Heaps that grow high and soon will rain."),
        CloudType("showers", "Showers", 0.65, 0.75, 0.9, "Rain clouds one after the other, light between them."),
        CloudType("thunderstorm", "Thunderstorm", 0.9, 1.0, 1.0, "Cumulonimbus up to the shell's top, and heavy rain."),
    )
}
