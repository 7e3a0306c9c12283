"""The weather map in a corner of the picture (Z04): where things are on it, what it shows, how it is turned."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level import BadInput, Rect
from shorewright.level.weather import STAGES, TILE_M, weather_at
from shorewright.renderer import Overlays, render
from shorewright.renderer.show import Inset
from shorewright.renderer.sky_insets import SKY_INSETS, find_inset, inset_views, stage_of

SIZE = (200, 120)
PX = 108  # of an inset of size 0.9
BOX = np.s_[120 - 2 - PX : 120 - 2, 2 : 2 + PX]  # lower left
pytestmark = pytest.mark.gl


@pytest.fixture(scope="module")
def level():
    made = coast()
    made.set("weather.precipitation", 0.25)
    made.set("weather.heading_deg", 90.0)
    return made


def inset(level, renderer, name="weather_map", time_s=4.0, yaw=30.0, **options):
    """The inset alone, `(108, 108, 3)` in 0 … 1, north first."""
    shot = camera(x=128.0, y=60.0, z=30.0, yaw=yaw, pitch=-40.0)
    overlays = Overlays(insets=(Inset(name, "lower-left", 0.9, **options),))
    return render(level, shot, SIZE, time_s, overlays=overlays, renderer=renderer)[BOX] / 255.0


def places(half_m=TILE_M / 2, middle=(0.0, 0.0)):
    """World x and y of the inset's pixels."""
    at = ((np.arange(PX) + 0.5) / PX * 2 - 1) * half_m
    return np.meshgrid(at + middle[0], -at + middle[1])


def bare(made):
    """Without frame, needle, ring, border and arrow: what is left of the map."""
    keep = np.ones((PX, PX), bool)
    keep[:3] = keep[-3:] = keep[:, :3] = keep[:, -3:] = False
    keep[-30:, -30:] = False
    keep[PX // 2 - 14 : PX // 2 + 14, PX // 2 - 14 : PX // 2 + 14] = False
    x, y = places()
    return keep & (np.abs(np.hypot(x - 128, y - 60) - made.settings.weather.horizon_start_m) > 1500)


@pytest.mark.parametrize("stage", STAGES)
def test_it_is_the_map_of_the_twin(level, renderer, stage):
    """Z04: red coverage, green precipitation, blue type at every place, after each stage."""
    level.write("weather", Rect(300, 300, 360, 360), 0.9)
    seen = inset(level, renderer, f"weather_{stage}")
    wanted = weather_at(level, 4.0, *places(), (128.0, 60.0), stage)[..., :3]
    off = np.abs(seen - wanted)[bare(level)]
    assert off.mean() < 0.004
    assert np.quantile(off, 0.99) < 0.05
    assert np.array_equal(inset(level, renderer), inset(level, renderer, "weather_final"))


def test_the_level_and_the_camera_are_on_it(level, renderer):
    """Z04: a border round the level, the camera's mark inside it; both move with what is shown."""
    seen = inset(level, renderer, extent_m=800.0, yaw=0.0)
    x, y = places(400.0, (128.0, 60.0))
    east, north = level.grid.extent_m
    edge = np.maximum(np.maximum(-x, x - east), np.maximum(-y, y - north))
    white = seen.min(axis=-1) > 0.85
    assert white[(np.abs(edge) < 3) & (seen.sum(axis=-1) > 0)].mean() > 0.3
    inner = np.zeros_like(white)
    inner[8:-34, 8:-34] = True
    assert not white[inner & (np.abs(edge) > 20)].any()
    yellow = (seen[..., 0] > 0.9) & (seen[..., 2] < 0.5) & (seen[..., 1] > 0.7)
    rows, cols = np.nonzero(yellow)
    assert np.abs(cols - PX / 2).max() < 5
    assert -16 < rows.min() - PX / 2 < -8  # it looks north: up


def arrow(seen):
    """Mean place of the arrow's white pixels' head against its middle, right and up."""
    part = seen[-26:-3, -26:-3].min(axis=-1) > 0.7
    rows, cols = np.nonzero(part)
    return cols.mean() - (cols.min() + cols.max()) / 2, (rows.min() + rows.max()) / 2 - rows.mean()


def test_the_wind_blows_on_it_and_turns_with_it(level, renderer):
    """Z04: towards its heading, east here; to the left of a map turned by 180°."""
    assert arrow(inset(level, renderer))[0] > 0.5
    assert arrow(inset(level, renderer, turn_deg=180.0))[0] < -0.5
    level.set("weather.heading_deg", 0.0)
    assert arrow(inset(level, renderer))[1] > 0.5
    level.set("weather.heading_deg", 90.0)


def test_it_moves_with_the_clock_and_needs_no_clouds(level, renderer):
    assert not level.settings.clouds.on
    first, later = inset(level, renderer, time_s=0.0), inset(level, renderer, time_s=1500.0)
    assert np.abs(first - later).mean() > 0.02
    assert np.array_equal(inset(level, renderer, time_s=0.0), first)


def test_words_and_lists():
    assert Inset.parse("weather_map:lower-left:0.3:heading:20000").extent_m == 20_000
    assert stage_of("weather_map") == "final"
    assert {stage_of(name) for name in SKY_INSETS} == set(STAGES)
    assert all(find_inset(name).mapped for name in SKY_INSETS)
    assert {"force", "weather_map"} <= inset_views().keys()
    with pytest.raises(BadInput, match="no view is called"):
        Inset.parse("weather_dream")
