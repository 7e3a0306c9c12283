"""Extremes look strange, never broken: every number of the picture at the ends of its range, alone and all at once."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level import Settings
from shorewright.level.params import describe, replace
from shorewright.renderer import Renderer

pytestmark = pytest.mark.gl
SIZE, TIME_S = (64, 36), 12.0
SECTIONS = ("light", "fog", "ground", "wet", "scatter", "water", "sea", "shore")
ROWS = {row.name: row for row in describe(Settings) if row.name.split(".")[0] in SECTIONS}
NUMBERS = [name for name, row in ROWS.items() if row.kind in ("float", "int")]
CHOICES = [name for name, row in ROWS.items() if row.kind in ("choice", "bool")]
BLACK = 6.0  # mean of the display below which nothing is seen

# What must be set for a number to count.
DATE = {"light.sun_from": "date", "light.hour": 12.0}
WITH = {f"light.{name}": DATE for name in ("month", "day", "hour", "utc_offset_h", "latitude_deg", "longitude_deg")}
WITH["light.hour"] = {"light.sun_from": "date"}
WITH["light.cloud_depth"] = {"light.cloud_cover": 1.0}
WITH["fog.height_m"] = {"fog.density": 0.004}
# Darkness that is meant: the sun far below the horizon, or a lens that is shut.
DARK = {
    "light.exposure_ev": (22.0,),
    "light.sun_elevation_deg": (-20.0,),
    "light.hour": (0.0, 24.0),
    "light.utc_offset_h": (-14.0, 14.0),
    "light.longitude_deg": (-180.0, 180.0),
    "light.latitude_deg": (-90.0,),
}
CAMERAS = {
    "shore": camera(y=90.0, z=12.0, pitch=-12.0),
    "sun": camera(y=120.0, z=2.0, pitch=5.0, yaw=235.0),
    "down": camera(z=40.0, pitch=-70.0, yaw=100.0),
}


@pytest.fixture(scope="module")
def scene(ctx):
    renderer = Renderer(ctx)
    yield coast(rock=6.0), renderer
    renderer.release()


def draw(scene, settings, at="shore", quality="low", time_s=TIME_S):
    """Linear light and display of one drawing."""
    level, renderer = scene
    level.set_settings(settings)
    renderer.draw(level, CAMERAS[at], SIZE, time_s, quality=quality, scale=1.0)
    return renderer.read(linear=True), renderer.read()


def changed(values):
    settings = Settings()
    for name, value in values.items():
        settings = replace(settings, name, value)
    return settings


@pytest.mark.parametrize("name", NUMBERS)
def test_a_number_at_the_ends_of_its_range(scene, name):
    """L01 to L07, L09, D10, D38, H05: no NaN, no black frame, at hard and soft ends; dark only where that is meant."""
    row = ROWS[name]
    for value in {row.low, row.high, *(row.soft or ())}:
        linear, shown = draw(scene, changed({**WITH.get(name, {}), name: value}))
        assert np.isfinite(linear).all(), value
        assert linear.min() >= 0, value
        dark = value in DARK.get(name, ())
        assert (shown.mean() < BLACK) == dark, (value, shown.mean())


@pytest.mark.parametrize("seed", range(16))
def test_many_numbers_at_their_ends_at_once(scene, seed):
    """Half of all numbers low or high, choices at random: every pixel finite from three places, in two tiers."""
    rng = np.random.default_rng(seed)
    values = {}
    for name in NUMBERS:
        if rng.random() < 0.5:
            values[name] = (ROWS[name].low, ROWS[name].high)[rng.integers(2)]
    for name in CHOICES:
        choices = ROWS[name].choices or (True, True, False)
        values[name] = choices[rng.integers(len(choices))]
    quality, time_s = ("low", "medium")[seed % 2], (0.0, TIME_S, 1e6)[seed % 3]
    for at in CAMERAS:
        linear, _ = draw(scene, changed(values), at, quality, time_s)
        assert np.isfinite(linear).all(), at
        assert linear.min() >= 0, at


def test_what_is_called_dark_is_a_setting_that_is_tried():
    for name, values in DARK.items():
        assert set(values) <= {ROWS[name].low, ROWS[name].high}
    assert set(WITH) <= set(NUMBERS)
