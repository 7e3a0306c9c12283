"""Scattered things in the picture: stateless wind, tiers, culling, their shadows and dark feet (L09, L03)."""

from pathlib import Path

import numpy as np
import pytest
from shorewright.app.session import Session
from shorewright.brushes import BRUSHES, Stroke
from shorewright.io import read_level
from shorewright.level import Grid, Journal, Level, Rect
from shorewright.level.objects import Camera
from shorewright.level.params import describe
from shorewright.level.scatter import INSTANCE
from shorewright.level.scatter_kinds import SCATTER
from shorewright.level.scatter_meshes import MESHES, mesh
from shorewright.level.settings import Settings
from shorewright.renderer import Renderer, Show, render
from shorewright.renderer import scatter as gathering
from shorewright.renderer.camera import camera_matrices
from shorewright.renderer.quality import TIERS
from test_scatter import SIDE, coast

pytestmark = pytest.mark.gl
SIZE = (160, 90)
EYE = Camera(id="eye", x=150, y=128, z=5.5, yaw_deg=330, pitch_deg=-12, fov_deg=60)
DRY = Show.hide("water")


@pytest.fixture
def draw(renderer):
    def run(level, view="final", camera=EYE, size=SIZE, show=DRY, quality="medium", time_s=3.0, linear=False):
        return render(level, camera, size, time_s, view, show, quality, linear=linear, renderer=renderer)

    return run


def test_wind_moves_grass_by_time_alone_and_not_without_sway(draw):
    """L09: stateless; the same time is the same bytes, no sway or no wind is no movement."""
    level = coast()
    first, later = draw(level), draw(level, time_s=4.3)
    assert not np.array_equal(first, later)
    assert np.array_equal(first, draw(level))
    for path in ("scatter.sway", "sea.wind_mps"):
        still = coast()
        still.set(path, 0.0)
        assert np.array_equal(draw(still), draw(still, time_s=4.3))


def test_hidden_is_the_same_as_switched_off(draw):
    level, off = coast(), coast()
    off.set("scatter.on", False)
    assert np.array_equal(draw(level, show=Show.hide("water,scatter")), draw(off))
    assert not np.array_equal(draw(level), draw(off))


def test_a_still_camera_sends_nothing_again(renderer, draw):
    """Instances go to the GPU when camera, level or tier change, and not with time."""
    level = coast()
    draw(level)
    sent = renderer.uploader.sent["scatter"], renderer.uploader.sent["casters"]
    draw(level, time_s=9.0)
    assert (renderer.uploader.sent["scatter"], renderer.uploader.sent["casters"]) == sent
    assert renderer.stats["scatter_triangles"] > 1000
    level.write("scatter", Rect(140, 140, 150, 150), 1.0)
    draw(level)
    assert renderer.uploader.sent["scatter"] > sent[0]


def crop_and_back(level):
    session = Session(level)
    session.crop(20, 10, 230, 240)
    yield
    session.undo()
    yield
    session.close()


def taken_anew(level):
    level.reset(Grid(SIDE, SIDE), np.ascontiguousarray(level.height[:, ::-1]))
    yield


@pytest.mark.parametrize("change", [crop_and_back, taken_anew])
@pytest.mark.parametrize("view", ["position", "prop_shadow"])
def test_another_grid_leaves_nothing_of_what_lay_on_the_last(ctx, renderer, draw, change, view):
    """L09, T08: import, crop, resize and recovery put another coast under the same level."""
    level = coast()
    draw(level, view)
    for _ in change(level):
        fresh = Renderer(ctx)
        expected = render(level, EYE, SIZE, 3.0, view, DRY, "medium", renderer=fresh)
        fresh.release()
        assert np.array_equal(draw(level, view), expected)


@pytest.mark.parametrize("size", [1.0, 10.0])
def test_tiles_are_left_out_only_when_all_on_them_would_be(monkeypatch, size):
    """L09: however large things are set to be."""
    level, eyes = coast(), []
    level.set("scatter.size", size)
    for yaw in range(0, 360, 30):
        matrices = camera_matrices(EYE.model_copy(update={"yaw_deg": yaw, "fov_deg": 25}), SIZE)
        eyes.append(gathering.Eye(matrices.position, matrices.planes, 0.0004))
    by_tile = [feet(gathering.gather(level, eye, TIERS["low"])) for eye in eyes]
    monkeypatch.setattr(gathering, "_tiles_seen", lambda level, tiles, *_: np.ones(len(tiles), bool))
    assert by_tile == [feet(gathering.gather(level, eye, TIERS["low"])) for eye in eyes]


@pytest.mark.parametrize("scale", [1.0, 0.5])
def test_all_samples_of_a_picture_draw_what_was_gathered_once(renderer, monkeypatch, scale):
    """L09: jitter asks for nothing again, and what it moves into the picture is there: same bytes as unculled."""
    whole, asked = gathering.gather, []

    def drawn(planes: bool):
        def counted(level, eye, tier):
            asked.append(eye)
            return whole(level, gathering.Eye(eye.position, eye.planes if planes else None, eye.pixel), tier)

        monkeypatch.setattr("shorewright.renderer.passes.scatter.gather", counted)
        renderer.draw(coast(), EYE, SIZE, 3.0, "final", DRY, "medium", samples=5, scale=scale)
        return renderer.read()

    culled = drawn(True)
    assert len(asked) == 1
    assert np.array_equal(culled, drawn(False))


def test_moving_and_still_pictures_take_turns_without_gathering(renderer, draw):
    """L09, L03: two tiers and sizes are kept; a third takes the place of the oldest."""
    level, kinds = coast(), [("low", (80, 45)), ("medium", SIZE)]

    def turn():
        return [draw(level, quality=quality, size=size) for quality, size in kinds]

    def sent():
        return renderer.uploader.sent["scatter"], renderer.uploader.sent["casters"]

    first, before = turn(), sent()
    assert all(np.array_equal(a, b) for a, b in zip(first, turn(), strict=True))
    assert sent() == before
    for size in ((64, 36), (96, 54)):
        draw(level, quality="high", size=size)
    assert len(renderer.kept["scatter"]) == 4
    assert all(np.array_equal(a, b) for a, b in zip(first, turn(), strict=True))


def feet(groups) -> set:
    return {(name, *row[:3].tolist()) for (name, _, _), rows in groups.items() for row in rows}


def test_a_tier_draws_what_the_one_below_draws_and_more():
    level, matrices = coast(), camera_matrices(EYE, SIZE)
    eye = gathering.Eye(matrices.position, matrices.planes, 0.0004)
    low, medium, high = (feet(gathering.gather(level, eye, tier)) for tier in TIERS.values())
    assert low < medium < high


@pytest.mark.parametrize("yaw", [20, 200, 290])
def test_culling_drops_nothing_that_is_seen(draw, monkeypatch, yaw):
    """Against everything in reach, sent without asking whether it is in the picture."""
    level = coast()
    camera = EYE.model_copy(update={"yaw_deg": yaw})
    culled, count = draw(level, "position", camera, linear=True), []
    whole = gathering.gather

    def everything(level, eye, tier, reached=None):
        groups = whole(level, gathering.Eye(eye.position, None, eye.pixel), tier, reached)
        count.append(sum(map(len, groups.values())))
        return groups

    monkeypatch.setattr("shorewright.renderer.passes.scatter.gather", everything)
    level.write("scatter", Rect(0, 0, 1, 1), 0.0)  # else what was gathered is kept
    level.set("level.seed", level.settings.level.seed)
    level.set("scatter.distance_m", level.settings.scatter.distance_m * (1 + 1e-12))
    assert np.array_equal(culled, draw(level, "position", camera, linear=True))
    assert count


@pytest.mark.parametrize("quality", TIERS)
def test_the_longest_distance_asks_for_a_bounded_number_of_places(quality):
    """L09: at the longest distance, from above over land without end; places are what making tiles costs."""
    level = coast()
    level.set("scatter.distance_m", next(r for r in describe(Settings) if r.name == "scatter.distance_m").high)
    places = 0.0
    for kind in SCATTER.values():
        places += np.pi * gathering.reach_m(level, kind, TIERS[quality]) ** 2 / kind.spacing_m**2
    assert places < 3e6


def test_what_is_too_small_to_see_is_not_made():
    """L09: a coarse picture leaves tiles alone that a fine one needs, and both leave out no visible thing."""
    made = []
    for pixel in (0.01, 0.001):
        level = coast()
        gathering.gather(level, gathering.Eye(np.array([128.0, 60.0, 6.0]), None, pixel), TIERS["medium"])
        made.append({key for key in level.derived["scatter"].held if key[0] == "cobble"})
    assert made[0] < made[1]


def test_paint_is_seen_in_the_next_frame(renderer, draw):
    level = coast()
    draw(level)
    before = renderer.stats["scatter_instances"]
    stroke = Stroke(level, Journal(level), BRUSHES["rocks"], BRUSHES["rocks"].with_params({"strength": 2.0}))
    stroke.begin(146, 138)
    draw(level)
    assert renderer.stats["scatter_instances"] > before
    stroke.abort()
    draw(level)
    assert renderer.stats["scatter_instances"] == before


def one_rock(monkeypatch, at=(128.0, 128.0), size=1.5, ground=4.0) -> Level:
    """Flat ground with one boulder, mesh variant 0, unturned."""
    level = Level(Grid(257, 257), np.full((257, 257), ground, np.float32))
    row = np.zeros(1, INSTANCE)
    row["x"], row["y"], row["z"], row["scale"], row["open"], row["tint"] = *at, ground, size, 1.0, 0.5
    monkeypatch.setattr(
        gathering, "near", lambda level, name, eye, far: row if name == "boulder" else np.empty(0, INSTANCE)
    )
    return level


def above(height=24.0, at=(128.0, 128.0), ground=4.0) -> Camera:
    return Camera(id="above", x=at[0], y=at[1], z=ground + height, yaw_deg=0, pitch_deg=-90, fov_deg=30)


@pytest.mark.parametrize("variant", range(MESHES["log"].variants))
def test_no_light_falls_between_a_log_and_its_shadow(draw, monkeypatch, variant):
    """L03: seen from the shady side at twice the log's length, ground that the trunk stands over is dark throughout."""
    level = Level(Grid(257, 257), np.full((257, 257), 4.0, np.float32))
    row = np.zeros(1, INSTANCE)
    row["x"], row["y"], row["z"], row["scale"], row["open"], row["variant"] = 128.3, 128.4, 4.0, 3.0, 1.0, variant
    row["yaw"] = 0.3
    monkeypatch.setattr(
        gathering, "near", lambda level, name, eye, far: row if name == "log" else np.empty(0, INSTANCE)
    )
    level.set("light.sun_azimuth_deg", 180.0)
    level.set("light.sun_elevation_deg", 35.0)
    eye = Camera(id="eye", x=128.3, y=132.0, z=5.5, yaw_deg=180, pitch_deg=-25, fov_deg=45)
    lit = draw(level, "prop_shadow", eye, (480, 270), linear=True)[..., 0]
    position = draw(level, "position", eye, (480, 270), linear=True)[..., :3]
    made = mesh("log", variant, 0).vertices[: 13 * 9].reshape(13, 9, 3) * 3.0
    # the trunk's shady side by its spine, turned back to where the log lies along x
    turn = np.array([[np.cos(0.3), np.sin(0.3)], [-np.sin(0.3), np.cos(0.3)]])
    local = (position[..., :2] - (128.3, 128.4)) @ turn.T
    side = np.interp(local[..., 0], made[..., 0].mean(axis=1), made[..., 1].max(axis=1))
    under = (np.abs(local[..., 0]) < 1.2) & (local[..., 1] > side - 0.1) & (local[..., 1] < side)
    under &= np.abs(position[..., 2] - 4.0) < 0.004
    assert under.sum() > 60
    assert lit[under].mean() < 0.15
    assert lit[under].max() < 0.5


@pytest.mark.parametrize(("azimuth", "way"), [(180.0, (0, 1)), (270.0, (1, 0)), (45.0, (-0.70711, -0.70711))])
@pytest.mark.parametrize("elevation", [45.0, 30.0])
def test_a_shadow_is_as_long_as_the_sun_makes_it(draw, monkeypatch, azimuth, way, elevation):
    """L03: on flat ground the tip lies where the ray over the mesh comes down, within a texel and its softness."""
    level = one_rock(monkeypatch)
    level.set("light.sun_azimuth_deg", azimuth)
    level.set("light.sun_elevation_deg", elevation)
    size = (240, 240)
    lit = draw(level, "prop_shadow", above(), size, linear=True)[..., 0]
    position = draw(level, "position", above(), size, linear=True)
    made = mesh("rock", 0, 2)
    vertices = made.vertices.astype(np.float64) * 1.5
    way = np.array(way)
    expected = (vertices[:, :2] @ way + vertices[:, 2] / np.tan(np.radians(elevation)))[vertices[:, 2] > 0].max()
    ground = np.abs(position[..., 2] - 4.0) < 0.02
    reach = ((position[..., :2] - 128.0) @ way)[ground & (lit < 0.5)].max()
    assert abs(reach - expected) < 0.10
    assert lit[ground & ((position[..., :2] - 128.0) @ way < -1.6)].min() == 1.0, "none on the sunny side"


def test_a_lit_face_is_not_in_its_own_shadow(draw, monkeypatch):
    """No acne: where a rock faces the sun it sees the sun."""
    level = one_rock(monkeypatch)
    level.set("light.sun_azimuth_deg", 180.0)
    level.set("light.sun_elevation_deg", 50.0)
    size = (240, 240)
    lit, normal, position = (
        draw(level, view, above(), size, linear=True)[..., :3] for view in ("prop_shadow", "normal", "position")
    )
    sun = np.array([0, -np.cos(np.radians(50)), np.sin(np.radians(50))])
    facing = (normal @ sun > 0.6) & (position[..., 2] > 4.3)
    assert facing.sum() > 300
    assert lit[..., 0][facing].mean() > 0.98


@pytest.mark.parametrize(("ground", "sea_m"), [(4, 0), (60, 0), (300, 0), (4, 500), (4, -500), (-30, 0)])
def test_things_throw_the_same_shadow_however_far_the_sea_is_below_or_above(draw, monkeypatch, ground, sea_m):
    """L03: heights in the map count from the still sea, and the squares follow the ground."""
    level = one_rock(monkeypatch, ground=ground)
    level.set("level.sea_level_m", sea_m)
    level.set("light.sun_azimuth_deg", 180.0)
    level.set("light.sun_elevation_deg", 45.0)
    lit = draw(level, "prop_shadow", above(ground=ground), (240, 240), linear=True)[..., 0]
    as_usual = one_rock(monkeypatch)
    as_usual.set("light.sun_azimuth_deg", 180.0)
    as_usual.set("light.sun_elevation_deg", 45.0)
    expected = draw(as_usual, "prop_shadow", above(), (240, 240), linear=True)[..., 0]
    dark = (lit < 0.5).sum(), (expected < 0.5).sum()
    assert dark[1] > 150
    assert abs(dark[0] - dark[1]) < 0.15 * dark[1]


def test_shadows_off_and_low_sun_leave_everything_lit(draw, monkeypatch):
    level = one_rock(monkeypatch)
    assert draw(level, "prop_shadow", above(), linear=True).min() < 0.1
    assert draw(level, "prop_shadow", above(), show=Show.hide("water,shadows"), linear=True).min() == 1.0
    level.set("light.sun_elevation_deg", -5.0)
    assert draw(level, "prop_shadow", above(), linear=True).min() == 1.0


def test_the_foot_of_a_rock_sees_less_sky_and_far_ground_all_of_it(renderer, draw, monkeypatch):
    """L03: contact occlusion multiplies the open sky round the foot and leaves albedo alone."""
    level = one_rock(monkeypatch)
    size = (240, 240)

    def albedo():
        draw(level, "final", above(), size)
        data = renderer.targets[size, size].textures["g_albedo"].read()
        return np.frombuffer(data, np.uint8).reshape(*size, 4).astype(int)

    with_feet = albedo()
    monkeypatch.setattr("shorewright.renderer.passes.contact.draw", lambda frame: None)
    without = albedo()
    assert np.array_equal(with_feet[..., :3], without[..., :3])
    darker = without[..., 3] - with_feet[..., 3]
    assert darker.min() >= 0
    y, x = np.mgrid[0:240, 0:240]
    away = np.hypot(x - 119.5, y - 119.5) * 24.0 * np.tan(np.radians(15)) / 120
    assert darker[(away > 1.3) & (away < 1.7)].mean() > 20
    assert darker[away > 1.75 * 1.5 + 0.1].max() == 0


def test_the_view_of_kinds_shows_their_colours(draw):
    level = coast()
    seen = draw(level, "scatter", linear=True).reshape(-1, 3)
    shown = [name for name, kind in SCATTER.items() if (np.abs(seen - kind.colour).max(axis=1) < 0.02).any()]
    assert len(shown) >= 3


def test_without_things_the_view_of_kinds_is_grey(draw):
    """L09: the lace that the waves leave on the sand is no kind."""
    level = read_level(Path(__file__).parents[1] / "sample_levels" / "cove.shore")
    beach, moments = level.camera("beach"), (2.0, 6.0, 10.0, 14.0)
    assert max(draw(level, "lace", beach, show=Show(), time_s=t, linear=True).max() for t in moments) > 0.5
    level.set("scatter.on", False)
    for moment in moments:
        seen = draw(level, "scatter", beach, show=Show(), time_s=moment, linear=True)
        assert np.ptp(seen, axis=-1).max() == 0
