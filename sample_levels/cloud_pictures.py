"""What docs/clouds.md shows: shots of one sky stage by stage, of types and weathers, and a storm that rolls in."""

from __future__ import annotations

from pictures import LAYER, SMALL, Shot

SKY = "500,200,30,300,18"
AIR = {"clouds.on": True, "weather.painted": False}
HALF = {**AIR, "weather.coverage": 0.3, "weather.type": 1.0, "weather.variety": 0.4}
FAIR = {**AIR, "weather.coverage": 0.36, "weather.type": 1.0}
ON_ITS_WAY = {
    **AIR, "weather.coverage": 0.25, "weather.type": 1.0, "storm.chance": 1.0, "storm.distance_m": 16_000.0,
    "weather.wind_mps": 30.0, "weather.heading_deg": 70.0,
}  # fmt: skip
NOISES = (
    "cloud_perlin", "cloud_worley", "cloud_perlin_worley", "cloud_worley_2", "cloud_worley_3", "cloud_detail_1",
    "cloud_detail_2", "cloud_detail_3", "cloud_curl", "cloud_profile",
)  # fmt: skip
STAGES = (
    "cloud_height", "cloud_coverage", "cloud_thin", "cloud_eroded", "cloud_inverted", "cloud_curled", "cloud_alpha",
    "cloud_unlit", "cloud_cone", "cloud_beer", "cloud_phase", "cloud_powder", "cloud_rain", "cloud_depth",
    "cloud_samples",
)  # fmt: skip
TYPES = {
    "stratus": {"weather.type": 0.0, "weather.coverage": 0.75},
    "stratocumulus": {"weather.type": 0.5, "weather.coverage": 0.65},
    "cumulus": {"weather.type": 1.0, "weather.coverage": 0.45},
}
CLOUDS = (
    *(Shot(f"clouds/{view}", "cove", SKY, 14.0, "noon", view, LAYER, HALF) for view in (*NOISES, *STAGES)),
    *(
        Shot(f"clouds/{name}", "cove", SKY, 14.0, "noon", "final", LAYER, {**AIR, "weather.variety": 0.3, **values})
        for name, values in TYPES.items()
    ),
    # seen from aside: below one there is only rain
    Shot("clouds/cumulonimbus", "cove", "500,200,30,250,5", 60.0, "noon", "final", LAYER, ON_ITS_WAY),
    *(
        Shot(f"clouds/cover-{round(100 * cover)}", "cove", SKY, 14.0, "noon", "final", LAYER,
             {**AIR, "weather.coverage": cover, "weather.type": 1.0})
        for cover in (0.2, 0.4, 0.6, 0.8)
    ),
    Shot("clouds/fair", "cove", "640,395,8,250,9", 14.3, "noon", size="1280x720", settings=FAIR),
    Shot("clouds/sunset", "cove", "560,432,5,262,9", 14.3, "golden_hour", size="1280x720",
         settings={**FAIR, "weather.coverage": 0.45}),
    *(
        Shot(f"clouds/storm-{number}", "cove", "620,470,7.2,250,8", time_s, "noon", size=SMALL,
             settings={**ON_ITS_WAY, **FAIR})
        for number, time_s in enumerate((60.0, 240.0, 420.0, 600.0), 1)
    ),
)  # fmt: skip
