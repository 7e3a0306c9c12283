"""The mesh along the waterline (H03): closed forms, no crack at its border, u without a jump."""

import numpy as np
import pytest
from coasts import make_beach
from scipy.spatial import cKDTree
from shorewright.level import Grid, Level
from shorewright.level.beach_even import shape_slopes
from shorewright.level.beach_fit import LEAST_M, misses
from shorewright.level.beach_mesh import CLEAR_M, _border, beach_cells, beach_mesh
from shorewright.level.beach_raster import beach_raster
from shorewright.level.objects import SeaPatch
from shorewright.level.patches import BASE_M


def island(radius_m=45.0, side=201, others=()):
    """A cone that stands out of the sea, and more of them at (x, y, radius)."""
    y, x = np.mgrid[0:side, 0:side].astype(float)
    height = np.full((side, side), -50.0)
    for east, north, radius in ((100, 100, radius_m), *others):
        height = np.maximum(height, 0.2 * (radius - np.hypot(x - east, y - north)))
    return Level(Grid(side, side), height.astype(np.float32))


LEVELS = {
    "beach": make_beach,
    "rough": lambda: make_beach(rough_m=0.25),
    "island": island,
    "strait": lambda: island(30.0, others=((155, 100, 18.0), (60, 145, 12.0))),
}


@pytest.fixture(params=LEVELS)
def level(request):
    return LEVELS[request.param]()


def test_it_fills_its_cells_and_faces_up(level):
    """H03: whole cells of 10 m, each place once."""
    mesh = beach_mesh(level)
    assert mesh.area_m2.min() > 0
    assert mesh.area_m2.sum() == pytest.approx(100 * beach_cells(level).sum(), rel=1e-9)


def test_no_crack_at_its_border(level):
    """H03: outer edges are those of the 10 m grid, one for one, at the base mesh's bias; all others have two sides."""
    mesh, cells = beach_mesh(level), beach_cells(level)
    _, place = np.unique(np.round(mesh.xy, 6), axis=0, return_inverse=True)
    place = place.ravel()
    edges = np.sort(place[mesh.triangles][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    pairs, first, count = np.unique(edges, axis=0, return_index=True, return_counts=True)
    assert count.max() == 2
    ends = mesh.xy[mesh.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)[first[count == 1]]]
    assert np.abs(ends / BASE_M - np.round(ends / BASE_M)).max() < 1e-9
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1) == pytest.approx(BASE_M)
    wide = np.pad(cells, 1)
    assert len(ends) == (wide[1:] != wide[:-1]).sum() + (wide[:, 1:] != wide[:, :-1]).sum()
    rim = np.isin(place, pairs[count == 1])
    np.testing.assert_array_equal(rim, mesh.border)
    assert (mesh.colours[rim, 0] == 1).all()
    assert np.unique(np.column_stack([place, mesh.colours[:, 0]]), axis=0).shape[0] == place.max() + 1  # one bias each


def test_sand_follows_rock_within_its_error():
    """H03: outside the circles round the border's edges none that has room is missed by more than `error_m`."""
    level = make_beach(rows=161, cols=161)
    y, x = np.mgrid[0:161, 0:161]
    for east, north, high_m in ((40, 78, 3.0), (95, 86, 2.0), (120, 70, -1.5)):
        level.write("height", level.grid.rect, np.float32(
            level.height + high_m * np.exp(-((x - east) ** 2 + (y - north) ** 2) / 50.0)))  # fmt: skip
    found = {}
    for error_m in (20.0, 0.3, 0.1):
        level.set("beach_mesh.error_m", error_m)
        mesh = beach_mesh(level)
        _, places, off_m = misses(level, mesh.xy, mesh.triangles)
        middles = _border(beach_cells(level))[0]
        free = cKDTree(middles).query(places)[0] > CLEAR_M
        room = cKDTree(mesh.xy).query(places)[0] >= LEAST_M
        found[error_m] = off_m[free & room].max(), len(mesh.triangles)
    assert found[20.0][0] > 0.4
    assert found[0.3][0] <= 0.3
    assert found[0.1][0] <= 0.1
    assert found[0.1][1] > found[0.3][1] > found[20.0][1]


def test_u_runs_on_within_every_triangle(level):
    """H03: u differs no more than its corners are apart, but for what a bend of the shore adds."""
    mesh = beach_mesh(level)
    corners, u = mesh.xy[mesh.triangles], mesh.uv[mesh.triangles][..., 0]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        apart = np.linalg.norm(corners[:, a] - corners[:, b], axis=1)
        assert (np.abs(u[:, a] - u[:, b]) / apart).max() < 12
        assert np.abs(u[:, a] - u[:, b]).max() < 60


def test_u_grows_everywhere(level):
    """H03: no fan of triangles has one u throughout, few run backwards, and the waterline keeps its own length."""
    mesh = beach_mesh(level)
    slopes, area = shape_slopes(mesh.xy, mesh.triangles)
    grows = np.linalg.norm(np.einsum("tk,tkd->td", mesh.uv[:, 0][mesh.triangles], slopes), axis=1)
    assert area[grows < 0.1].sum() < 0.02 * area.sum()
    along = np.einsum("td,td->t", np.einsum("tk,tkd->td", mesh.uv[:, 0][mesh.triangles], slopes),
                      mesh.tangent[mesh.triangles].mean(1))  # fmt: skip
    assert area[along < 0].sum() < 0.05 * area.sum()
    assert 0.8 < np.average(grows, weights=area) < 1.4


def test_a_straight_beach_in_closed_form():
    """H03: u is the way west with the sea on the left, v straight across, masks by distance."""
    level = make_beach()
    level.set("level.sea_level_m", 0.0)
    mesh, settings = beach_mesh(level), level.settings.beach_mesh
    shore_y = 64.0
    assert mesh.uv[:, 0] == pytest.approx(160 - mesh.xy[:, 0], abs=0.05)
    across = settings.seaward_m + settings.landward_m
    assert mesh.uv[:, 1] == pytest.approx((settings.seaward_m + mesh.xy[:, 1] - shore_y) / across, abs=0.01)
    on_line = np.abs(mesh.xy[:, 1] - shore_y) < 0.01
    assert on_line.sum() > 25
    assert mesh.colours[on_line, 1] == pytest.approx(1, abs=0.01)
    assert mesh.ground_m == pytest.approx((mesh.xy[:, 1] - shore_y) * 0.06, abs=1e-3)
    inner = on_line & (np.abs(mesh.xy[:, 0] - 80) < 40)
    row_m = across / (settings.rows - 1)
    assert np.median(mesh.colours[inner, 0]) == pytest.approx(settings.along_m * row_m / 2 / 50, rel=0.35)


def test_round_an_island_u_is_its_circumference():
    """H03: the curve is closed, its seam is the only place where u starts anew."""
    mesh = beach_mesh(island())
    round_it = 2 * np.pi * 45.0
    assert np.ptp(mesh.uv[:, 0]) == pytest.approx(round_it, abs=30)  # beside the seam it runs on
    on_line = np.abs(mesh.colours[:, 1] - 1) < 0.02
    angle = np.arctan2(mesh.xy[on_line, 1] - 100, mesh.xy[on_line, 0] - 100)
    phase = (mesh.uv[on_line, 0] / 45.0 + angle) % (2 * np.pi)  # clockwise: the sea is on the left
    assert np.abs(np.exp(1j * phase) - np.exp(1j * phase).mean()).max() < 0.1


def test_only_on_patches_marked_beach():
    level = make_beach(rows=261, cols=261)
    whole = beach_cells(level).sum()
    level.put_object("p", SeaPatch(id="p", x=150.0, y=150.0, sea="open"))
    cells = beach_cells(level)
    assert 0 < cells.sum() < whole
    assert not cells[10:20, 10:20].any()
    mesh = beach_mesh(level)
    assert mesh.colours[:, 3].min() < 0.5 < mesh.colours[:, 3].max()  # contact fades beside it
    assert beach_mesh(make_beach(slope=0.0)) is None


def test_settings_shape_it():
    """H03: each of its settings."""
    counts = [len(beach_mesh(make_beach()).xy)]
    for name, value in (("along_m", 2.0), ("rows", 17), ("seaward_m", 12.0), ("landward_m", 40.0)):
        level = make_beach()
        level.set(f"beach_mesh.{name}", value)
        counts.append(len(beach_mesh(level).xy))
    assert len(set(counts)) == 5, counts


def test_the_view_shows_bias_and_edges(level):
    """H03: on samples it is the mesh: the area that it covers, its bias at its vertices, edges at 0 m."""
    mesh, (samples, cell_m) = beach_mesh(level), beach_raster(level)
    covered = samples[..., 3].sum() * cell_m**2
    assert covered == pytest.approx(mesh.area_m2.sum(), rel=0.06)
    grid = mesh.border & (mesh.xy > 0).all(1) & (mesh.xy < np.array(level.grid.extent_m)).all(1)
    col, row = np.rint(mesh.xy[grid] / cell_m).astype(int).T
    assert samples[row, col, 0] == pytest.approx(1, abs=1e-5)
    assert np.abs(samples[row, col, 1]).max() < 1e-5
    assert samples[..., 1].max() < 5.1  # no circle in a triangle of the grid is larger
