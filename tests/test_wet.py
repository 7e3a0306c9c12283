"""The wet shore follows the shore clock: damp sand that dries, film and lace behind the draining sheet (L06)."""

import numpy as np
import pytest
from scenes import coast
from shorewright.level.objects import Camera
from shorewright.level.pick import ground_at
from shorewright.level.waves import sea_at
from shorewright.renderer import Show, render

pytestmark = pytest.mark.gl
PLACE = Camera(id="c", x=128, y=145, z=45, yaw_deg=0, pitch_deg=-90, fov_deg=45)
DRY = Show.hide("water")
CREEP_M = 0.035  # how far the sand draws water above the sheet


@pytest.fixture
def shore():
    level = coast()
    level.set("shore.runup_variety", 0.4)
    level.set("shore.variety_m", 12.0)
    return level


def seen(level, renderer, view, time_s, quality="medium", size=(48, 48)):
    return render(level, PLACE, size, time_s, view, DRY, quality, linear=True, renderer=renderer).astype(np.float64)


def ground(level, renderer):
    """World x, y and height over the sea of every pixel."""
    at = seen(level, renderer, "position", 0.0)
    return at[..., 0], at[..., 1], ground_at(level, at[..., 0], at[..., 1])


def uncovered_since(level, at, time_s, steps=200, back_s=27.0):
    """Seconds since the twin's sheet last stood over each point, inf where it did not in `back_s`."""
    x, y, height = at
    since = np.full(x.shape, np.inf)
    for back in np.linspace(0, back_s, steps):
        covered = sea_at(level, time_s - back, x, y).height_m > height
        since = np.where(covered & np.isinf(since), back, since)
    return since


@pytest.mark.parametrize(("time_s", "sway"), [(30.0, 0.0), (33.1, 0.0), (36.4, 0.0), (31.4, 0.4), (34.9, 0.4)])
def test_sand_dries_from_when_the_twins_sheet_left_it(renderer, shore, time_s, sway):
    """L06 H20: wetness is exp(−t / dry_s) of the time since the CPU's sea stood there; never wet above the run-up."""
    shore.set("shore.sway", sway)
    shore.set("shore.sway_m", 30.0)
    at = ground(shore, renderer)
    damp = seen(shore, renderer, "wetness", time_s)[..., 0]
    since = uncovered_since(shore, at, time_s)
    top = shore.settings.shore.range_m * shore.settings.shore.runup
    left = (since > 0.2) & (since < 20) & (at[2] > 0.05)
    assert left.sum() > 60
    off = np.abs(damp - np.exp(-since / shore.settings.wet.dry_s))[left]
    assert np.quantile(off, 0.75) < 0.03  # the rest lies where the sheet turned, and soaked it only in part
    assert damp[at[2] > top + CREEP_M + 0.01].max() == 0
    assert damp[(since == 0) & (at[2] < 0.5 * top)].min() > 0.5


def test_sand_dries_until_the_next_sheet(renderer, shore):
    """L06: where no water came in between, it is never wetter later; dry_s says how fast."""
    shore.set("wet.dry_s", 8.0)
    at = ground(shore, renderer)
    first, later = 31.0, 32.5
    damp = [seen(shore, renderer, "wetness", t)[..., 0] for t in (first, later)]
    dry = uncovered_since(shore, at, later, 40, later - first + 0.6) == np.inf
    dry &= at[2] > 0.03
    assert (dry & (damp[0] > 0.3)).sum() > 50
    assert (damp[1] <= damp[0] + 1e-3)[dry].all()
    known = dry & (damp[0] > 0.3)
    assert np.median(damp[1][known] / damp[0][known]) == pytest.approx(np.exp(-(later - first) / 8.0), abs=0.02)


def test_film_lies_only_behind_the_draining_sheet(renderer, shore):
    """L06: the film is there where the sheet has just been, gone within film_s, nowhere else."""
    at = ground(shore, renderer)
    shares = []
    for time_s in (30.0, 31.5, 33.0, 34.5, 36.0):
        film = seen(shore, renderer, "film", time_s)[..., 0]
        since = uncovered_since(shore, at, time_s, 120, 9.0)
        open_sand = (at[2] > 0.1) & (since > 0.1)
        gone = open_sand & (since > shore.settings.wet.film_s + 0.5) & (since < np.inf)
        soon = sea_at(shore, time_s + 0.3, at[0], at[1]).height_m
        gone &= soon < at[2] - CREEP_M  # where the next one is not about to come
        assert film[gone].max(initial=0) < 0.1
        never = (at[2] > 0.1) & (since == np.inf)  # but for what the sand draws up beyond the sheet
        assert (film[never] > 0.02).mean() < 0.1
        shares.append((film > 0.5)[open_sand].mean())
    assert max(shares) > 0.05
    shore.set("wet.film", 0.0)
    assert seen(shore, renderer, "film", 31.5).max() == 0


def test_lace_lies_at_the_line_where_the_sheet_turned_and_goes(renderer, shore):
    """L06: foam on the sand near the furthest reach after the sheet turned, less and less of it."""
    shore.set("wet.lace_s", 5.0)
    at = ground(shore, renderer)
    times = np.arange(30.0, 39.0, 0.5)
    amounts = [seen(shore, renderer, "lace", t)[..., 0] for t in times]
    whole = np.array([lace.mean() for lace in amounts])
    assert whole.max() > 4 * whole.min()
    full = amounts[int(whole.argmax())]
    reached = uncovered_since(shore, at, times[int(whole.argmax())], 120, 9.0) < np.inf
    assert full[~reached & (at[2] > 0)].mean() < 0.1 * full[reached & (at[2] > 0)].mean()
    centre = np.average(at[2], weights=full)
    assert centre > 0.4 * shore.settings.shore.range_m * shore.settings.shore.runup
    shore.set("wet.lace", 0.0)
    assert seen(shore, renderer, "lace", times[int(whole.argmax())]).max() == 0


def test_wet_sand_is_half_as_bright(renderer, shore):
    """L06: albedo of wet sand about half of the same sand dry."""
    shore.set("wet.lace", 0.0)
    damp = seen(shore, renderer, "wetness", 32.0)[..., 0]
    wet = seen(shore, renderer, "albedo", 32.0)
    height = ground(shore, renderer)[2]
    shore.set("shore.on", False)
    dry = seen(shore, renderer, "albedo", 32.0)
    soaked = (damp > 0.95) & (height > 0.12)
    assert soaked.sum() > 50
    assert np.median((wet / dry)[soaked]) == pytest.approx(0.5, abs=0.07)


@pytest.mark.parametrize("view", ["wetness", "film", "lace"])
def test_one_interval_later_is_the_same_shore(renderer, shore, view):
    """D03 H20: sand and water share one clock, so equal waves leave equal shores after an interval."""
    shore.set("shore.runup_variety", 0.0)
    interval = shore.settings.shore.interval_s
    first, again = (seen(shore, renderer, view, 31.0 + k * interval) for k in (0, 2))
    assert np.abs(first - again).max() < 0.02
    assert first.max() > 0.15


SETTINGS = {
    "plain": {},
    "staggered": {"shore.stagger": 1.3, "shore.runup_variety": 1.0},
    "swaying": {"shore.sway": 0.4, "shore.sway_m": 20.0},
    "quick": {"shore.interval_s": 2.0, "wet.dry_s": 3.0, "wet.film_s": 8.0},
    "long": {"shore.runup": 0.5, "wet.dry_s": 600.0, "wet.film_s": 40.0, "wet.lace_s": 40.0},
}


@pytest.mark.parametrize("settings", SETTINGS.values(), ids=SETTINGS)
@pytest.mark.parametrize("view", ["wetness", "film"])
def test_nothing_pops_when_a_new_wave_begins(renderer, shore, view, settings):
    """L06: 0.02 s change no place by more than a little, through every wrap of the clock and of the waves' numbers."""
    for name, value in settings.items():
        shore.set(name, value)
    travel = shore.settings.shore.interval_s * shore.settings.shore.count
    rng = np.random.default_rng(3)
    wraps = [k * shore.settings.shore.interval_s / 3 - 0.01 for k in range(6)] + [travel - 0.01, 2 * travel - 0.01]
    for time_s in [*(40 + np.array(wraps)), *rng.uniform(20, 200, 5)]:
        before, after = (seen(shore, renderer, view, time_s + step, size=(32, 32)) for step in (0.0, 0.02))
        assert np.abs(after - before).max() < 0.13


def test_sand_is_wet_as_high_as_the_slope_lets_waves_run(renderer, shore):
    """L06 D10: with `shore.runup_by_slope` sand and sheet have one limit, here lower than that of the range."""
    shore.set("timing.source", "travel_time")
    shore.set("sea.swell_m", 0.4)
    shore.set("shore.height_m", 0.3)
    at, highest = ground(shore, renderer), {}
    for by_slope in (0.0, 1.0):
        shore.set("shore.runup_by_slope", by_slope)
        film = seen(shore, renderer, "film", 31.4)[..., 0]
        since = uncovered_since(shore, at, 31.4, back_s=18.0)
        assert film[np.isinf(since) & (at[2] > 0.1)].max(initial=0) < 0.05
        highest[by_slope] = at[2][np.isfinite(since)].max()
    assert highest[1.0] < highest[0.0] - 0.1
