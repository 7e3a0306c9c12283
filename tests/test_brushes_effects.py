"""What each brush does to the ground (T01, D31), against the same maths on a plain array."""

import numpy as np
import pytest
from shorewright.brushes import BRUSHES, Stroke
from shorewright.brushes.footprint import Link, Round
from shorewright.level import Grid, Journal, Level, Rect

CROSSING = [(70, 60), (200, 190), (200, 60), (70, 190), (71.3, 60.2)]


def rough(rows=300, cols=280, sigma=1.0, tilt=0.05, seed=5):
    y, x = np.mgrid[:rows, :cols]
    noise = np.random.default_rng(seed).normal(size=(rows, cols)) * sigma
    return (noise + y * tilt - x * tilt / 3 + 4).astype(np.float32)


def level_of(height, cell_m=1.0):
    return Level(Grid(*height.shape, cell_m), height)


def stroke_on(level, name, points, invert=False, smooth=False, **params):
    """An open stroke, every point played."""
    brush = BRUSHES[name]
    stroke = Stroke(level, Journal(level), brush, brush.with_params(params), invert, smooth)
    stroke.begin(*points[0])
    for point in points[1:]:
        stroke.move(*point)
    return stroke


def drag(height, name, points, **options):
    level = level_of(height)
    stroke_on(level, name, points, **options).end()
    return level.height


def plain_mask(shape, points, size, falloff=0.7, spacing=0.1, released=False):
    """The greatest weight of any dab, on one array without tiles."""
    footprint, mask = Round(size, falloff), np.zeros(shape, np.float32)
    stroke = stroke_on(level_of(np.zeros(shape, np.float32)), "raise", [points[0]], size_m=size, falloff=falloff)
    path = type(stroke.path)(spacing * size, 1.0, stroke.path.bounds)
    dabs = list(path.begin(stroke.samples[0]))
    for x, y in points[1:]:
        dabs += path.move(stroke.samples[0]._replace(x=x, y=y))
    for start, end in dabs + (list(path.end()) if released else []):
        out, *spare = (np.empty(shape, np.float32) for _ in range(3))
        link = Link(start.y, start.x, end.y, end.x)
        np.maximum(mask, footprint.weights(link, Rect(0, 0, *shape), out, *spare), out=mask)
    return mask


@pytest.mark.parametrize("size", [7.3, 41.0, 230.0])
def test_raise_is_base_plus_strength_times_mask_with_no_seam(size):
    """T01: the very bytes of the same stroke on a plain array, across tiles, before the release rounds."""
    base = rough()
    points = CROSSING if size < 100 else [(-30, 140), (40, 150)]
    stroke = stroke_on(level_of(base), "raise", points, size_m=size, strength=3, opacity=0.4)
    mask = plain_mask(base.shape, points, size)
    expected = base + mask * np.float32(3 * 0.4)
    assert stroke.level.height.tobytes() == expected.tobytes()
    stroke.end()
    expected = base + plain_mask(base.shape, points, size, released=True) * np.float32(3 * 0.4)
    np.testing.assert_allclose(stroke.level.height, expected, atol=3e-6)


@pytest.mark.parametrize("opacity", [0.3, 1.0])
@pytest.mark.parametrize("name", ["raise", "lower"])
def test_a_crossing_stroke_does_not_double(name, opacity):
    height = drag(np.zeros((300, 280), np.float32), name, CROSSING, size_m=20, strength=2, opacity=opacity)
    assert np.abs(height).max() == pytest.approx(2 * opacity, rel=1e-5)
    assert abs(height[125, 135]) == pytest.approx(2 * opacity, rel=1e-3)  # where it crosses itself


def test_a_stroke_leaves_no_scallops():
    """Between two dabs the ground is as high as at them, at any spacing."""
    height = drag(
        np.zeros((120, 300), np.float32), "raise", [(40, 60.3), (260, 60.3)], size_m=30, strength=10, spacing=0.8
    )
    along = height[40:80, 60:240]
    assert np.ptp(along, axis=1).max() < 1e-5


@pytest.mark.parametrize("falloff", [0.3, 0.7, 1.0])
def test_a_pen_that_is_pressed_harder_leaves_no_steps(falloff):
    points = [(60 + way, 60.3, 0.2 + way / 250) for way in range(0, 200, 3)]
    height = drag(np.zeros((120, 320), np.float32), "raise", points, size_m=40, strength=10, falloff=falloff)
    grade = np.diff(height[58:63, 70:200], axis=1)
    assert grade.mean() == pytest.approx(0.04, rel=0.05)
    assert np.abs(grade - grade.mean()).max() < 0.2 * grade.mean()


@pytest.mark.parametrize("name", ["raise", "lower"])
def test_control_turns_raise_and_lower_round(name):
    other = {"raise": "lower", "lower": "raise"}[name]
    points = [(60, 60, 0.3), (150, 140, 1.0)]
    inverted = drag(rough(), name, points, invert=True, size_m=25)
    assert inverted.tobytes() == drag(rough(), other, points, size_m=25).tobytes()
    assert not np.array_equal(inverted, rough())


# Smooth


@pytest.mark.parametrize("ground", [0.0, 0.1, -7.3, 8848.86, 1e-3])
@pytest.mark.parametrize("options", [{}, {"opacity": 0.37}, {"invert": True}])
def test_flat_ground_stays_flat_to_the_last_bit(ground, options):
    flat = np.full((200, 210), ground, np.float32)
    height = drag(flat, "smooth", [(-5, -5), (60, 70), (150, 90), (230, 120)], size_m=50, strength=0.9, **options)
    assert height.tobytes() == flat.tobytes()


def test_flat_ground_beside_a_cliff_stays_flat_to_the_last_bit():
    """Only cells within reach of the cliff may move."""
    ground = np.full((160, 260), np.float32(0.1))
    ground[:, 200:] = 37.77
    height = drag(ground, "smooth", [(100, 80)], size_m=60, detail=0.1)
    assert height[:, :180].tobytes() == ground[:, :180].tobytes()
    height = drag(ground, "smooth", [(215, 80)], size_m=60, detail=0.1)
    assert height[:, :187].tobytes() == ground[:, :187].tobytes()
    assert not np.array_equal(height, ground)


def test_a_dab_of_smooth_is_the_mean_by_its_weight():
    """h + strength · w · (mean − h), the mean by [1 2 1] / 4 at steps 4, 2, 1 in rows and columns, in float64."""
    ground = rough()
    height = drag(ground, "smooth", [(140.3, 150.6)], size_m=20, strength=0.6, detail=0.2)
    kernel = np.ones(1)
    for step in (4, 2, 1):
        kernel = np.convolve(kernel, np.bincount([0, step, step, 2 * step]) / 4)
    mean = ground.astype(np.float64)
    for axis in (0, 1):
        mean = np.apply_along_axis(np.convolve, axis, mean, kernel, "same")
    weight = plain_mask(ground.shape, [(140.3, 150.6)], 20)
    np.testing.assert_allclose(height, ground + 0.6 * weight * (mean - ground), atol=1e-5)


def test_a_slope_that_meets_the_border_stays_as_it_is():
    y, x = np.mgrid[:150, :140].astype(np.float32)
    slope = y * 0.25 - x * 0.125  # exact in float32
    height = drag(slope, "smooth", [(-3, -3), (0, 70), (139, 149), (70, 0)], size_m=40, strength=0.9)
    np.testing.assert_allclose(height, slope, atol=2e-5)


def test_smooth_calms_noise_in_the_middle_and_at_the_border():
    ground = rough(tilt=0)
    height = drag(ground, "smooth", [(0, 0), (0, 299), (0, 0), (140, 0), (140, 299)], size_m=30, strength=0.9)
    assert height[60:240, 135:145].std() < 0.25 * ground.std()
    assert height[60:240, :5].std() < 0.25 * ground.std()
    assert height[:5, 20:120].std() < 0.35 * ground.std()
    assert np.array_equal(height[100:200, 60:90], ground[100:200, 60:90])


def test_a_dab_of_smooth_reads_only_what_was_there_before_it():
    """Gather first, then write: a dab turned by a quarter gives the turned result, whatever the order of tiles."""
    ground = rough(257, 257)
    size = {"size_m": 90, "strength": 0.8, "detail": 0.15}
    height = drag(ground, "smooth", [(128, 128)], **size)
    for turns in (1, 2, 3):
        turned = drag(np.ascontiguousarray(np.rot90(ground, turns)), "smooth", [(128, 128)], **size)
        np.testing.assert_allclose(turned, np.rot90(height, turns), atol=1e-5)


def test_smooth_hardly_depends_on_spacing():
    ground = rough(tilt=0)
    points = [(60, 150), (220, 150)]
    close, wide = (drag(ground, "smooth", points, size_m=30, spacing=spacing) for spacing in (0.05, 0.4))
    middle = (slice(148, 153), slice(100, 180))
    assert close[middle].std() == pytest.approx(wide[middle].std(), rel=0.2)
    assert close[middle].std() < 0.5 * ground[middle].std()


def test_opacity_bounds_how_far_smooth_goes():
    ground = rough(tilt=0)
    rubbed = [(100, 150), (180, 150)] * 6
    height = drag(ground, "smooth", rubbed, size_m=30, strength=0.9, opacity=0.4)
    middle = (slice(148, 153), slice(110, 170))
    assert 0.55 * ground[middle].std() < height[middle].std() < 0.7 * ground[middle].std()


def test_sharpening_is_bounded():
    ground = rough(tilt=0)
    once = drag(ground, "smooth", [(140, 150)], invert=True, size_m=40, strength=1.0)
    rubbed = drag(ground, "smooth", [(140, 150), (145, 150)] * 10, invert=True, size_m=40, strength=1.0)
    assert once[140:160, 130:150].std() > 1.5 * ground[140:160, 130:150].std()
    assert np.abs(rubbed - ground).max() < 2 * np.abs(ground - ground.mean()).max()


@pytest.mark.parametrize(
    "name", [row.name for row in BRUSHES.values() if row.layer == "height" and row.name != "smooth"]
)
def test_shift_smooths_with_any_brush(name):
    points, shape = [(60, 60), (150, 140)], {"size_m": 25.0, "falloff": 0.6, "spacing": 0.2, "opacity": 0.8}
    shifted = drag(rough(), name, points, smooth=True, **shape)
    assert shifted.tobytes() == drag(rough(), "smooth", points, **shape).tobytes()
    assert not np.array_equal(shifted, rough())


# Flatten


def test_flatten_goes_to_the_height_where_it_began():
    ground = rough()
    height = drag(ground, "flatten", [(60, 70), (180, 200)], size_m=20, falloff=0.3)
    level = ground[70, 60]
    assert height[195:205, 175:185] == pytest.approx(level, abs=1e-5)
    assert height[120, 115] == pytest.approx(level, abs=1e-5)


@pytest.mark.parametrize(("side", "sign"), [("cut", -1), ("fill", 1)])
def test_flatten_can_work_on_one_side(side, sign):
    ground = rough()
    change = drag(ground, "flatten", [(140, 150)], size_m=40, side=side) - ground
    assert (change * sign >= 0).all()
    assert (change * sign > 0.5).any()


def test_flatten_turned_round_drives_away_from_the_level():
    ground = rough()
    height = drag(ground, "flatten", [(140, 150)], size_m=40, falloff=0.2, invert=True)
    level, near = ground[150, 140], (slice(140, 160), slice(130, 150))
    np.testing.assert_allclose(height[near] - level, 2 * (ground[near] - level), atol=1e-5)


def test_flatten_from_outside_takes_the_border():
    ground = rough()
    height = drag(ground, "flatten", [(-12, 150), (20, 150)], size_m=15, falloff=0.2)
    assert height[150, 0:25] == pytest.approx(ground[150, 0], abs=1e-5)
