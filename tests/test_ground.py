"""Ground materials as drawn: measured albedo, paint, no period from above, a far beach that holds still (L04, L05)."""

import numpy as np
import pytest
from scenes import camera
from scipy.ndimage import gaussian_filter
from scipy.spatial import cKDTree
from shorewright.level import Grid, Level, Rect
from shorewright.level.ground_materials import MATERIALS
from shorewright.level.objects import Camera
from shorewright.renderer import render
from shorewright.renderer.passes.terrain import ground_uniforms

pytestmark = pytest.mark.gl
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
SIDE = 257
COLOURS = {row.name: row.colour for row in MATERIALS}


def ground(height, side: int = SIDE, **settings) -> Level:
    y, x = np.mgrid[0:side, 0:side].astype(np.float64)
    middle = (side - 1) / 2
    level = Level(Grid(side, side), np.asarray(height(x - middle, y - middle) + np.zeros_like(x), np.float32))
    for name, value in {"fog.on": False, **settings}.items():
        level.set(name.replace("__", "."), value)
    return level


def flat(height_m: float, side: int = SIDE, **settings) -> Level:
    return ground(lambda x, y: height_m, side, **settings)


def from_above(renderer, level, span_m: float, pixels: int, view: str, quality: str = "medium") -> np.ndarray:
    """A view straight down over `span_m` in the level's middle."""
    middle, up = level.grid.extent_m[0] / 2, 6.0 * span_m
    place = Camera(
        id="c", x=middle, y=middle, z=float(level.height[level.grid.rows // 2, level.grid.cols // 2]) + up,
        yaw_deg=0, pitch_deg=-90, fov_deg=float(np.degrees(2 * np.arctan(span_m / 2 / up))),
    )  # fmt: skip
    return render(level, place, (pixels, pixels), view=view, linear=True, quality=quality, renderer=renderer)


def luminance(picture: np.ndarray) -> np.ndarray:
    return picture.astype(np.float64) @ LUMINANCE


DRY = {"shore__on": False, "ground__shingle": 0.0}


@pytest.mark.parametrize("quality", ["low", "medium"])
@pytest.mark.parametrize(
    ("name", "level", "low", "high"),
    [
        ("sand", flat(1.6, **DRY), 0.30, 0.45),
        ("grass", flat(30.0), 0.10, 0.20),
        ("rock", ground(lambda x, y: 40 + 1.4 * x, **DRY), 0.10, 0.30),
        ("shingle", flat(0.5, ground__shingle=1.0), 0.05, 0.30),
    ],
)
def test_albedo_is_what_was_measured_of_such_ground(renderer, name, level, low, high, quality):
    """L05: mean luminance in the albedo view."""
    seen = luminance(from_above(renderer, level, 60.0, 96, "albedo", quality))
    assert low < seen.mean() < high
    assert seen.std() > 0.01


def test_wet_sand_is_half_as_bright_and_smooth(renderer):
    """Painted always wet: half the albedo, roughness 0.3, against dry (L05, L06)."""
    level = flat(1.6, **DRY)
    dry, rough = (from_above(renderer, level, 40.0, 64, view) for view in ("albedo", "roughness"))
    level.write("cover", Rect(0, 0, SIDE, SIDE), np.array([0.0, 0.0, 0.0, 1.0], np.float32))
    wet, smooth = (from_above(renderer, level, 40.0, 64, view) for view in ("albedo", "roughness"))
    assert luminance(wet).mean() / luminance(dry).mean() == pytest.approx(0.5, abs=0.06)
    assert rough.mean() > 0.8
    assert smooth.mean() == pytest.approx(0.3, abs=0.03)


def autocorrelation(field: np.ndarray) -> np.ndarray:
    """Of a field less its broad changes, by shift in pixels; only shifts that leave three tenths of it overlapping."""
    rest = field - gaussian_filter(field, 8, mode="reflect")
    rows, cols = rest.shape
    power = [np.fft.irfft2(np.abs(np.fft.rfft2(a, (2 * rows, 2 * cols))) ** 2) for a in (rest, np.ones_like(rest))]
    share = power[1] / rest.size
    found = power[0] / np.maximum(power[1], 1)
    return np.where(share > 0.3, found / found[0, 0], 0.0)


def cones(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Slopes of 1.4 that face all ways: on a plain one the beds would be straight lines."""
    feet = np.random.default_rng(5).uniform(-360, 360, (40, 2))
    return 40 + 1.4 * cKDTree(feet).query(np.stack([x, y], -1))[0]


WIDE = {  # 500 m of each material: the level and what is painted on it
    "sand": (lambda: flat(1.6, 701, **DRY), None),
    "shingle": (lambda: flat(0.5, 701, ground__shingle=1.0), None),
    "strata": (lambda: ground(cones, 701, **DRY), None),
    "reef": (lambda: flat(30.0, 701), 1),
    "grass": (lambda: flat(30.0, 701), None),
    "dune grass": (lambda: flat(4.6, 701), None),
    "sea floor": (lambda: flat(-3.0, 701, water__on=False, ground__weed=0.0), None),
    "weed": (lambda: flat(-6.0, 701, water__on=False, ground__weed=1.0), None),
}


@pytest.mark.parametrize("quality", ["low", "medium"])
@pytest.mark.parametrize("name", COLOURS)
def test_no_period_is_seen_from_above(renderer, name, quality):
    """500 m of one ground: no shift beyond a few pixels lays the picture over itself (L05)."""
    make, channel = WIDE[name]
    level = make()
    if channel is not None:
        level.write("cover", Rect(0, 0, 701, 701), np.eye(4, dtype=np.float32)[channel])
    shares = dominant(renderer, level, 400.0)
    assert max(shares, key=shares.get) == name
    seen = luminance(from_above(renderer, level, 500.0, 320, "albedo", quality))
    found = autocorrelation(seen)
    shift = np.minimum(np.arange(640), 640 - np.arange(640))
    beyond = np.hypot(*np.meshgrid(shift, shift)) > 6
    assert found[0, 0] == pytest.approx(1)
    assert found[beyond].max() < 0.2


def test_the_test_of_periods_finds_one():
    rng = np.random.default_rng(2)
    tiled = np.tile(rng.standard_normal((64, 64)), (5, 5))
    assert autocorrelation(tiled)[64, 0] > 0.9


@pytest.mark.parametrize("quality", ["low", "medium"])
def test_a_far_beach_holds_still(renderer, quality):
    """L04: sand 2 km off, one sample a pixel; a millimetre's step changes no pixel of it by 2/255."""
    level = flat(1.6, 2049, water__on=False, **DRY)
    shots = []
    for step_m in (0.0, 0.001, 0.0013, -0.001):
        place = camera(x=1024.0 + step_m, y=-1000.0, z=60.0, yaw=0.0, pitch=-2.0, fov=5.0)
        shots.append(render(level, place, (160, 90), quality=quality, renderer=renderer).astype(int))
    position = render(level, place, (160, 90), view="position", linear=True, quality=quality, renderer=renderer)
    far = np.hypot(position[..., 0] - place.x, position[..., 1] - place.y)
    sand = (position[..., 2] > 1.5) & (far > 1200) & (far < 3000)
    assert sand.sum() > 4000
    for shot in shots[1:]:
        assert np.abs(shot - shots[0])[sand].max() < 2
    assert shots[0][sand].std() > 1


def dominant(renderer, level, span_m: float = 60.0) -> dict[str, float]:
    """Share of the picture from above that each material has in the view `ground`."""
    seen = from_above(renderer, level, span_m, 96, "ground").reshape(-1, 3)
    return {name: float((np.abs(seen - colour).max(axis=1) < 0.02).mean()) for name, colour in COLOURS.items()}


@pytest.mark.parametrize(
    ("name", "level"),
    [
        ("sand", flat(1.6, **DRY)),
        ("shingle", flat(0.5, ground__shingle=1.0)),
        ("strata", ground(lambda x, y: 40 + 1.4 * x, **DRY)),
        ("grass", flat(30.0)),
        ("dune grass", flat(4.6)),
        ("sea floor", flat(-3.0, water__on=False, ground__weed=0.0)),
        ("weed", flat(-6.0, water__on=False, ground__weed=1.0)),
    ],
)
def test_each_material_has_its_place(renderer, name, level):
    """L05: by height over the sea and slope; the view `ground` tells."""
    shares = dominant(renderer, level)
    assert max(shares, key=shares.get) == name
    assert shares[name] > 0.5


def test_broken_ground_by_the_sea_is_reef(renderer):
    rng = np.random.default_rng(3)
    broken = gaussian_filter(rng.standard_normal((SIDE, SIDE)), 2.0) * 14
    shares = dominant(renderer, ground(lambda x, y: 1.0 + broken, ground__sand_top_m=20.0, water__on=False, **DRY))
    assert shares["reef"] + shares["strata"] > 0.6


@pytest.mark.parametrize(("channel", "name"), [(0, "sand"), (1, "reef"), (2, "grass")])
def test_paint_overrides_the_rule(renderer, channel, name):
    """Sand, rock or grass painted where something else would lie."""
    level = flat(30.0 if name != "grass" else 1.2, **DRY)
    assert dominant(renderer, level)[name] < 0.3
    level.write("cover", Rect(0, 0, SIDE, SIDE), np.eye(4, dtype=np.float32)[channel])
    shares = dominant(renderer, level)
    assert shares[name] + shares["dune grass"] * (name == "grass") > 0.9


@pytest.mark.parametrize("knob", ["macro", "detail", "relief", "shingle", "weed"])
def test_every_knob_changes_the_picture(renderer, knob):
    """From eye height on a beach; weed from above a shallow bay."""
    level = ground(lambda x, y: 0.02 * y + 0.4, water__on=False)
    place = camera(x=128.0, y=120.0, z=2.2, yaw=0.0, pitch=-12.0)
    if knob == "weed":
        place = camera(x=128.0, y=20.0, z=20.0, yaw=180.0, pitch=-70.0)
        level = ground(lambda x, y: -5.0, water__on=False)
    if knob == "relief":
        level.write("height", Rect(0, 0, SIDE, SIDE), level.height + 2.0)
        level.write("cover", Rect(0, 0, SIDE, SIDE), np.eye(4, dtype=np.float32)[1])
    shots = []
    for value in (0.0, 1.0):
        level.set(f"ground.{knob}", value)
        shots.append(render(level, place, (160, 90), renderer=renderer).astype(int))
    assert np.abs(shots[0] - shots[1]).max() > 8


def relief_of(renderer, level, place) -> np.ndarray:
    """Height of the drawn ground less the samples', near the camera: `(n,)` metres."""
    position = render(level, place, (160, 90), view="position", linear=True, renderer=renderer).astype(np.float64)
    near = position[np.linalg.norm(position - [place.x, place.y, place.z], axis=-1) < 5]
    assert len(near) > 1000
    return near[:, 2] - level.height[0, 0]


@pytest.mark.parametrize(("channel", "most_m"), [(0, 0.02), (1, 0.12)])
def test_near_ground_has_relief_as_geometry(renderer, channel, most_m):
    """Rock stands up to 12 cm out, sand 2, with a mean of about nothing; with the knob at 0 the samples are kept."""
    level = flat(8.0)
    level.write("cover", Rect(0, 0, SIDE, SIDE), np.eye(4, dtype=np.float32)[channel])
    place = camera(x=128.0, y=128.0, z=9.7, yaw=0.0, pitch=-50.0, fov=70.0)
    relief = relief_of(renderer, level, place)
    assert relief.std() > 0.05 * most_m
    assert np.abs(relief).max() < 0.6 * most_m
    assert abs(relief.mean()) < 0.25 * most_m
    level.set("ground.relief", 0.0)
    assert np.abs(relief_of(renderer, level, place)).max() < 0.002


def test_sand_at_the_waters_edge_stays_where_it_is(renderer):
    level = flat(0.2)
    place = camera(x=128.0, y=128.0, z=1.9, yaw=0.0, pitch=-50.0, fov=70.0)
    level.set("water.on", False)
    level.write("cover", Rect(0, 0, SIDE, SIDE), np.eye(4, dtype=np.float32)[0])
    assert np.abs(relief_of(renderer, level, place)).max() < 0.003


def test_rows_of_the_table_reach_the_shader():
    rows = ground_uniforms()["u_ground_layers"]
    assert rows.shape == (len(MATERIALS), 4)
    assert (rows > 0).all()
