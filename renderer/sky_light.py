"""What shines on a level: sun or moon, sky, cloud layer, haze, from its settings (L02).

`sky_light` gives everything that shaders need of it, in kcd/m² and klx times `unit`, a power of two that lifts the
light of a night to where half floats still have steps; exposure and EXR take it out again.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from ..level import Settings
from ..level.sun import day_runs, sun_place
from .air import GROUND_ALBEDO, air_extinction
from .overcast import Overcast
from .sky_table import AERIAL, AERIAL_FIRST_KM, AERIAL_RATIO, COLUMNS, ROWS, aerial_table, sky_table, sun_illuminance

# Full moon over sun: 0.27 lx against 128 klx (Krisciunas & Schaefer 1991, V = −12.7 against −26.7)
MOON = 10 ** (-0.4 * (26.74 - 12.74)) * np.array([1.06, 1.0, 0.92])
NIGHT = np.array([0.55, 0.75, 1.2]) * 4e-7  # airglow and starlight, kcd/m²
CLOUD_G = 0.85  # how far cloud droplets scatter forward
FOG_ALBEDO = 0.99
DECK_TINT = np.array([0.98, 1.0, 1.03])
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


@dataclass(frozen=True, eq=False)
class SkyLight:
    """Light of a level, times `unit`.

    `sun` `(3,)` klx on a plane facing it under cloud and fog, `table` `(96, 64, 3)` clear sky, `deck` `(3,)` the cloud
    layer at the zenith, `harmonics` `(9, 3)` irradiance, `aerial` `(16, 16, 32, 3)`, `fog` `(3,)` light inside the fog,
    `fog_share` 0 … 1 how far that replaces the sky's; `air` and `haze` `(3,)` extinction 1/m.
    """

    unit: float
    elevation_deg: float
    sun: np.ndarray
    disc: np.ndarray  # illuminance of the disc as seen, without cloud
    table: np.ndarray
    deck: np.ndarray
    harmonics: np.ndarray
    aerial: np.ndarray
    air: np.ndarray
    haze: np.ndarray
    fog: np.ndarray
    fog_share: float
    even: bool = False
    mean_sun: np.ndarray | None = None  # the sun's light on the whole land, the shadows of clouds counted in
    above: np.ndarray | None = None  # the clear sky's mean radiance
    cover: float = 0.0  # of the sky by clouds

    def on_level(self, sine: float) -> np.ndarray:
        """Irradiance on a level plane under a sun whose elevation has this sine, `(3,)` klx times `unit`."""
        c = self.harmonics
        return c[0] * 0.282095 + c[2] * 0.488603 + c[6] * 0.630784 + self.mean_sun * sine


def sky_light(settings: Settings, time_s: float = 0.0, overcast: Overcast | None = None) -> SkyLight:
    """The light of a level at a time; kept for what it was last asked for. `overcast`: clouds in volume hang there."""
    light = settings.light
    if light.body == "even":
        return _even()
    elevation = round(sun_place(light, time_s)[1], 4)
    sky = sky_of(settings, overcast)
    if day_runs(light):
        from .day_light import day_light

        return day_light(elevation, sky, light.moonlit)
    return made(elevation, *sky)


def sky_of(settings: Settings, overcast: Overcast | None) -> tuple:
    """All that `made` takes but the elevation."""
    light, fog = settings.light, settings.fog
    depth = fog.density * fog.height_m if fog.on else 0.0
    cover, deep = overcast or (light.cloud_cover, light.cloud_depth)
    return light.turbidity, light.body, cover, deep, min(depth, 50.0), overcast is not None


@lru_cache(maxsize=8)
def made(
    elevation: float, turbidity: float, body: str, cover: float, depth: float, fog_depth: float, volume: bool = False
) -> SkyLight:
    """The light under a sun, or moon, at an elevation in degrees; `volume`: its clouds throw shadows by themselves."""
    scale = np.ones(3) if body == "sun" else MOON
    clear = sky_table(elevation, turbidity) * scale + NIGHT
    bare = sun_illuminance(elevation, turbidity) * scale
    sine = max(math.sin(math.radians(elevation)), 0.0)
    sky_up = up_irradiance(clear)
    slant = max(sine, 0.05)
    # under the layer: what comes through straight on, and scattered (two-stream approximation, g = 0.85)
    sun = bare * (1 - cover + cover * math.exp(-min(depth / slant, 80.0)))
    under = (bare * sine + sky_up) / (1 + 0.75 * depth * (1 - CLOUD_G))
    deck = under * DECK_TINT * 9 / (7 * np.pi)  # CIE overcast sky: a third as bright at the horizon as at the zenith
    mean = clear * (1 - cover) + deck_table(deck) * cover
    fog_sun = math.exp(-min(fog_depth / slant, 80.0))
    down = sun * sine + up_irradiance(mean)
    lit = down / (1 + 0.75 * fog_depth * (1 - CLOUD_G))
    share = 1 - math.exp(-3 * fog_depth)  # seen along the ground a layer is far deeper than it is high
    fog = FOG_ALBEDO * 0.55 * down / np.pi  # half from above, half from the ground's share of it
    sun = sun * fog_sun
    shone = bare * fog_sun if volume else sun  # their shadows fall on each place by themselves (Z19)
    dim = math.exp(-fog_depth)
    mean = mean * dim + (lit - sun * sine - up_irradiance(mean) * dim).clip(0) / np.pi
    reference = max(float(bare @ LUMINANCE), float(up_irradiance(mean) @ LUMINANCE), 1e-9)
    unit = unit_of(reference)
    aerial = aerial_table(elevation, turbidity) * scale * (1 - cover)
    aerial = (aerial + cover * _aerial_under(deck, turbidity)) * unit
    harmonics = irradiance_harmonics(mean, sun, sine) * unit
    return SkyLight(
        unit, elevation, shone * unit, bare * unit, (clear * unit).astype(np.float32), deck * unit, harmonics,
        aerial.astype(np.float32), *air_extinction(turbidity), fog * unit, share,
        mean_sun=sun * unit, above=up_irradiance(clear) / np.pi * unit, cover=cover,
    )  # fmt: skip


def unit_of(klx: float) -> float:
    """The power of two that lifts so much light to where half floats have steps; 1 by day."""
    return 2.0 ** round(math.log2(16 / klx)) if klx < 1 else 1.0


@lru_cache(maxsize=1)
def _even() -> SkyLight:
    """White light of 1 kcd/m² from all sides, in air that isn't there: the furnace (L01)."""
    ones, none = np.ones(3), np.zeros(3)
    harmonics = np.zeros((9, 3))
    harmonics[0] = np.pi / 0.282095
    table = np.ones((ROWS, COLUMNS, 3), np.float32)
    return SkyLight(
        1.0,
        90.0,
        none,
        none,
        table,
        ones,
        harmonics,
        np.zeros((*AERIAL, 3), np.float32),
        none,
        none,
        ones,
        0.0,
        True,
        none,
        ones,
    )


def deck_table(deck: np.ndarray) -> np.ndarray:
    """The cloud layer as a sky table `(96, 1, 3)`; `lib/sky.glsl` has the same formula."""
    sine = np.sin((np.arange(ROWS) / (ROWS - 1)) ** 2 * np.pi / 2)
    return (deck * ((1 + 2 * sine) / 3)[:, None])[:, None, :]


def _aerial_under(deck: np.ndarray, turbidity: float) -> np.ndarray:
    """Light that air under a closed layer adds, `(16, 16, 1, 3)`: that of the layer from all sides."""
    distance = 1000 * AERIAL_FIRST_KM * AERIAL_RATIO ** np.arange(AERIAL[0])
    extinction = np.add(*air_extinction(turbidity))
    share = 1 - np.exp(-distance[:, None] * extinction)
    share[-1] = 1
    sine = np.sin((np.arange(AERIAL[1]) / (AERIAL[1] - 1)) ** 2 * np.pi / 2)
    return share[:, None, None, :] * deck * ((1 + 2 * sine) / 3)[None, :, None, None]


@lru_cache(maxsize=1)
def _solid() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Solid angle of each texel of a sky table `(96, 64)` (both halves), its elevation and azimuth."""
    v = (np.arange(ROWS) / (ROWS - 1)) ** 2 * np.pi / 2
    phi = np.arange(COLUMNS) / (COLUMNS - 1) * np.pi
    solid = np.gradient(v)[:, None] * np.cos(v)[:, None] * np.gradient(phi)[None, :] * 2
    solid[:, [0, -1]] *= 0.5
    elevation, azimuth = np.meshgrid(v, phi, indexing="ij")
    return solid * (2 * np.pi / solid.sum()), elevation, azimuth


def up_irradiance(table: np.ndarray) -> np.ndarray:
    """Irradiance of a sky table `(96, 64 or 1, 3)` on level ground, klx `(3,)`."""
    solid, elevation, _ = _solid()
    weight = solid * np.sin(elevation)
    weight *= np.pi / weight.sum()  # an even sky of 1 gives π
    return (np.broadcast_to(table, (ROWS, COLUMNS, 3)).astype(np.float64) * weight[..., None]).sum((0, 1))


def irradiance_harmonics(table: np.ndarray, sun: np.ndarray, sun_sine: float) -> np.ndarray:
    """Irradiance of sky and lit ground, nine spherical-harmonic coefficients `(9, 3)` klx.

    Convolved with the cosine lobe (Ramamoorthi & Hanrahan 2001); x points to the sun's azimuth, z up.
    """
    solid, elevation, azimuth = _solid()
    below = (up_irradiance(table) + max(sun_sine, 0) * sun) * GROUND_ALBEDO / np.pi
    x, y, z = np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)
    full = np.broadcast_to(table, (ROWS, COLUMNS, 3)).astype(np.float64)
    result = np.zeros((9, 3))
    for radiance, height in ((full, z), (np.broadcast_to(below, full.shape), -z)):
        for i, value in enumerate(_basis(x, y, height)):
            if i in (1, 4, 5):  # odd in y: the other half of the sky cancels them
                continue
            result[i] += (radiance * (solid * value)[..., None]).sum((0, 1))
    lobe = np.array([np.pi, *[2 * np.pi / 3] * 3, *[np.pi / 4] * 5])
    return result * lobe[:, None]


def _basis(x, y, z) -> tuple:
    """Real spherical harmonics to order 2."""
    return (
        0.282095 + 0 * x,
        0.488603 * y,
        0.488603 * z,
        0.488603 * x,
        1.092548 * x * y,
        1.092548 * y * z,
        0.315392 * (3 * z * z - 1),
        1.092548 * x * z,
        0.546274 * (x * x - y * y),
    )
