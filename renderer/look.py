"""Values of every uniform that the GLSL in `shaders/lib` declares (samplers excepted), from settings and a time."""

from __future__ import annotations

import math

import numpy as np

from ..level import Settings
from ..level.earth import GRAVITY
from ..level.foam_uniforms import foam_uniforms
from ..level.gerstner import groups
from ..level.loop import FOAM_CYCLES, RIPPLES, looped, moment, ripple_period_s, turns
from ..level.settings import Sea
from ..level.sun import light_angles
from ..level.water_optics import absorption, backscatter, river_added
from .day_light import exposure_ev, white_k
from .sky_light import SkyLight, sky_light

DISPLAYS = ("agx", "aces", "neutral", "raw")
STAR_LIGHT = 0.0015  # kcd/m² of the brightest stars, spread over 1.4 minutes of arc
RIPPLE_SPREAD = np.array([0.7955, 0.2045])  # of the texture's slope variance: along its own way, across
LEAST_SLOPE2 = 2e-4  # no sea is a mirror


def sun_direction(azimuth_deg: float, elevation_deg: float) -> np.ndarray:
    """Unit vector towards the sun, `(3,)`: x east, y north, z up."""
    azimuth, elevation = math.radians(azimuth_deg), math.radians(elevation_deg)
    flat = math.cos(elevation)
    return np.array([flat * math.sin(azimuth), flat * math.cos(azimuth), math.sin(elevation)])


def exposure_scale(ev100: float) -> float:
    """Factor on radiance in kcd/m², the same as `lib/display.glsl`'s."""
    return 1000.0 / (1.2 * 2.0**ev100)


def white_balance(kelvin: float) -> np.ndarray:
    """Gains `(3,)` on linear Rec. 709 that show light of this colour temperature as white, 1 at 5600 K."""
    gains = _planck(5600) / _planck(kelvin)
    return gains / gains[1]


def _planck(kelvin: float) -> np.ndarray:
    """Colour of a black body at the wavelengths of the primaries, `(3,)`; relative (Planck's law)."""
    metres = np.array([611e-9, 549e-9, 464e-9])  # centroids of Rec. 709 red, green, blue
    return 1 / (metres**5 * np.expm1(0.0143877688 / (metres * kelvin)))


def _sky(sky) -> dict:
    """Uniform vectors of a SkyLight, by name without `u_`."""
    return {
        "sun_illuminance": sky.sun,
        "sun_mean": sky.mean_sun,
        "sun_disc": sky.disc,
        "sky_sh": sky.harmonics,
        "deck": sky.deck,
        "air": sky.air,
        "air_haze": sky.haze,
        "fog_radiance": sky.fog,
    }


def ripple_slopes(sea: Sea, seed: int) -> np.ndarray:
    """Mean square slope of the ripples along and across the wind, `(2,)`.

    What Cox & Munk (1954) measured for the wind, 0.00316 U along and 0.003 + 0.00192 U across, less what the Gerstner
    waves carry already, so that mesh, normals and roughness add up to the whole at every distance. A swell steeper than
    the wind's sea stays as it is: then ripples are down to the least.
    """
    heading = math.radians(sea.swell_heading_deg)
    measured = np.array([0.00316 * sea.wind_mps, 0.003 + 0.00192 * sea.wind_mps])
    return np.maximum(measured - wave_slopes(sea, seed, heading).sum(axis=0), LEAST_SLOPE2)


def wave_slopes(sea: Sea, seed: int, heading: float) -> np.ndarray:
    """Mean square slope of chop and swell `(2, 2)`: a row each, along and across the heading (radians)."""
    rows = []
    for fronts in groups(sea, seed):
        steep = fronts.amplitude_m * 2 * np.pi / fronts.length_m
        along = fronts.east * math.sin(heading) + fronts.north * math.cos(heading)
        rows.append([np.sum((steep * along) ** 2) / 2, np.sum(steep**2 * (1 - along**2)) / 2])
    return np.array(rows) * float(sea.on)


def _ripples_moved(tile_m: float, loop_s: float, time_s: float) -> float:
    """Tiles of ripples that have gone by."""
    if loop_s > 0:
        return -moment(time_s, loop_s) / looped(ripple_period_s(tile_m), loop_s)
    return -math.sqrt(GRAVITY * tile_m / 5 / (2 * math.pi)) * time_s / tile_m


def _ripples(settings: Settings, time_s: float) -> dict:
    sea = settings.sea
    target = ripple_slopes(sea, settings.level.seed)
    made = np.zeros(2)  # what the three turned textures have along and across the wind, at a total of 1
    way, size = [], []
    for tile, turn_deg, share in RIPPLES:
        heading = math.radians(90.0 - sea.swell_heading_deg + turn_deg)
        moved = _ripples_moved(tile, settings.time.loop_s, time_s)
        way.append((math.cos(heading), math.sin(heading), moved - math.floor(moved), 0.173 * tile % 1.0))
        size.append((tile, math.sqrt(share)))
        turned = math.cos(math.radians(turn_deg)) ** 2, math.sin(math.radians(turn_deg)) ** 2
        made += share * np.array([np.dot(turned, RIPPLE_SPREAD), np.dot(turned, RIPPLE_SPREAD[::-1])])
    heading = math.radians(sea.swell_heading_deg)
    return {
        "u_ripple_way": np.array(way, np.float32),
        "u_ripple_size": np.array(size, np.float32),
        "u_ripple_gain": (*np.sqrt(target / made), target.sum()),
        "u_wind_spread": tuple(target / target.sum()),
    }


def _rivers(settings: Settings, time_s: float) -> dict:
    """The cycle of what rivers carry, and what colours their water."""
    loop_s, asked_s = settings.time.loop_s, settings.river.interval_s
    interval_s = looped(asked_s, loop_s)
    cycles = moment(time_s, loop_s) / interval_s
    whole = math.floor(cycles)
    absorb, back = river_added(settings.river)
    return {
        "u_river_cycle": (cycles - whole, whole % FOAM_CYCLES, interval_s if settings.flow.on else 0.0),
        "u_river_turns": float(turns(asked_s, loop_s)),
        "u_river_absorb": absorb.astype(np.float32),
        "u_river_back": back.astype(np.float32),
    }


def look_uniforms(settings: Settings, time_s: float, sky: SkyLight | None = None) -> dict[str, float | np.ndarray]:
    """Every `u_…` of `shaders/lib/*.glsl` but samplers, at `time_s` seconds."""
    light, fog, water, ground = (getattr(settings, name) for name in ("light", "fog", "water", "ground"))
    sky = sky or sky_light(settings, time_s)
    return {
        "u_sun_direction": sun_direction(*light_angles(light, time_s)).astype(np.float32),
        **{f"u_{name}": value.astype(np.float32) for name, value in _sky(sky).items()},
        "u_fog_share": sky.fog_share,
        "u_sky_cover": sky.cover,
        "u_cirrus": float(not sky.even),
        "u_star_light": STAR_LIGHT * sky.unit if sky.unit > 1 else 0.0,
        "u_exposure": exposure_scale(exposure_ev(settings, time_s)) / sky.unit,
        "u_white": white_balance(white_k(settings, time_s)).astype(np.float32),
        "u_display": DISPLAYS.index(light.display),
        "u_fog_density": fog.density if fog.on and not sky.even else 0.0,
        "u_fog_height_m": fog.height_m,
        "u_absorb": absorption(water).astype(np.float32),
        "u_backscatter": backscatter(water).astype(np.float32),
        "u_ground_sand_top_m": ground.sand_top_m,
        "u_ground_rock_slope": math.tan(math.radians(ground.rock_slope_deg)),
        "u_ground_grass_slope": math.tan(math.radians(ground.grass_slope_deg)),
        **_ripples(settings, time_s),
        **foam_uniforms(settings, time_s),
        **_rivers(settings, time_s),
    }
