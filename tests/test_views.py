"""VIEWS, show flags and overlays: every row renders, finite and not blank, and a switch changes nothing else (T11)."""

import numpy as np
import pytest
from shorewright.level import LAYERS, BadInput, Grid, Level, Rect
from shorewright.level.meshes import block
from shorewright.level.objects import Camera, Disturbance, Hit, Mover, PointLight, Prop, River
from shorewright.renderer import SHOW_FLAGS, VIEWS, Overlays, Renderer, Ring, Show, render
from shorewright.renderer.show import FrontLines, Streamlines

pytestmark = pytest.mark.gl
SIZE = (96, 54)
CAMERA = Camera(id="play", x=80, y=8, z=28, yaw_deg=4, pitch_deg=-20, fov_deg=60)
# what only shows against the sun: from the beach out to sea
INTO_SUN = Camera(id="out", x=60, y=62, z=6, yaw_deg=235, pitch_deg=-10, fov_deg=60)
SHALLOWS = Camera(id="near", x=60, y=30, z=3, yaw_deg=0, pitch_deg=-30)  # where refraction moves by pixels


def small_coast():
    """A beach with a rock, a shadow on it and a patch of paint in every layer."""
    y, x = np.mgrid[0:129, 0:161].astype(np.float64)
    height = (y - 64) * 0.09 + 14 * np.exp(-((x - 100) ** 2 + (y - 84) ** 2) / 60)
    level = Level(Grid(129, 161), height.astype(np.float32))
    for name, row in LAYERS.items():
        if name != "height":
            channels = len(row.channels)
            paint = 0.8 if channels == 1 else np.linspace(0.9, 0.3, channels, dtype=np.float32)
            level.write(name, Rect(30, 50, 110, 120) if row.grid == "level" else Rect(0, 0, 1, 1), paint)
    level.write("foam", Rect(30, 30, 110, 50), np.linspace(0.9, 0.3, 2, dtype=np.float32))  # beside painted water
    for thing in (
        Mover(id="mover", x=70, y=36, circle_m=4, radius_m=2, speed_mps=4),
        Disturbance(id="burst", x=86, y=40, time_s=4.5, radius_m=5, strength=5),
        Hit(id="hit", x=80, y=40, time_s=1.0, size=6.0),
        PointLight(id="lamp", x=80, y=50, z=4, power_kcd=900),
        Prop(id="raft", mesh="block", x=74, y=44, floats=True, scale=4),
    ):
        level.put_object(thing.id, thing)
    level.put_mesh("block", block())
    fall = ((0, 0, 12, 5, 3), (0, -9, 12, 4.9, 3), (-1, -13, 12, 3.2, 3), (-4, -40, 12, 0, 1))
    level.put_object("river", River(id="river", x=132, y=104, points=fall))
    level.set("weather.precipitation", 0.9)  # for the views alone: there are no clouds
    level.set("weather.temperature_c", 1.0)
    level.set("foam.height_low", -0.5)  # foam on all offshore waves: those of so small a sea are low
    return level


@pytest.fixture(scope="module")
def scene(ctx):
    renderer = Renderer(ctx)
    yield small_coast(), renderer
    renderer.release()


def picture(scene, view="final", camera=CAMERA, **options):
    level, renderer = scene
    options = {"size": SIZE, "time_s": 5.0, "quality": "low", **options}
    return render(level, camera, view=view, renderer=renderer, **options)


@pytest.mark.parametrize("name", VIEWS)
def test_every_view_is_finite_and_not_blank(scene, name):
    """Rows D01, D02, D03, D04, D10, D11, D31, H30: each buffer and each mask is a named view."""
    camera = INTO_SUN if name in ("glint", "crest_light") else CAMERA
    numbers = picture(scene, name, camera, linear=True)
    assert numbers.shape == (SIZE[1], SIZE[0], 3)
    assert numbers.dtype == np.float32
    assert np.isfinite(numbers).all()
    shown = picture(scene, name, camera)
    assert shown.dtype == np.uint8
    assert numbers.std(axis=(0, 1)).max() > 1e-3
    assert shown.reshape(-1, 3).std(axis=0).max() > 1.0


def test_views_show_what_they_say(scene):
    """The numbers of a view are the numbers of the level at the pixel's place (D03)."""
    level, _ = scene
    dry = Show.hide("water,scatter,things")
    position, height, depth, bands = (
        picture(scene, name, linear=True, show=dry).astype(np.float64)
        for name in ("position", "height", "depth", "depth_fract")
    )
    x, y = position[..., 0], position[..., 1]
    inside = (x > 1) & (x < 159) & (y > 1) & (y < 127)
    assert inside.sum() > 1000
    from shorewright.level.pick import ground_at

    expected = ground_at(level, x[inside], y[inside])
    np.testing.assert_allclose(height[inside][:, 0], expected, atol=2e-3)
    near = inside & (np.hypot(x - CAMERA.x, y - CAMERA.y) < 40)  # where the mesh has every sample
    assert near.sum() > 200
    np.testing.assert_allclose(position[near][:, 2], ground_at(level, x[near], y[near]), atol=0.02)
    np.testing.assert_allclose(depth[inside][:, 0], np.maximum(-expected, 0), atol=2e-3)
    assert bands.min() >= 0
    assert bands.max() <= 1


@pytest.mark.parametrize("name", SHOW_FLAGS)
def test_every_flag_changes_the_picture_and_leaves_no_trace(scene, name):
    """Off changes something, on again gives the same bytes (T11)."""
    near = {"camera": SHALLOWS, "size": (320, 180)} if name in ("refraction", "caustics") else {}
    if name == "reflections":  # the low tier has none
        near = {"quality": "medium"}
    before = picture(scene, **near)
    off = picture(scene, show=Show.hide(name), **near)
    assert not np.array_equal(before, off)
    assert np.array_equal(before, picture(scene, **near))


@pytest.mark.parametrize("name", sorted(set(SHOW_FLAGS) - {"water"}))
def test_flags_leave_the_ground_alone(scene, name):
    """Switching one off changes nothing else: the height below stays (T11)."""
    bare = ("water", "scatter", "things")  # what stands in front shows the ground at its own place
    a, b = (picture(scene, "height", linear=True, show=Show.hide(names)) for names in (bare, {*bare, name}))
    assert np.array_equal(a, b)


def test_vertex_animation_off_stops_the_water_but_not_the_masks(scene):
    """D10's switch: the edge stands still while the masks travel on."""
    off = Show.hide("vertex_animation")
    rise = [picture(scene, "shore_lift", linear=True, time_s=t, show=off) for t in (1.0, 3.0)]
    lines = [picture(scene, "wave_line", linear=True, time_s=t, show=off) for t in (1.0, 3.0)]
    assert np.abs(rise).max() == 0
    assert np.abs(lines[0] - lines[1]).max() > 0.1


def test_overlays_draw_over_the_picture_and_are_gone_without(scene):
    """Brush ring, walkable depth over the water, outline, the centre of the game camera, lines (D31 D40), fronts."""
    plain = picture(scene)
    rows = [
        Overlays(ring=Ring(80, 70, 12, 0.3)),
        Overlays(walkable=True),
        Overlays(outline=True),
        Overlays(centre=True),
        *(Overlays(fronts=FrontLines.parse(w)) for w in ("crests", "ghosts:2:1", "isochrones:2", "speed", "breakers")),
        Overlays(lines=(((60, 60, 5), (100, 70, 5)), ((80, -200, 5), (80, 80, 5)))),
        Overlays(arrows=True),
        Overlays(streamlines=Streamlines((np.array([(60, 40, 0, 0.5), (100, 45, 0, 1.5)]),))),
    ]
    pictures = [picture(scene, overlays=row) for row in rows]
    for shown in pictures:
        assert not np.array_equal(shown, plain)
    assert len({shown.tobytes() for shown in pictures}) == len(rows)
    assert np.array_equal(picture(scene), plain)


def test_walkable_overlay_is_green_on_the_beach_and_red_in_the_deep(scene):
    shown = picture(scene, overlays=Overlays(walkable=True)).astype(int)
    bottom = shown[-4:].mean(axis=(0, 1))
    view = picture(scene, "walkable", linear=True)
    assert bottom[0] > bottom[1]  # the sea in front is too deep
    assert (view[..., 1] > 0.5).any()
    assert (view[..., 0] > 0.5).any()


def test_unknown_flags_are_refused():
    with pytest.raises(BadInput, match="watr"):
        Show.hide("watr")


def test_unknown_views_cameras_and_qualities_are_refused(scene):
    level, renderer = scene
    for options, word in (({"view": "nope"}, "nope"), ({"quality": "ultra"}, "ultra")):
        with pytest.raises(BadInput, match=word):
            render(level, CAMERA, SIZE, renderer=renderer, **options)
    with pytest.raises(BadInput, match="nowhere"):
        render(level, "nowhere", SIZE, renderer=renderer)
    with pytest.raises(BadInput, match="0 × 10"):
        render(level, CAMERA, (0, 10), renderer=renderer)


def test_tables_come_without_opengl():
    """`shorewright views` starts without loading moderngl (T10)."""
    import subprocess
    import sys

    heavy = {"moderngl", "scipy", "OpenImageIO"}
    code = f"import sys, shorewright.renderer as r; r.VIEWS; sys.exit(len({heavy} & {{*sys.modules}}))"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
