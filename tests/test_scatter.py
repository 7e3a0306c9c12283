"""Where scattered things stand: rules, paint, tiles that don't know each other, meshes (L09)."""

import numpy as np
import pytest
from shorewright.brushes import BRUSHES, Stroke
from shorewright.level import BadInput, Grid, Journal, Level, Rect
from shorewright.level import scatter as placing
from shorewright.level.params import describe
from shorewright.level.scatter import TILE_M, scatter_instances, scatter_tiles, sync, tiles_within
from shorewright.level.scatter_kinds import SCATTER
from shorewright.level.scatter_meshes import MESHES, mesh
from shorewright.level.settings import Settings

SIDE = 257
FULL = {"rocks": 1.5, "driftwood": 1.5, "grass": 1.5}


def coast() -> Level:
    """Sea to the south, a beach, dunes, a cliff 20 m high across the west half, a meadow behind."""
    y, x = np.mgrid[0:SIDE, 0:SIDE].astype(np.float64)
    height = (y - 90) * 0.06
    height = np.where((x < 128) & (y > 140), height + 20 * np.clip((y - 140) / 6, 0, 1), height)
    level = Level(Grid(SIDE, SIDE), height.astype(np.float32))
    for name, amount in FULL.items():
        level.set(f"scatter.{name}", amount)
    return level


def paint(level, brush, points, journal=None, **params):
    stroke = Stroke(level, journal or Journal(level), BRUSHES[brush], BRUSHES[brush].with_params(params))
    stroke.begin(*points[0])
    for point in points[1:]:
        stroke.move(*point)
    stroke.end()


def everything(level) -> dict[str, bytes]:
    return {name: scatter_instances(level, name).tobytes() for name in SCATTER}


@pytest.fixture(scope="module")
def placed():
    level = coast()
    return level, {name: scatter_instances(level, name) for name in SCATTER}


def over(level, found):
    return found["z"] - level.sea_level_m


def test_every_kind_stands_somewhere_and_is_where_it_says(placed):
    """L09: rocks, driftwood and grass by rule, out of the box."""
    level, found = placed
    for name, kind in SCATTER.items():
        rows = found[name]
        assert len(rows) > 3, name
        assert all(np.isfinite(rows[field]).all() for field in rows.dtype.names)
        assert rows["scale"].min() >= kind.size_m[0] * 0.999
        assert rows["scale"].max() <= kind.size_m[1] * 1.001
        assert np.median(rows["scale"]) < np.mean(kind.size_m), "few large ones, many small"
        assert set(np.unique(rows["variant"])) <= set(range(MESHES[kind.mesh].variants))
        ground = placing.ground_at(level, rows["x"].astype(float), rows["y"].astype(float))
        sunk = ground - rows["z"]
        assert sunk.min() > -0.01
        assert (sunk <= kind.sink * rows["scale"] + 0.01).all()
        assert (rows["normal_x"] ** 2 + rows["normal_y"] ** 2 < 1).all()


def test_the_same_level_gives_the_same_bytes_and_another_seed_others(placed):
    found = placed[1]
    assert everything(coast()) == {name: rows.tobytes() for name, rows in found.items()}
    other = coast()
    other.set("level.seed", 8)
    for name, rows in found.items():
        assert scatter_instances(other, name).tobytes() != rows.tobytes()


def test_a_tile_is_the_same_alone_and_among_others():
    """Whatever is asked for first, and in what company."""
    whole, single = coast(), coast()
    tiles = tiles_within(whole, 0, 0, SIDE, SIDE)
    for name in SCATTER:
        together = scatter_tiles(whole, name, tiles)
        for tile in reversed(tiles[20:60:7]):
            assert scatter_tiles(single, name, [tile])[tile].tobytes() == together[tile].tobytes()


@pytest.mark.parametrize("layer", ["height", "cover", "scatter"])
def test_a_change_makes_again_only_what_it_touches_and_as_a_new_level_would(layer):
    """L09: a stroke in one place leaves all else bit-identical, and nothing of it is worked out again."""
    level = coast()
    before = {(name, *tile): rows for name in SCATTER
              for tile, rows in scatter_tiles(level, name, tiles_within(level, 0, 0, SIDE, SIDE)).items()}  # fmt: skip
    place = Rect(110, 150, 124, 166)
    values = level.height[place.slices] + 1.5 if layer == "height" else 0.9
    level.write(layer, place, values)
    held = sync(level).held
    far = [key for key in before if key not in held]
    assert far
    reach = placing.LAYERS_READ[layer] + 3
    for _, col, row in far:
        assert col * TILE_M <= place.col1 + reach
        assert (col + 1) * TILE_M >= place.col0 - reach
        assert row * TILE_M <= place.row1 + reach
        assert (row + 1) * TILE_M >= place.row0 - reach
    assert all(held[key] is before[key] for key in before if key in held)
    fresh = coast()
    fresh.write(layer, place, values)
    assert everything(level) == everything(fresh)
    assert any(everything(fresh)[name] != everything(coast())[name] for name in SCATTER)


def test_ground_that_was_only_looked_at_counts_as_changed_too():
    """L09: a tile out of sight has heights and no instances; when it rises into sight, pictures must notice."""
    level = coast()
    low = placing.tile_ranges(level, [(3, 3)])
    before = sync(level).changes
    level.write("height", Rect(100, 100, 110, 110), 90.0)
    assert sync(level).changes > before
    assert placing.tile_ranges(level, [(3, 3)])[0, 1] == 90.0 > low[0, 1]


ROWS = [row for row in describe(Settings) if row.name.split(".")[0] in ("level", "ground", "shore", "scatter")]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.name)
def test_settings_make_again_what_reads_them_and_nothing_else_does(row):
    """L09: a slider of the ground's look leaves the tiles; one that a rule reads doesn't leave old ones."""
    value = row.default
    other = not value if row.kind == "bool" else 0.5 * (value + row.low) if row.low < value else 0.5 * row.high
    other = int(other) if row.kind == "int" else other
    level, fresh = coast(), coast()
    area = Rect(40, 90, 170, 180)
    before = {name: scatter_instances(level, name, area) for name in SCATTER}
    tiles = dict(sync(level).held)
    level.set(row.name, other)
    fresh.set(row.name, other)
    held, read = sync(level).held, row.name in placing.SETTINGS_READ
    assert set(held) == (set() if read else set(tiles))
    assert all(held[key] is tiles[key] for key in held)
    after = {name: scatter_instances(fresh, name, area) for name in SCATTER}
    same = all(before[name].tobytes() == after[name].tobytes() for name in SCATTER)
    assert same != read


def test_rules(placed):
    """No rocks in deep water, no grass in the swash or on walls, driftwood on the strand line."""
    level, found = placed
    top = level.settings.shore.range_m * level.settings.shore.runup
    for name, rows in found.items():
        h = over(level, rows) + SCATTER[name].sink * rows["scale"]
        on_wall = (rows["x"] < 128) & (rows["y"] > 141) & (rows["y"] < 145)
        if SCATTER[name].channel == "rocks":
            assert h.min() > -5
        elif SCATTER[name].channel == "driftwood":
            assert over(level, rows).min() > top - 0.05
            assert h.max() < top + 1.1
        else:
            assert over(level, rows).min() > top
            assert not on_wall.any()
    x, y = found["boulder"]["x"], found["boulder"]["y"]
    near = ((x < 140) & (np.abs(y - 138) < 14)) | ((np.abs(x - 130) < 14) & (y > 130))
    assert near.mean() > 0.8, "boulders lie at the foot of the cliff"


@pytest.mark.parametrize(("sand_top_m", "runup"), [(-8.0, 0.13), (1.605, 0.13), (0.5, 0.5), (3.2, 0.6)])
def test_grass_drowns_whatever_the_sand_and_the_swash(sand_top_m, runup):
    """L09: where turf is set to begin under water, and where waves run up beyond the sand."""
    level = coast()
    level.set("ground.sand_top_m", sand_top_m)
    level.set("shore.runup", runup)
    top = level.settings.shore.range_m * runup
    for name in ("dune_grass", "meadow"):
        rows = scatter_instances(level, name)
        assert len(rows)
        assert (over(level, rows) + SCATTER[name].sink * rows["scale"]).min() > top


@pytest.mark.parametrize("name", SCATTER)
def test_the_amount_counts_all_the_way_up(name):
    """L09: none at 0, more with each step, nothing that stood goes; from 1 to 4 by 1.8 where there is room.

    Boulders fill the whole foot of this coast's cliff at 2 already.
    """
    level, counts, before = coast(), [], set()
    for amount in (0.0, 0.5, 1.0, 2.0, 4.0):
        level.set(f"scatter.{SCATTER[name].channel}", amount)
        rows = scatter_instances(level, name)
        places = set(zip(rows["x"].tolist(), rows["y"].tolist(), strict=True))
        assert before <= places
        before = places
        counts.append(len(rows))
    assert counts[0] == 0
    assert (np.diff(counts) > 0).all()
    assert counts[4] > (1.2 if name == "boulder" else 1.8) * counts[2]


def test_driftwood_lies_along_the_shore(placed):
    """The contour runs east and west here; most of it is within 45° of that."""
    yaw = placed[1]["branch"]["yaw"]
    assert (np.abs(np.cos(yaw)) > 0.707).mean() > 0.7


@pytest.mark.parametrize("brush", ["rocks", "driftwood", "tufts"])
def test_paint_fills_and_empties_and_undo_brings_back(brush):
    """L09: −1 none, +1 many where the rule has none, 0 the rule; Ctrl and the mode turn it round."""
    level = coast()
    journal, before = Journal(level), everything(level)
    channel = BRUSHES[brush].channels[0]
    names = [name for name, kind in SCATTER.items() if kind.channel == channel]
    spot = Rect(150, 190, 166, 206)  # on the meadow
    options = {"size_m": 30, "strength": 2.0, "falloff": 0.1, "spacing": 0.3}

    def count():
        return sum(len(scatter_instances(level, name, spot)) for name in names)

    ruled = count()
    paint(level, brush, [(198, 158)], journal, mode="add", **options)
    assert np.isclose(level.layers["scatter"].read(spot).max(), 1.0)
    many = count()
    paint(level, brush, [(198, 158)], journal, mode="remove", **options)
    none = count()
    assert many > ruled
    assert many >= sum(0.25 * kind.full * 256 / kind.spacing_m**2
                       for kind in SCATTER.values() if kind.channel == channel)  # fmt: skip
    assert none == 0
    paint(level, brush, [(198, 158)], journal, mode="reset", **options)
    assert count() == ruled
    for _ in range(3):
        journal.undo()
    assert everything(level) == before


def test_paint_stays_in_its_channel_and_range_and_does_not_double():
    level = coast()
    paint(level, "driftwood", [(60, 60), (110, 60), (60, 60)], size_m=12, strength=0.6, falloff=0.0)
    painted = level.layers["scatter"].array
    assert not painted[..., [0, 2]].any()
    assert np.isclose(painted[..., 1].max(), 0.6, atol=1e-3), "a stroke that crosses itself paints once"
    for _ in range(3):
        paint(level, "driftwood", [(60, 60), (110, 60)], size_m=12, strength=0.6, falloff=0.0)
    assert painted[..., 1].max() == 1.0
    paint(level, "driftwood", [(60, 60)], size_m=12, strength=0.4, falloff=0.0, mode="reset")
    assert np.isclose(painted[60, 60, 1], 0.6, atol=1e-3)


def test_an_open_stroke_shows_and_an_aborted_one_leaves_nothing():
    level = coast()
    before = everything(level)
    stroke = Stroke(level, Journal(level), BRUSHES["tufts"], BRUSHES["tufts"].with_params({"strength": 2.0}))
    stroke.begin(200, 100)
    assert everything(level) != before
    stroke.abort()
    assert everything(level) == before


def test_an_unknown_kind_is_one_sentence():
    with pytest.raises(BadInput, match="boulder"):
        scatter_instances(coast(), "gnomes")


@pytest.mark.parametrize(("family", "detail"), [(n, d) for n, row in MESHES.items() for d in range(row.details)])
def test_meshes_are_sound(family, detail):
    """L09: unit normals, no waste, fewer triangles with less detail, sway from root to tip; closed ones are closed."""
    for variant in range(MESHES[family].variants):
        made = mesh(family, variant, detail)
        assert np.allclose(np.linalg.norm(made.normals, axis=1), 1, atol=1e-4)
        assert set(np.unique(made.indices)) == set(range(len(made.vertices)))
        a, b, c = (made.vertices[made.indices[:, i]].astype(np.float64) for i in range(3))
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        assert area.min() > 0
        if detail:
            assert len(made.indices) < 0.6 * len(mesh(family, variant, detail - 1).indices)
        if "grass" in family or family == "tussock":
            assert made.sway.max() == 1
            assert made.vertices[made.sway == 0, 2].max() < 0
        else:
            assert not made.sway.any()
            edges = np.sort(made.indices[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
            assert (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()
            volume = np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6
            assert volume > 0, "triangles run counter-clockwise seen from outside"
            assert made.vertices[:, 2].min() < 0, "its foot is in the ground"


def bumpy() -> Level:
    """A strand that falls to the south, with hollows and humps 7 m wide and single high samples."""
    y, x = np.mgrid[0:SIDE, 0:SIDE].astype(np.float64)
    height = 0.9 + (y - 128) * 0.004 + 0.10 * np.sin(0.9 * x) * np.sin(0.8 * y) + 0.25 * ((3 * x + 7 * y) % 41 == 0)
    level = Level(Grid(SIDE, SIDE), height.astype(np.float32))
    level.set("scatter.driftwood", 4.0)
    level.set("ground.sand_top_m", 6.0)
    return level


@pytest.mark.parametrize(("kind", "size"), [("log", 1.0), ("log", 2.0), ("branch", 1.0)])
def test_driftwood_lies_on_the_ground_from_end_to_end(kind, size):
    """L09: neither end nor the middle floats by more than 5 cm, and no more than 60 % of a log is in the ground."""
    level = bumpy()
    level.set("scatter.size", size)
    rows = scatter_instances(level, kind)
    assert len(rows) > 30
    floating, buried = [], []
    for row in rows.astype([(name, np.float64) for name in rows.dtype.names]):
        made = mesh(SCATTER[kind].mesh, int(row["variant"]), 0).vertices[: 13 * 9].astype(np.float64)  # the trunk
        up = np.array([row["normal_x"], row["normal_y"], 0.0])
        up[2] = np.sqrt(1 - up @ up)
        east = np.array([np.cos(row["yaw"]), np.sin(row["yaw"]), 0.0])
        east = (east - up * (east @ up)) / np.linalg.norm(east - up * (east @ up))
        at = made @ np.array([east, np.cross(up, east), up]) * row["scale"] + (row["x"], row["y"], row["z"])
        for ring in at.reshape(13, 9, 3)[[0, 6, 12]]:
            low, high = ring[ring[:, 2].argmin()], ring[:, 2].max()
            along = (ring.mean(axis=0) - (row["x"], row["y"], row["z"])) @ east  # it may be bent aside
            ground = float(placing.ground_at(level, row["x"] + along * east[0], row["y"] + along * east[1]))
            floating.append(low[2] - ground)
            buried.append((ground - low[2]) / (high - low[2]))
    assert max(floating) < 0.05
    if kind == "log":
        assert max(buried) < 0.6
    assert max(np.abs(rows["normal_x"])) > 0.02


def test_driftwood_looks_at_the_ground_as_far_as_it_reaches():
    """L09: a change under the end of the longest log makes its tile again."""
    level, fresh = bumpy(), bumpy()
    for each in (level, fresh):
        each.set("scatter.size", 8.0)
    place = Rect(120, 120, 136, 136)
    before = scatter_instances(level, "log").tobytes()
    for each in (level, fresh):
        each.write("height", place, 3.0)
    assert scatter_instances(level, "log").tobytes() == scatter_instances(fresh, "log").tobytes() != before
