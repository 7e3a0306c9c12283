"""Values of every uniform that the GLSL in `shaders/lib` declares (samplers excepted), from settings and a time."""

from __future__ import annotations

import math

import numpy as np

from ..level import Settings
from ..level.sun import light_angles
from .sky_light import sky_light

DISPLAYS = ("agx", "aces", "neutral", "raw")
GRAVITY = 9.81
FOAM_PERIOD_S = 5.0
STAR_LIGHT = 0.0015  # kcd/m² of the brightest stars, spread over 1.4 minutes of arc
# tile in metres, turn from the wind in degrees, share of the slope's variance
RIPPLES = ((17.0, -24.0, 0.40), (6.1, 31.0, 0.33), (2.3, -7.0, 0.27))


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
        "sun_disc": sky.disc,
        "sky_sh": sky.harmonics,
        "deck": sky.deck,
        "air": sky.air,
        "air_haze": sky.haze,
        "fog_radiance": sky.fog,
    }


def _ripples(settings: Settings, time_s: float) -> dict:
    sea = settings.sea
    # Ripples grow with the chop: 0.09 m of it goes with about 5 m/s of wind, whose slopes Cox & Munk measured
    wind = 1.0 + 45.0 * sea.chop_m
    variance = (0.003 + 0.00512 * min(wind, 14.0)) * float(sea.on) + 0.0006
    way, size = [], []
    for tile, turn_deg, share in RIPPLES:
        heading = math.radians(90.0 - sea.swell_heading_deg + turn_deg)
        # the texture's strongest waves are about a fifth of its tile
        speed = math.sqrt(GRAVITY * tile / 5 / (2 * math.pi))
        moved = -speed * time_s / tile
        way.append((math.cos(heading), math.sin(heading), moved - math.floor(moved), 0.173 * tile % 1.0))
        size.append((tile, math.sqrt(variance * share)))
    return {"u_ripple_way": np.array(way, np.float32), "u_ripple_size": np.array(size, np.float32)}


def _foam(settings: Settings, time_s: float) -> dict:
    water = settings.water
    cycle = time_s / FOAM_PERIOD_S
    first = cycle - math.floor(cycle)
    second = (first + 0.5) % 1.0
    weight = abs(2 * first - 1)  # the second counts fully when the first jumps back
    phases = np.array([first - 0.5, second - 0.5, weight, FOAM_PERIOD_S], np.float32)
    return {"u_foam_phase": phases, "u_foam_tile_m": water.foam_tile_m, "u_foam_amount": water.foam}


def look_uniforms(settings: Settings, time_s: float) -> dict[str, float | np.ndarray]:
    """Every `u_…` of `shaders/lib/*.glsl` but samplers, at `time_s` seconds."""
    light, fog, water, ground = (getattr(settings, name) for name in ("light", "fog", "water", "ground"))
    sky = sky_light(settings)
    return {
        "u_sun_direction": sun_direction(*light_angles(light)).astype(np.float32),
        **{f"u_{name}": value.astype(np.float32) for name, value in _sky(sky).items()},
        "u_fog_share": sky.fog_share,
        "u_star_light": STAR_LIGHT * sky.unit if sky.unit > 1 else 0.0,
        "u_exposure": exposure_scale(light.exposure_ev) / sky.unit,
        "u_white": white_balance(light.white_k).astype(np.float32),
        "u_display": DISPLAYS.index(light.display),
        "u_fog_density": fog.density if fog.on and not sky.even else 0.0,
        "u_fog_height_m": fog.height_m,
        "u_absorb": np.array([water.absorb_red, water.absorb_green, water.absorb_blue], np.float32),
        "u_scatter": water.scatter,
        "u_ground_sand_top_m": ground.sand_top_m,
        "u_ground_rock_slope": math.tan(math.radians(ground.rock_slope_deg)),
        "u_ground_grass_slope": math.tan(math.radians(ground.grass_slope_deg)),
        **_ripples(settings, time_s),
        **_foam(settings, time_s),
    }
