"""The light of a day that runs (Z25): that of sky_light.py at steps of the sun's elevation, blended between them.

At night the moon's is added. The full moon stands opposite the sun, so that a table by the azimuth from the one is the
other's read from its end.
"""

from __future__ import annotations

import math
from dataclasses import fields
from functools import lru_cache

import numpy as np

from ..level import Settings
from ..level.sun import MOON_BELOW_DEG, day_runs, highest_deg, sun_place
from .light_ahead import step_light
from .sky_light import LUMINANCE, SkyLight, sky_light, sky_of, unit_of

LOWEST_DEG = -20.0  # from there on nothing of the sun is left
LOW_DEG, LOW_STEP_DEG, STEP_DEG = 3.0, 0.25, 0.5  # about the horizon light changes the most
MOON_WHOLE_DEG = -6.0  # elevation of the sun at which the moon has come up to its own light
NIGHT_LUX = 1.0, 0.05  # light of late dusk and of a low full moon, between which colours turn to those of night
NIGHT_WHITE = 0.78  # of the temperature that shows as white by day
NIGHT_START_DEG = -6.0  # of the sun: a day that begins with it so low begins at night
# By moonlight rods see more than cones do: little colour, and what there is looks blue (Purkinje's shift; Jensen et
# al., Night Rendering, 2000). Without it the low moon would light clouds brown, as it does for a camera.
RODS = 0.75  # share of what is seen by moonlight that they see
ROD_BLUE = np.array([0.72, 1.0, 1.55])
SCALED = ("sun", "disc", "table", "deck", "harmonics", "aerial", "fog", "mean_sun", "above")  # what is times `unit`
ODD = (3, 7)  # harmonics that change sign with the azimuth


@lru_cache(maxsize=16)
def day_light(elevation_deg: float, sky: tuple, moonlit: bool) -> SkyLight:
    """Light under a sun at an elevation; `sky` is all else that `made` takes."""
    light = _between(elevation_deg, sky)
    if not moonlit or sky[1] != "sun" or elevation_deg >= MOON_BELOW_DEG:
        return light
    return _with_moon(light, _between(-elevation_deg, (sky[0], "moon", *sky[2:])), elevation_deg)


def _between(elevation_deg: float, sky: tuple) -> SkyLight:
    """The light between two steps, so weighted that its amount goes by equal shares, as at dusk."""
    at = max(elevation_deg, LOWEST_DEG)
    below, above = steps_about(at)
    low, high = step_light(below, sky), step_light(above, sky)
    share = (at - below) / step_deg(at)
    ratio = amount(high) / amount(low)
    if abs(ratio - 1) > 1e-6:
        share = (ratio**share - 1) / (ratio - 1)
    return _sum(elevation_deg, ((low, 1 - share), (high, share)))


def step_deg(elevation_deg: float) -> float:
    """How far apart steps are there."""
    return LOW_STEP_DEG if abs(elevation_deg) < LOW_DEG else STEP_DEG


def steps_about(elevation_deg: float) -> tuple[float, float]:
    """The steps below and above an elevation."""
    step = step_deg(elevation_deg)
    below = math.floor(elevation_deg / step) * step
    return below, min(below + step, 90.0)


def _with_moon(sun: SkyLight, moon: SkyLight, sun_elevation_deg: float) -> SkyLight:
    """Both lights, by the azimuth from the moon, which comes up over the dusk by and by."""
    risen = _eased((sun_elevation_deg - MOON_BELOW_DEG) / (MOON_WHOLE_DEG - MOON_BELOW_DEG))
    harmonics = sun.harmonics.copy()
    harmonics[list(ODD)] *= -1
    turned = _like(sun, table=sun.table[:, ::-1], aerial=sun.aerial[:, :, ::-1], harmonics=harmonics)
    return _sum(moon.elevation_deg, ((turned, 1.0), (by_rods(moon), risen)))


def by_rods(light: SkyLight) -> SkyLight:
    """A light as eyes see it that are used to the dark: as bright, less coloured."""
    blue = ROD_BLUE / float(ROD_BLUE @ LUMINANCE)
    values = {}
    for name in SCALED:
        value = getattr(light, name)
        values[name] = value * (1 - RODS) + (value @ LUMINANCE)[..., None] * blue * RODS
    return _like(light, **values)


def _sum(elevation_deg: float, parts: tuple[tuple[SkyLight, float], ...]) -> SkyLight:
    """Lights times their weights; what is no light comes from the first and its share of the second."""
    total = {name: sum(getattr(p, name) * (w / p.unit) for p, w in parts) for name in SCALED}
    reference = max(float(total["disc"] @ LUMINANCE), float(total["harmonics"][0] @ LUMINANCE) * 0.282095, 1e-9)
    unit = unit_of(reference)
    total = {name: value * unit for name, value in total.items()}
    for name in ("table", "aerial"):
        total[name] = total[name].astype(np.float32)
    return _like(parts[0][0], unit=unit, elevation_deg=elevation_deg, **total)


def _like(light: SkyLight, **values) -> SkyLight:
    return SkyLight(**{row.name: values.get(row.name, getattr(light, row.name)) for row in fields(light)})


def amount(light: SkyLight) -> float:
    """Luminous part of what falls on level ground, klx."""
    sine = max(math.sin(math.radians(light.elevation_deg)), 0.0)
    return max(float(light.on_level(sine) @ LUMINANCE) / light.unit, 1e-12)


def exposure_ev(settings: Settings, time_s: float) -> float:
    """The exposure at a time: that of the settings for the light they mean it for, and as light goes, so it goes."""
    light = settings.light
    if not day_runs(light) or light.body == "even":
        return light.exposure_ev
    return light.exposure_ev + light.adapt * math.log2(amount(sky_light(settings, time_s)) / _meant_for(settings))


def _meant_for(settings: Settings) -> float:
    """The light that the exposure is set for, klx: that of time zero, or if it is night then, of the date's noon."""
    light, start = settings.light, amount(sky_light(settings, 0.0))
    night = _eased(sun_place(light, 0.0)[1] / NIGHT_START_DEG)
    if night == 0 or light.adapt_from == "start":
        return start
    noon = amount(day_light(round(highest_deg(light), 4), sky_of(settings, None), light.moonlit))
    return start ** (1 - night) * noon**night


def white_k(settings: Settings, time_s: float) -> float:
    """What shows as white at a time: at night less, for eyes see moonlight blue (Purkinje's shift)."""
    light = settings.light
    if not day_runs(light) or light.body == "even":
        return light.white_k
    brightest, darkest = (math.log10(lux / 1000) for lux in NIGHT_LUX)
    t = (math.log10(amount(sky_light(settings, time_s))) - brightest) / (darkest - brightest)
    return light.white_k * (1 - (1 - NIGHT_WHITE) * _eased(t))


def _eased(t: float) -> float:
    """0 … 1 as GLSL's smoothstep goes."""
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)
