"""The generated ground materials and how they come to the GPU (L04, L05)."""

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.level.ground_materials import MATERIALS
from shorewright.level.ground_textures import SPAN, encode, ground_textures, material
from shorewright.level.tiling import cells, waves
from shorewright.renderer import cache
from shorewright.renderer.quality import TIERS
from shorewright.renderer.textures import COARSE, Textures

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
NAMES = [row.name for row in MATERIALS]
# measured ranges of the art direction; shingle, reef and weed are between or below
RANGES = {"sand": (0.30, 0.45), "sea floor": (0.30, 0.45), "grass": (0.10, 0.20), "strata": (0.10, 0.30),
          "reef": (0.10, 0.30), "shingle": (0.10, 0.30), "dune grass": (0.15, 0.35), "weed": (0.03, 0.10)}  # fmt: skip


def halved(field: np.ndarray) -> np.ndarray:
    rows, cols = field.shape[0] // 2, field.shape[1] // 2
    return field.reshape(rows, 2, cols, 2).mean((1, 3))


@pytest.mark.parametrize("index", range(len(MATERIALS)), ids=NAMES)
def test_a_material_is_the_same_pattern_at_each_resolution(index):
    """L05: the coarser one is the finer one with its finest waves left out, not another."""
    coarse, fine = material(index, 256)[0], halved(material(index, 512)[0])
    assert np.corrcoef(coarse.ravel(), fine.ravel())[0, 1] > 0.85


@pytest.mark.parametrize("index", range(len(MATERIALS)), ids=NAMES)
def test_albedo_is_what_was_measured_of_such_ground(index):
    """L05: mean luminance of the linear albedo."""
    low, high = RANGES[NAMES[index]]
    assert low < (material(index, 256)[1] @ LUMINANCE).mean() < high


@pytest.mark.parametrize("index", range(len(MATERIALS)), ids=NAMES)
def test_slopes_belong_to_the_height_and_are_seldom_cut(index):
    """Slopes are the height's own, in heights a tile; what leaves ±1 is under one in a hundred."""
    shape = ground_textures(256)[0, index] / 255
    height, steepest = np.clip(0.5 + material(index, 256)[0] / SPAN, 0, 1), MATERIALS[index].steepest
    east = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * 128 / steepest
    assert np.abs(shape[..., 0] * 2 - 1 - np.clip(east, -1, 1)).max() < 0.01
    assert (np.abs(east) > 1).mean() < 0.01
    assert shape[..., 2].mean() == pytest.approx(0.5, abs=0.02)  # relief adds no height on the whole


@pytest.mark.parametrize("index", range(len(MATERIALS)), ids=NAMES)
def test_what_mip_levels_lose_of_the_slope_is_its_variance(index):
    """L04: mean slope² less the square of the mean slope is never below zero, and is all of it for the whole tile."""
    made = ground_textures(256)[:, index] / 255
    east, north, square = made[0, ..., 0] * 2 - 1, made[0, ..., 1] * 2 - 1, 2 * made[1, ..., 3]
    for _ in range(3):
        east, north, square = halved(east), halved(north), halved(square)
        lost = square - east**2 - north**2
        assert lost.min() > -0.02
    assert 0.1 < lost.mean() / square.mean() <= 1


def test_what_stands_in_has_the_colours_of_what_comes():
    """Each layer's mean albedo, height and roughness are the fine one's within 6/255: nothing jumps when it arrives."""
    draft, fine = (ground_textures.__wrapped__(size).astype(float).mean((2, 3)) for size in (COARSE, 256))
    assert np.abs(draft - fine)[..., :3].max() < 6


@pytest.mark.parametrize("name", ["noise", "foam", "ripple", "caustics", "ground 256"])
def test_what_is_kept_on_disk_depends_on_the_patterns_code(name, monkeypatch, tmp_path):
    """All sets are made of tiling.py's patterns: other code there is another key."""
    from shorewright.renderer import textures as module

    asked = []
    monkeypatch.setattr(module, "cached", lambda *what: asked.append(what[2:]))
    module._make(name)
    other = tmp_path / "tiling.py"
    other.write_text("# other patterns")
    monkeypatch.setattr(module.tiling, "__file__", str(other))
    module._make(name)
    assert asked[0] != asked[1]


def test_colours_are_srgb():
    assert encode(np.array([0.0, 0.0031308, 0.18, 1.0])) == pytest.approx([0, 0.04045, 0.4613, 1], abs=1e-4)


def test_patterns_tile_and_keep_their_deviation():
    """A stretched noise has deviation one; cells are the same points at every size."""
    for stretch in (1.0, 4.0):
        assert waves(256, 3, 1.2, 2, 100, stretch).std() == pytest.approx(1, rel=0.05)
    small, large = cells(64, 5, 9, 1), cells(128, 5, 9, 1)
    np.testing.assert_allclose(large.first[::2, ::2], small.first, atol=1e-5)
    assert (small.border >= 0).all()


def colour_bytes(textures: Textures) -> bytes:
    return textures["u_ground_colour"].read()


@pytest.fixture
def empty_cache(tmp_path, monkeypatch):
    monkeypatch.setenv(cache.VARIABLE, str(tmp_path))


@pytest.mark.gl
def test_coarse_ones_stand_in_until_the_fine_ones_arrive(ctx, empty_cache, monkeypatch):
    """The first picture in the window waits for nothing; what is there in the end is what others waited for (L05)."""
    import threading

    from shorewright.renderer import textures as module

    gate, make = threading.Event(), module._make

    def held_up(name):
        assert gate.wait(60)
        return make(name)

    monkeypatch.setattr(module, "_make", held_up)
    background = Textures(ctx, background=True)
    background.update(TIERS["low"])
    assert background["u_ground_shape"].size[:2] == (COARSE, COARSE)
    assert not background.settled
    assert background.arrived == 0
    gate.set()
    background.settle(TIERS["low"])
    assert background.settled
    assert background.arrived == len(background.bytes) == 5
    waited = Textures(ctx)
    waited.update(TIERS["low"])
    assert waited.settled
    assert colour_bytes(background) == colour_bytes(waited)
    for textures in (background, waited):
        textures.release()


@pytest.mark.gl
def test_pictures_for_files_wait_for_the_fine_ones(ctx, empty_cache):
    """A window's renderer asked for a picture by `render` draws the same bytes as one that waits."""
    from shorewright.renderer import Renderer, render

    shots = []
    for background in (True, False):
        renderer = Renderer(ctx, background)
        shots.append(render(coast(), camera(), (64, 36), quality="low", renderer=renderer))
        renderer.release()
    assert np.array_equal(*shots)


@pytest.mark.gl
def test_what_things_mirror_follows_the_noise(ctx, empty_cache, monkeypatch):
    """L02: clouds in the mirror, made of coarse noise at first, are those of a renderer that waited in the end."""
    import threading

    from shorewright.renderer import Renderer, render
    from shorewright.renderer import textures as module

    gate, make = threading.Event(), module._make
    monkeypatch.setattr(module, "_make", lambda name: (gate.wait(60), make(name))[1])
    level, shots = coast(), []
    level.set("light.cloud_cover", 1.0)
    window = Renderer(ctx, background=True)
    window.draw(level, camera(), (96, 54), 1.0, "lookdev", quality="low")
    gate.set()
    window.generated.settle(TIERS["low"])
    for renderer in (window, Renderer(ctx)):
        shots.append(render(level, camera(), (96, 54), 1.0, "lookdev", quality="low", renderer=renderer))
        renderer.release()
    assert np.array_equal(*shots)


@pytest.mark.gl
def test_bytes_of_each_set_are_told(ctx):
    """Two arrays of eight layers of four bytes, and a third more for their mip levels."""
    textures = Textures(ctx)
    textures.update(TIERS["low"])
    texels = TIERS["low"].ground_texels
    assert textures.bytes[f"ground {texels}"] == 2 * 8 * texels**2 * 4 * 4 // 3
    assert set(textures.bytes) == {"noise", "foam", "ripple", "caustics", f"ground {texels}"}
    textures.release()


class Windowed:
    """A context with a window's framebuffer."""

    def __init__(self, ctx) -> None:
        self.ctx, self.screen = ctx, ctx.simple_framebuffer((8, 8))

    def __getattr__(self, name: str):
        return getattr(self.ctx, name)


@pytest.mark.gl
def test_a_paused_window_draws_again_when_fine_ones_arrive(ctx, empty_cache, monkeypatch, tmp_path):
    """Paused and unchanged nothing is redrawn, but for textures that came meanwhile (L05)."""
    from shorewright.app.editor import Editor
    from shorewright.app.picture import WIDGETS_FIRST, Picture
    from shorewright.app.preferences import Preferences
    from shorewright.app.session import Session

    monkeypatch.setattr("shorewright.app.picture.STILLS", {})  # else a finer tier would be drawn when it stands still
    session = Session(coast(), spill_root=tmp_path)
    editor = Editor(session, Preferences(), tmp_path / "preferences.json")
    editor.quality = "low"
    picture = Picture(Windowed(ctx))
    for _ in range(WIDGETS_FIRST + 1):
        picture.show(editor, (64, 36))
    first = picture.draws
    assert first == 1
    picture.renderer.generated.settle(TIERS["low"])
    picture.show(editor, (64, 36))
    assert picture.draws == first + 1
    picture.release()
    session.close()
