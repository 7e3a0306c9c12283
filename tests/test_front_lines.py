"""Fronts drawn on the water: lines stand where the twin says, one width near and far, in every source (T06)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.level import BadInput
from shorewright.level.objects import Camera
from shorewright.level.timing import passage
from shorewright.renderer import Overlays, Show, render
from shorewright.renderer.show import FrontLines

SIZE, TIME_S = (240, 180), 5.0
ABOVE = Camera(id="down", x=80, y=30, z=70, yaw_deg=0, pitch_deg=-80, fov_deg=60)


@pytest.fixture(scope="module")
def level():
    made = make_beach(rows=129, cols=161)
    made.set("shore.stagger", 0.0)
    made.set("sea.chop_m", 0.0)
    return made


def shot(level, renderer, fronts="", camera=ABOVE, **options):
    overlays = Overlays(fronts=FrontLines.parse(fronts) if fronts else None)
    options = {"size": SIZE, "time_s": TIME_S, "quality": "high", "renderer": renderer, "overlays": overlays, **options}
    return render(level, camera, show=Show.hide("antialias"), **options).astype(np.float64)


def changed(level, renderer, fronts, **options):
    """Pixels that an overlay changes strongly, and the passage at every pixel's place."""
    off, on = shot(level, renderer, **options), shot(level, renderer, fronts, **options)
    place = shot(level, renderer, view="position", linear=True, **options)
    return np.abs(on - off).max(-1) > 60, passage(level, TIME_S, place[..., 0], place[..., 1]), on


@pytest.mark.gl
@pytest.mark.parametrize("source", ["depth", "travel_time"])
def test_crests_lie_where_the_twin_has_them(level, renderer, source):
    """T06: what `crests` changes lies within two pixels of a whole phase, and each whole phase is drawn."""
    level.set("timing.source", source)
    drawn, here, _ = changed(level, renderer, "crests")
    phase = TIME_S / here.period_s - here.cycles.v
    near = np.abs(phase - np.round(phase))
    step = np.hypot(*np.gradient(phase))
    assert drawn.sum() > 150
    assert (near[drawn] < 2.8 * np.maximum(step[drawn], 1e-4) + 0.01).all()
    sure = here.stands & (here.height > 0.15) & (near < 0.4 * step) & (step < 0.06)
    assert drawn[sure].mean() > 0.9
    level.set("timing.source", "depth")


@pytest.mark.gl
def test_ghosts_are_the_crests_of_other_moments(level, renderer):
    """T06: blue where crests stood a step before, orange where they will stand a step later."""
    step_s = 1.2
    _, here, picture = changed(level, renderer, f"ghosts:1:{step_s}")
    plain = shot(level, renderer)
    phase = TIME_S / here.period_s - here.cycles.v
    steep = np.hypot(*np.gradient(phase))
    for k, warmer in ((-1, False), (1, True)):
        moved = phase + k * step_s / here.period_s
        on = here.stands & (here.height > 0.2) & (np.abs(moved - np.round(moved)) < 0.4 * steep) & (steep < 0.05)
        assert on.sum() > 30
        tint = (picture - plain)[on][:, 0] - (picture - plain)[on][:, 2]
        assert (tint.mean() > 25) == warmer
        assert abs(tint.mean()) > 15


@pytest.mark.gl
def test_lines_have_one_width_on_the_screen(level, renderer):
    """T06: as many pixels across near the camera as far from it, on the moving surface too."""
    low = Camera(id="low", x=80, y=2, z=9, yaw_deg=0, pitch_deg=-14, fov_deg=60)
    drawn, _, _ = changed(level, renderer, "isochrones:6", camera=low)
    widths = {}
    for col in range(0, SIZE[0], 5):
        edges = np.flatnonzero(np.diff(np.concatenate([[0], drawn[:, col].astype(int), [0]])))
        for first, last in zip(edges[::2], edges[1::2]):
            widths.setdefault(int(first) // 30, []).append(last - first)
    means = [np.mean(found) for found in widths.values() if len(found) > 20]
    assert len(means) >= 2
    assert max(means) < 4
    assert max(means) < 2.5 * min(means)


@pytest.mark.gl
def test_nothing_is_drawn_on_land_or_without_water(level, renderer):
    everything = "ghosts:2:1,isochrones:2,speed,breakers"
    off, on = shot(level, renderer), shot(level, renderer, everything)
    place = shot(level, renderer, view="material", linear=True)
    on_land = place[..., 0] > place[..., 2]  # the sea is blue there
    assert on_land.sum() > 1000
    assert np.array_equal(off[on_land], on[on_land])
    dry = Show.hide("water")
    pictures = [
        render(level, ABOVE, SIZE, TIME_S, show=dry, renderer=renderer,
               overlays=Overlays(fronts=FrontLines.parse(text)))
        for text in ("", everything)
    ]  # fmt: skip
    assert np.array_equal(*pictures)


def test_overlays_are_given_as_words():
    found = FrontLines.parse("ghosts:3:0.5,isochrones:2,speed:12,breakers")
    assert found == FrontLines(True, 3, 0.5, 2.0, True, True, 0.0, 12.0)
    assert FrontLines.parse("") == FrontLines()
    for bad in ("waves", "ghosts:9", "ghosts:1.5", "isochrones:-1", "crests:2", "speed:x", "isochrones:nan"):
        with pytest.raises(BadInput, match="no overlay of fronts"):
            FrontLines.parse(bad)
