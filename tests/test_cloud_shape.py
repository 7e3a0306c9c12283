"""Clouds obey the map: cover, type, precipitation; and evolve (Z02 Z03 Z04 Z22)."""

import numpy as np
import pytest
from cloud_columns import columns, prepared, run
from coasts import make_beach

PHASES = """
#include "lib/frame.glsl"
#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif
#ifdef FRAGMENT
#include "lib/cloud_light.glsl"
out vec4 out_value;
void main() {
    float cosine = gl_FragCoord.x / 4096.0 * 2.0 - 1.0;
    out_value = vec4(henyey_greenstein(cosine, 0.2), henyey_greenstein(cosine, 0.6), henyey_greenstein(cosine, 0.8),
                     cloud_phase(cosine));
}
#endif
"""


def even_sky(coverage=0.5, kind=0.6, rain=0.0, **more):
    """A beach under the same weather everywhere."""
    level = make_beach()
    values = {"clouds.on": True, "weather.variety": 0.0, "weather.coverage": coverage, "weather.type": kind,
              "weather.precipitation": rain, "weather.painted": False, **more}  # fmt: skip
    for path, value in values.items():
        level.set(path, value)
    return level


def cover(depth):
    return float((depth > 0.5).mean())


def test_cover_rises_with_the_coverage_of_the_map(renderer):
    """Z04: monotone, and seen from above within an eighth of what was painted."""
    covers = [cover(columns(renderer, even_sky(c, 1.0))[0]) for c in (0.0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0)]
    assert covers[0] == 0
    assert (np.diff(covers) > 0).all()
    assert covers == pytest.approx([0, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0], abs=0.12)


def test_types_stand_at_their_heights(renderer):
    """Z03: height centroids stratus < stratocumulus < cumulus < cumulonimbus."""
    skies = [even_sky(0.8, kind) for kind in (0.0, 0.5, 1.0)] + [even_sky(0.8, 1.0, 1.0)]
    heights = [columns(renderer, sky)[1] for sky in skies]
    assert (np.diff(heights) > 30).all()


def test_precipitation_raises_tops_and_deepens_clouds(renderer):
    """Z04: from 0 to 1 both go up all the way."""
    made = [columns(renderer, painted_rain(rain)) for rain in (0.0, 0.25, 0.5, 0.75, 1.0)]
    tops = [np.quantile(top[top > 0], 0.9) for _, _, top in made]
    depths = [depth.mean() for depth, _, _ in made]
    assert (np.diff(tops) > 0).all()
    assert (np.diff(depths) > 0).all()


def painted_rain(rain):
    """A sky painted all over with coverage 0.5, cumulus, and so much rain."""
    level = even_sky()
    level.set("weather.painted", True)
    grid = level.layers["weather"].grid
    level.write("weather", grid.rect, np.array([0.5, rain, 1.0, 1.0, 1.0, 1.0], np.float32))
    return level


def test_bases_darken_with_precipitation(renderer):
    """Z11: what is seen of the clouds from below is darker the more they rain."""
    from shorewright.level.objects import Camera
    from shorewright.renderer import render

    up = Camera(id="up", x=40.0, y=40.0, z=30.0, yaw_deg=30.0, pitch_deg=60.0)
    lights = []
    for rain in (0.0, 0.5, 1.0):
        level = painted_rain(rain)
        level.set("clouds.cirrus", 0.0)
        hidden = render(level, up, (96, 54), view="cloud_alpha", linear=True, renderer=renderer, quality="low")[..., 0]
        seen = render(level, up, (96, 54), linear=True, renderer=renderer, quality="low")
        lights.append(seen[hidden > 0.95].mean())
    assert (np.diff(lights) < 0).all()


def test_outlines_evolve_besides_drifting(renderer):
    """Z22: without wind a cloud's outline changes with time, its mass hardly; switched off it stands."""
    still = {"weather.wind_mps": 0.0, "weather.evolve": False}
    level = even_sky(0.5, 1.0, **still)
    first, later = columns(renderer, level)[0], columns(renderer, level, time_s=120.0)[0]
    changed = ((first > 0.5) != (later > 0.5)).mean()
    assert 0.005 < changed < 0.3
    assert cover(first) == pytest.approx(cover(later), abs=0.1)
    level.set("cloud_terms.evolve", False)
    np.testing.assert_array_equal(first, columns(renderer, even_sky(0.5, 1.0, **still))[0])
    np.testing.assert_array_equal(columns(renderer, level, time_s=120.0)[0], columns(renderer, level)[0])


def test_clouds_drift_with_the_wind(renderer):
    """Z07: in the time in which the air goes one column on, every column is what its neighbour was."""
    level = even_sky(0.5, 1.0, **{"weather.wind_mps": 10.0, "weather.heading_deg": 90.0, "cloud_terms.evolve": False,
                                  "weather.evolve": False})  # fmt: skip
    side, square_m = 96, 96 * 50.0
    first = columns(renderer, level, side, square_m)[0]
    later = columns(renderer, level, side, square_m, time_s=5.0)[0]
    np.testing.assert_allclose(later[:, 1:], first[:, :-1], atol=0.05 * first.max())
    assert np.abs(later - first).max() > 0.2 * first.max()


def test_phase_functions_give_back_all_light(renderer):
    """Z09: their integrals over all directions are 1 ± 1e-4 (for 0.2, 0.6, 0.8 and the two lobes together)."""
    frame, values = prepared(renderer, even_sky())
    phase = run(renderer, frame, values, PHASES, (4096, 1))[0].astype(np.float64)
    assert 2 * np.pi * phase.mean(axis=0) * 2 == pytest.approx(np.ones(4), abs=1e-4)
