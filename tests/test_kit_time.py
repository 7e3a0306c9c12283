"""The runtime kit over time: phases, the tide, weather keys (T09, T05, D36)."""

import numpy as np
import pytest
from kit_parts import LEVELS, asked, plain, run_c, run_sky
from kit_shaders import run_hlsl
from shorewright.io.export.kit.data import uniforms_at
from shorewright.io.export.kit.files import sources
from shorewright.io.export.kit.numbers import numbers
from shorewright.level.objects import WeatherKey
from shorewright.level.wave_uniforms import wave_uniforms
from shorewright.level.waves import surface_at
from shorewright.level.weather import weather_at


def tidal(**settings):
    level = plain()
    level.set("tide.on", True)
    level.set("tide.period_s", 300.0)
    level.set("tide.high_s", 40.0)
    level.set("tide.curve", (0.0, 1.0, 0.3, 0.2, 0.55, 0.0))
    for name, value in settings.items():
        level.set(name.replace("__", "."), value)
    return level


def keyed():
    level = plain()
    level.put_object("k", WeatherKey(id="k", x=0, y=0, time_s=100.0, fade_s=60.0, weather="gale"))
    level.put_object("l", WeatherKey(id="l", x=0, y=0, time_s=400.0, fade_s=30.0, weather="calm"))
    return level


@pytest.mark.parametrize("name", LEVELS)
def test_phases_of_the_kit_are_the_levels(name):
    """T09: what the json's formulas make of the uniforms is what the editor gives its own shaders, after a week too."""
    level = LEVELS[name]()
    data = sources(level, "test").data
    assert data.held == {}
    for t in (12.34, 604_801.5):
        its = wave_uniforms(level, t)
        for key, value in uniforms_at(data, t).items():
            if key not in its:
                continue
            off = np.abs(np.asarray(value, np.float64) - np.asarray(its[key], np.float64))
            assert np.minimum(off, np.abs(1 - off)).max() < 2e-6, key


def off_m(level, asks, told):
    """The largest difference of positions from the twin's."""
    worst = 0.0
    for t in np.unique(asks[:, 0]):
        here = asks[:, 0] == t
        sea = surface_at(level, t, asks[here, 1], asks[here, 2])
        worst = max(worst, np.abs(told[here, :3] - np.stack([sea.x, sea.y, sea.height_m], -1)).max())
    return worst


@pytest.mark.parametrize("loop_s", [0.0, 640.0, 120.0])
def test_the_sea_follows_the_tide(loop_s, tmp_path):
    """T09: C has the tide's curve, in a loop too; one shorter than the tide stops it; nothing is held."""
    level = tidal(time__loop_s=loop_s)
    data = sources(level, "test").data
    assert data.held == {}
    assert (data.tide is None) == (loop_s == 120.0)
    asks = asked(level, [0.0, 77.7, 160.0, 299.0, 604_800.75], 300)
    told = run_c(level, asks, tmp_path)
    assert off_m(level, asks, told) < 1e-3
    means = [told[asks[:, 0] == t, 2].mean() for t in np.unique(asks[:, 0])]
    assert (np.ptp(means) > 0.3) == (loop_s != 120.0)


@pytest.mark.gl
def test_hlsl_follows_the_tide_and_keys(ctx, tmp_path):
    """T09: its `sea_at_time` has the same formulas, in float32."""
    for level in (tidal(), keyed()):
        asks = asked(level, [131.0], 200)
        outputs = ("float4(s.position, 0.0)",)
        told = run_hlsl(ctx, sources(level, "test"), 131.0, asks[:, 1:], tmp_path, "sea_surface", "Sea", outputs)
        assert off_m(level, asks, told) < 3e-3


def test_what_the_tide_changes_in_maps_is_said_to_be_held():
    """T09: under a tide times of arrival need a map for each level of the sea; the kit keeps time 0's and says so."""
    level = LEVELS["travelling"]()
    level.set("tide.on", True)
    source = sources(level, "test")
    assert "the tide" in source.data.held["u_arrival"]
    assert {"u_tide_m", "u_sea_level_m", "u_shore_clock"}.isdisjoint(source.data.held)
    assert {probe["time_s"] for probe in numbers(source)["probes"]} == {0.0}


def test_the_sea_follows_weather_keys(tmp_path):
    """T09, D36: heights of waves by straight lines between knots, whose error the json tells; lengths one by one."""
    level = keyed()
    source = sources(level, "test")
    told = numbers(source)
    error_m = told["track"]["max_error"]["u_front_size"]
    assert 0 < error_m < 2e-3
    assert source.data.held.keys() == {"u_current"}
    assert len({probe["time_s"] for probe in told["probes"]}) == 8
    asks = asked(level, [50.0, 103.3, 123.4, 130.03, 147.7, 200.0, 411.1, 1e5], 200)
    off = off_m(level, asks, run_c(level, asks, tmp_path))
    assert off < 1e-3 + 8 * error_m


def test_the_sky_follows_weather_keys(tmp_path):
    """T09, D36: coverage, wind and what it carries; the air's way is a straight line between knots."""
    level = keyed()
    level.set("clouds.on", True)
    assert sources(level, "test", "sky").data.held == {}
    rng = np.random.default_rng(4)
    camera = tuple(side / 2 for side in level.grid.extent_m)
    for t in (50.0, 123.4, 300.0, 9000.0):
        flat = np.float32(rng.uniform(-30_000, 30_000, (300, 2)))
        asks = np.column_stack([np.full(300, t), flat, np.full(300, 2000.0)]).astype(np.float64)
        twin = weather_at(level, t, asks[:, 1], asks[:, 2], camera)
        assert np.abs(run_sky(level, asks, tmp_path)[:, :4] - twin).max() < 3e-3
