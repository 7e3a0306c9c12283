"""MAPS: what a level has beside its ground that a game can read as a picture, one row each.

A row makes its samples from the level (map_makers.py; None where the level has nothing of it) and names the code for
them; how they get into a file, for which target in which format, is map_files.py's.
"""

from __future__ import annotations

from . import map_ground, map_timing
from . import map_makers as make
from .map_makers import MapRow
from .records import Channel

MASKS = ("puddle_keepout", "shelter", "snow", "ice", "corruption", "yielding", "quiet", "mouth", "cover", "scatter")


def _c(name: str, meaning: str, unit: str = "", neutral: float | None = None) -> Channel:
    return Channel(name=name, meaning=meaning, unit=unit, neutral=neutral)


MAPS: dict[str, MapRow] = {
    row.name: row
    for row in (
        MapRow("normals", "Normals of the ground, unit length.",
               (_c("east", "normal's part to the east", "", 0), _c("north", "normal's part to the north", "", 0),
                _c("up", "normal's part upwards", "", 1)),
               make.normals, "signed", green=1, follows=("height",)),
        MapRow("flow16", "The whole current in 16 bits: shore, points, rivers, jets, paint; exactly 0 where still.",
               (_c("east", "current to the east", "m/s", 0), _c("north", "current to the north", "m/s", 0)),
               make.flow, "signed", north=1),
        make.painted("foam"),
        MapRow("river", "Water that isn't the sea, rivers and lakes: its level over the level's zero, and where it is.",
               (_c("level", "level of the water", "m"), _c("share", "1 in such water, 0 outside", "", 0)),
               make.river),
        make.painted("river_foam"),
        MapRow("shore", "Shore map: R signed distance, G B the way to the shore, A height of the beach.",
               (_c("distance", "metres to the shoreline, sea above 0, land below", "m"),
                _c("east", "to the shore, its part to the east", "", 0),
                _c("north", "to the shore, its part to the north", "", 0),
                _c("beach", "beach over the still sea, 2 m either way", "m")),
               make.shore, bits=8, north=2),
        MapRow("arrival", "When a crest passes, by swell: seconds of the level's clock; −60000 where no wave stands. "
               "Crest n passes at value + n × period_s.",
               (_c("first", "arrival of the leading swell", "s"), _c("second", "arrival of the second swell", "s"),
                _c("third", "arrival of the third swell", "s")),
               map_timing.arrivals, "float"),
        MapRow("front_phase", "Where in its period the leading swell's front is at clock time 0; 1: there is none; "
               "at t it is the fraction of value + t / period_s.",
               (_c("phase", "share of the period since the crest passed", ""),),
               map_timing.front_phase),
        MapRow("walkable", "Wading depth over a period of the waves, and up to which still sea one can walk there.",
               (_c("least", "least depth over a period", "m", 0), _c("most", "greatest depth over a period", "m", 0),
                _c("tide", "highest still sea at which one walks there; the low end: never", "m")),
               map_timing.walkable),
        MapRow("weather_map", "The sky at clock time 0, simulated and painted: 70 km round the level's middle, tiling.",
               (_c("coverage", "share of the sky under cloud"), _c("precipitation", "rain or snow"),
                _c("type", "0 stratus, 1 cumulus")),
               make.weather("ours"), bits=8),
        MapRow("weather_hdrp", "The same for HDRP's cloud map: coverage, rain, and where in the cloud lookup table.",
               (_c("coverage", "coverage"), _c("rain", "rain"), _c("type", "u of the cloud lookup table")),
               make.weather("hdrp"), bits=8),
        MapRow("cover_weights", "Ground by rule and paint, as it is drawn: four of eight weights; their sum is 1.",
               tuple(_c(name, f"weight of {name}") for name in ("sand", "shingle", "strata", "reef")),
               map_ground.weights(0), bits=8),
        MapRow("cover_weights_2", "The other four weights of the ground.",
               tuple(_c(name, f"weight of {name}") for name in ("grass", "dune grass", "sea floor", "weed")),
               map_ground.weights(4), bits=8),
        MapRow("puddles", "How deep rain stands where it has filled every hollow; none in the sea and in rivers.",
               (_c("depth", "depth of the water", "m", 0),),
               map_ground.puddles),
        *(make.painted(name) for name in MASKS),
    )
}  # fmt: skip


def told() -> tuple[tuple[str, str], ...]:
    """(name, sentence) of every row, for a target's list of what it writes."""
    return tuple((row.name, row.doc) for row in MAPS.values())
