"""Rings of raindrops on the water (D17): by the rate of rain where the camera is, seen near by, rough far away."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import Rect
from shorewright.level.loop import loop_changes
from shorewright.level.objects import Camera
from shorewright.level.rain import rain_at
from shorewright.level.rain_rings import (
    CELLS,
    Drops,
    cell_sides_m,
    cycle_s,
    drop_slope,
    mean_slope2,
    rain_drops,
    ring_slope,
    share_hit,
)
from shorewright.renderer import Show, render
from shorewright.renderer.uniforms import rain_ring_uniforms

DOWN = Camera(id="down", x=60.0, y=10.0, z=2.0, yaw_deg=0, pitch_deg=-80, fov_deg=40)
HIGH = Camera(id="high", x=60.0, y=-60.0, z=90.0, yaw_deg=0, pitch_deg=-70, fov_deg=60)
PLACE = (60.0, 10.0)


def rainy(rain_mm_h=14.0, temperature_c=14.0):
    level = make_beach()
    for path, value in (("clouds.on", True), ("weather.temperature_c", temperature_c), ("sea.on", False),
                        ("weather.rain_mm_h", rain_mm_h), ("shore.on", False)):  # fmt: skip
        level.set(path, value)
    level.write("weather", Rect(0, 0, 512, 512), np.array([0.8, 1, 0.5, 1, 1, 1], np.float32))
    return level


def shown(renderer, level, camera=DOWN, time_s=3.0, view="rain_ripples", size=(144, 96), **options):
    return render(
        level, camera, size, time_s=time_s, view=view, quality="low", renderer=renderer, linear=True, **options
    )


def water(pixels):
    """Slopes and what is lost of them, of the pixels of a view that show water."""
    there = pixels.any(axis=-1)
    return pixels[there][:, :2] - 0.5, pixels[there][:, 2] / 20


def test_rings_are_those_of_the_rain_at_the_camera():
    """D17: what level/rain.py says of the place; none in the dry, in snow, without clouds or at amount 0."""
    level = rainy()
    rain_mm_h = float(rain_at(level, 60.0, *PLACE)[0])
    assert rain_mm_h == pytest.approx(14.0)
    values = rain_ring_uniforms(level, 60.0, PLACE)
    assert values["u_rain_share"] == share_hit(rain_mm_h) > 0.5
    assert values["u_rain_rings_mean"] == pytest.approx(share_hit(14.0) * mean_slope2())
    shares = [rain_drops(rainy(rate), 60.0, *PLACE).share for rate in (1.0, 4.0, 40.0)]
    assert 0 < shares[0] < shares[1] < shares[2] < 1
    for path, value in (("weather.rain_mm_h", 0.0), ("weather.temperature_c", -8.0), ("clouds.on", False),
                        ("rain.ripples", 0.0)):  # fmt: skip
        dry = rainy()
        dry.set(path, value)
        assert rain_ring_uniforms(dry, 60.0, PLACE) == {"u_rain_share": 0.0}


def test_a_ring_is_born_flat_runs_outwards_and_dies_flat():
    """D17: slope is 0 at both ends of its life and outside its cell; in between its middle goes out."""
    r = np.linspace(0, 0.5, 501)
    assert np.abs(drop_slope(r, 0.0, 0.3)).max() == np.abs(drop_slope(r, 1.0, 0.3)).max() == 0
    ages = np.linspace(0.1, 0.9, 9)
    waves = np.stack([drop_slope(r, age, 0.34) for age in ages]) ** 2
    middles = (waves * r).sum(axis=1) / waves.sum(axis=1)
    assert (np.diff(middles) > 0.02).all()
    assert (np.diff(waves.max(axis=1)) < 0).all()
    assert waves[:, r > 0.45].max() == 0


def test_the_mean_slope_has_a_closed_form():
    """D17: slope² over many cells is the integral over place, age and size, by the share of the cells that are hit."""
    x, y = np.random.default_rng(3).uniform(0, 90, (2, 200_000))
    for share in (0.3, 1.0):
        slope = ring_slope(Drops(share, tuple((side, 0.2 + side, 5.0, 64.0) for side in cell_sides_m(0.44))), 2.0, x, y)
        assert (slope**2).sum(axis=-1).mean() == pytest.approx(4 * len(CELLS) * share * mean_slope2(), rel=0.06)
        assert np.abs(slope.mean(axis=0)).max() < 2e-3


def test_drops_come_round_with_the_loop():
    """D17 T05: the same ones at its ends, others a moment later; without a loop they are others."""
    level = rainy()
    x, y = np.random.default_rng(4).uniform(0, 40, (2, 4000))

    def slopes(time_s):
        return ring_slope(rain_drops(level, time_s, *PLACE), 1.0, x, y)

    assert np.abs(slopes(5.0) - slopes(11.0)).max() > 0.05
    level.set("time.loop_s", 6.0)
    assert np.abs(slopes(5.0) - slopes(11.0)).max() < 1e-6
    assert sum(row.name.startswith("drops") for row in loop_changes(level)) == len(CELLS)
    assert np.abs(slopes(6.0 - 1e-9) - slopes(0.0)).max() < 1e-5
    assert np.abs(slopes(5.0) - slopes(5.2)).max() > 0.05


def test_rings_are_as_wide_and_as_slow_as_they_are_told():
    """D17: the widest reaches ring_m across while its cycle lasts; its waves run at 0.23 m/s."""
    large = cell_sides_m(0.44)[-1]
    assert large == max(cell_sides_m(0.44)) == pytest.approx(0.5)
    assert 0.34 * large / cycle_s(large) == pytest.approx(0.23)


@pytest.mark.gl
def test_gpu_rings_as_the_twin(renderer):
    """D17: near by a pixel shows the twin's slope at its place."""
    level = rainy()
    level.set("rain.ring_m", 2.0)  # whole pixels a ring
    slopes, _ = water(shown(renderer, level))
    before = shown(renderer, level, view="before").astype(np.float64)
    x, y = np.moveaxis(before[shown(renderer, level).any(axis=-1)], -1, 0)[:2]
    twin = ring_slope(rain_drops(level, 3.0, DOWN.x, DOWN.y), 1.0, x, y)
    assert len(slopes) > 4000
    assert slopes.std() > 0.02
    assert np.median(np.abs(slopes - twin)) < 2e-3
    assert np.corrcoef(slopes.ravel(), twin.ravel())[0, 1] > 0.98


@pytest.mark.gl
def test_more_rain_is_more_slope_and_far_away_it_is_roughness(renderer):
    """D17: none without rain; what a pixel cannot show is counted as roughness, so that the sum stays."""
    assert not shown(renderer, rainy(0.0)).any()
    seen, lost = [], []
    for rate in (2.0, 14.0):
        near = [water(shown(renderer, rainy(rate), time_s=t)) for t in (0.0, 2.3, 4.6)]
        seen.append(np.mean([(slopes**2).sum(axis=-1).mean() for slopes, _ in near]))
        lost.append(np.mean([lost.mean() for _, lost in near]))
    assert seen[1] > 2 * seen[0] > 0
    lost_far = water(shown(renderer, rainy(), HIGH))[1].mean()
    assert np.abs(water(shown(renderer, rainy(), HIGH))[0]).max() < 0.01
    whole = len(CELLS) * share_hit(14.0) * mean_slope2()
    assert lost_far == pytest.approx(whole, rel=0.01)
    assert 0.1 * whole < lost[1] < 0.9 * whole
    assert seen[1] + lost[1] == pytest.approx(whole, rel=0.25)


@pytest.mark.gl
def test_rain_changes_the_water_alone_and_a_loop_ends_as_it_began(renderer):
    """D17 T05: normals of the water follow the rings, land stays; the same bytes after a loop."""
    level, bare = rainy(), Show.hide("scatter,things")
    level.set("weather.evolve", False)
    level.set("weather.wind_mps", 0.0)
    level.set("time.loop_s", 4.0)
    wet = shown(renderer, level, view="normal", show=bare)
    assert np.array_equal(wet, shown(renderer, level, view="normal", time_s=7.0, show=bare))
    level.set("rain.ripples", 0.0)
    calm = shown(renderer, level, view="normal", show=bare)
    assert np.abs(wet - calm).max() > 0.02
    ashore = Camera(id="ashore", x=60.0, y=118.0, z=30.0, yaw_deg=0, pitch_deg=-80, fov_deg=40)
    assert not shown(renderer, rainy(), ashore).any()
