"""The march through the clouds: where a ray is in the shell, what it may not miss, where it may not break (Z12 Z14)."""

import numpy as np
import pytest
from cloud_columns import prepared, run
from coasts import make_beach
from shorewright.level.objects import Camera
from shorewright.renderer import render

RADIUS_M, BASE_M, TOP_M = 6_371_000.0, 1500.0, 4000.0
SHELL = """
#include "lib/frame.glsl"
#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif
#ifdef FRAGMENT
#include "lib/shell.glsl"
out vec4 out_value;
void main() {
    float z = (floor(gl_FragCoord.x) - 256.0) / 256.0;
    vec3 dir = vec3(sqrt(1.0 - z * z), 0.0, z);
    float along = 137.0 * floor(gl_FragCoord.x);
    out_value = vec4(sphere_hits(dir, u_clouds_base_m), sphere_hits(dir, u_clouds_top_m).y, altitude_of(dir * along));
}
#endif
"""


def cloudy(**values):
    level = make_beach()
    level.set("clouds.on", True)
    for path, value in values.items():
        level.set(path.replace("__", "."), value)
    return level


def hits(eye_m, height_m, z):
    """Both distances in float64, NaN where there are none."""
    b = (RADIUS_M + eye_m) * z
    c = (eye_m - height_m) * (2 * RADIUS_M + eye_m + height_m)
    inner = np.where(b * b >= c, b * b - c, np.nan)
    return -b - np.sqrt(inner), -b + np.sqrt(inner)


@pytest.mark.parametrize("eye_m", [2.0, 200.0, 1499.0, 1600.0, 4500.0])
def test_rays_meet_the_shell_within_centimetres(renderer, eye_m):
    """Z12: distances up to 60 km, and heights along a ray, within 5 cm of float64 at 6371 km."""
    frame, values = prepared(renderer, cloudy())
    out = run(renderer, frame, values, SHELL, (512, 1), u_eye_m=eye_m, u_planet_m=RADIUS_M)[0].astype(np.float64)
    z = (np.arange(512) - 256) / 256
    for ours, exact in (
        (out[:, 0], hits(eye_m, BASE_M, z)[0]),
        (out[:, 1], hits(eye_m, BASE_M, z)[1]),
        (out[:, 2], hits(eye_m, TOP_M, z)[1]),
    ):
        near = np.abs(np.nan_to_num(exact, nan=1e9)) < 60_000
        assert near.sum() > 20
        assert np.abs(ours[near] - exact[near]).max() < 0.05
        assert (ours[np.isnan(exact)] == -1).all()
    along = 137.0 * np.arange(512)
    altitude = np.hypot(RADIUS_M + eye_m + along * z, along * np.sqrt(1 - z * z)) - RADIUS_M
    assert np.abs(out[:, 3] - altitude)[along < 60_000].max() < 0.05


def test_cheap_steps_miss_no_cloud(renderer):
    """Z14: what the march that is dear everywhere sees, the one with cheap steps sees too."""
    up = Camera(id="up", x=80.0, y=40.0, z=20.0, yaw_deg=60.0, pitch_deg=25.0)
    sky = {"weather__coverage": 0.45, "weather__type": 0.9}
    dear, cheap = (
        render(level, up, (240, 136), view="cloud_alpha", linear=True, renderer=renderer)[..., 0]
        for level in (cloudy(cloud_terms__cheap_steps=False, **sky), cloudy(**sky))
    )
    seen = dear > 0.1
    assert 0.2 < seen.mean() < 0.9
    assert (cheap[seen] > 0.3 * dear[seen]).mean() > 0.997
    assert abs(cheap.mean() - dear.mean()) < 0.01


@pytest.mark.parametrize("place", [(2.0, 0.0), (200.0, 90.0), (1500.0, 0.0), (1501.0, -40.0), (2500.0, 0.0),
                                   (4000.0, -5.0), (9000.0, -89.0)])  # fmt: skip
@pytest.mark.parametrize("sun_deg", [40.0, -6.0])
def test_no_place_or_hour_breaks_it(renderer, place, sun_deg):
    """Below, in, above and on the shell, level, up and down, by day and after sunset: numbers, and none below 0."""
    level = cloudy(light__sun_elevation_deg=sun_deg, weather__coverage=0.8, weather__precipitation=0.4)
    camera = Camera(id="there", x=80.0, y=40.0, z=place[0], yaw_deg=200.0, pitch_deg=place[1])
    seen = render(level, camera, (64, 36), linear=True, renderer=renderer, quality="low")
    assert np.isfinite(seen).all()
    assert seen.min() >= 0
