"""Godot 4 itself runs the kit: foam, tide and keys of the sea, weather and clouds, against the kit's C (T09)."""

import base64
import json

import numpy as np
import pytest
from clients.godot4 import run_godot4
from clients.programs import CLIENTS, SCRIPTS
from kit_parts import LEVELS, asked, run_c, run_sky
from shorewright.io.export import export
from shorewright.level.objects import WeatherKey
from test_clients_godot4 import values_of

COLS, ROWS = 50, 40
pytestmark = pytest.mark.skipif(CLIENTS["Godot 4"].missing() is not None, reason=str(CLIENTS["Godot 4"].missing()))
SEA = (
    "Sea sea = sea_surface(point);",
    "sea.position.x, sea.position.y, sea.position.z, foam_on(sea), 0.0, 0.0, 0.0, 0.0",
)
SKY = (
    "vec4 sky = weather_at(point); float dense = cloud_density(vec3(point, 2000.0));",
    "sky.x, sky.y, sky.z, sky.w, dense, 0.0, 0.0, 0.0",
)


def in_godot(level, tmp_path, part, asks, body, values):
    """(n, 8) of what a shader with a part of the kit says at (n, 3) times and points."""
    export(level, "godot-project", tmp_path / "out", ["project", "kit"], name="bay")
    files = {path.name: path.read_bytes() for path in (tmp_path / "out").iterdir()}
    text = (SCRIPTS / "godot4_points.gdshader").read_text().replace("sea.gdshaderinc", f"bay_{part}.gdshaderinc")
    head, rest = text.split("\tSea sea", 1)
    files["points.gdshader"] = (
        f"{head}\t{body}\n\tfloat values[8] = {{ {values} }};\n{rest[rest.index('	int block') :]}".encode()
    )
    files["points.f32"] = np.float32(asks[:, 1:]).tobytes()
    told = {"name": "bay", "part": part, "cols": COLS, "rows": ROWS, "times_s": np.unique(asks[:, 0]).tolist()}
    files["asked.json"] = json.dumps(told).encode()
    found = run_godot4("godot4_points.gd", files, tmp_path / "told")
    pixels = [np.frombuffer(base64.b64decode(text), np.uint8) for text in found["answer"]]
    return np.concatenate([values_of(one.reshape(-1, ROWS, COLS, 3)) for one in pixels])


def moved(name):
    """A windy level with a tide and a key."""
    level = LEVELS[name]()
    level.set("sea.wind_mps", 12.0)
    for setting, value in {"on": True, "period_s": 300.0, "curve": (0.0, 1.0, 0.3, 0.2, 0.55, 0.0)}.items():
        level.set(f"tide.{setting}", value)
    level.put_object("k", WeatherKey(id="k", x=0, y=0, time_s=100.0, fade_s=60.0, weather="gale"))
    level.set("clouds.on", True)
    return level


@pytest.mark.parametrize("name", ["plain", "placed"])
def test_godots_sea_moves_and_foams_as_c_does(name, tmp_path):
    """T09: heights within a millimetre through tide and keys, the same foam."""
    level = moved(name)
    asks = asked(level, [0.0, 131.0, 3600.25], COLS * ROWS)
    found = in_godot(level, tmp_path, "sea", asks, *SEA)
    told = run_c(level, asks, tmp_path)
    assert np.abs(found[:, :3] - told[:, :3]).max() < 1e-3
    assert told[:, 13].std() > 0.05
    assert np.abs(found[:, 3] - told[:, 13]).max() < 0.01


def test_godots_weather_and_clouds_are_those_of_c(tmp_path):
    """T09: coverage, rain, type and density at points, its textures no larger than a small graphics card takes."""
    level = moved("plain")
    rng = np.random.default_rng(6)
    times = np.repeat([0.0, 131.0], COLS * ROWS)
    asks = np.column_stack([times, np.float32(rng.uniform(-30_000, 30_000, (len(times), 2)))]).astype(np.float64)
    found = in_godot(level, tmp_path, "sky", asks, *SKY)
    told = run_sky(level, np.column_stack([asks, np.full(len(asks), 2000.0)]), tmp_path)
    assert (told[:, 4] > 0).mean() > 0.02
    assert np.abs(found[:, :5] - told).max() < 2e-3
