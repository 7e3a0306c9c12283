"""What docs/timing.md shows: fronts read on the water, a coast before and after shaping, Pyramid Rock."""

from __future__ import annotations

from pictures import LAYER, SMALL, Shot

BAY = "470,560,130,182,-42"
SURF = "560,440,30,262,-18"
TIDE = {"tide.on": True, "tide.range_m": 2.4, "tide.period_s": 600.0}
OCEAN = {"timing.source": "travel_time", "sea.swell_length_m": 90.0, "sea.swell_heading_deg": 200.0}
DEPTH = {"timing.source": "depth"}
TIMING = (
    Shot("timing/crests", "cove", "survey", size=SMALL, fronts="crests"),
    Shot("timing/crests-depth", "cove", "survey", size=SMALL, fronts="crests", settings=DEPTH),
    Shot("timing/ghosts", "cove", "play", size=SMALL, fronts="ghosts:2:0.8,isochrones:5"),
    Shot("timing/speed", "cove", "survey", size=SMALL, fronts="speed:10,breakers"),
    Shot("timing/before", "cove", BAY, size="960x540", fronts="crests,isochrones:3"),
    Shot("timing/after", "cove+shape", BAY, size="960x540", fronts="crests,isochrones:3"),
    Shot("timing/after-surf", "cove+shape", BAY, size="960x540"),
    Shot("timing/rock", "rock", "survey", size=SMALL, fronts="crests", settings=OCEAN),
    Shot("timing/breaking", "cove", SURF, view="breaking", size=LAYER),
    Shot("timing/surf", "cove", SURF, size=LAYER),
    Shot("timing/tide_band", "cove", BAY, view="tide_band", size=LAYER, settings=TIDE),
    *(
        Shot(f"timing/tide-{name}", "cove", BAY, 14.0, size=LAYER,
             settings={**TIDE, "tide.high_s": high_s})
        for name, high_s in (("high", 14.0), ("low", 314.0))
    ),
)  # fmt: skip
# level, folder of `shorewright timing`, and what else it is asked
MAPS = (
    ("cove", "cove", ("--time", "14", "--every", "3")),
    ("rock", "rock", ("--time", "14", "--source", "travel_time", "--swell", "9,200")),
)
