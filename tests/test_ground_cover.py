"""The ground's materials by rule: NumPy against the GLSL that draws them (L05), and the map that is exported."""

import moderngl
import numpy as np
import pytest
from points import transform
from scenes import camera
from shorewright.level import Grid, Level, Rect
from shorewright.level.ground_cover import Site, noise_at, noise_levels, site_at, weights_of
from shorewright.level.open_sky import open_sky
from shorewright.level.textures import noise_texture
from shorewright.renderer import render
from shorewright.renderer.look import look_uniforms

RULE = """
in vec2 in_at; out vec4 v_one; out vec4 v_other;
#include "lib/ground.glsl"
uniform sampler2D u_site, u_painted;
uniform float u_pixel_m, u_cell;
void main() {
    ivec2 texel = ivec2(round(in_at / u_cell));
    vec4 site = texelFetch(u_site, texel, 0);
    vec3 normal = normalize(vec3(site.x, 0.0, 1.0));
    Site s = site_at(in_at, normal, site.y, site.z, site.w, texelFetch(u_painted, texel, 0), u_pixel_m);
    float weights[LAYERS];
    ground_weights(s, weights);
    v_one = vec4(weights[0], weights[1], weights[2], weights[3]);
    v_other = vec4(weights[4], weights[5], weights[6], weights[7]);
}
"""
SIDE = 97


@pytest.fixture(scope="module")
def coast():
    """Beach, bed, cliffs and a plateau, rough in one half, with a little of all paints."""
    y, x = np.mgrid[0:SIDE, 0:SIDE].astype(float)
    noise = np.random.default_rng(4).normal(0, 0.25, (SIDE, SIDE)) * (x > SIDE / 2)
    height = -9 + 0.22 * y + 14 / (1 + np.exp(-(y - 75 - 6 * np.sin(x / 9)))) + noise
    level = Level(Grid(SIDE, SIDE, 1.5), height.astype(np.float32))
    paint = np.random.default_rng(5).uniform(0, 1, (20, 30, 4)).astype(np.float32)
    level.write("cover", Rect(30, 10, 50, 40), paint)
    return level


def site_of(level, pixel_m):
    lines = np.arange(SIDE)
    xy = np.meshgrid(lines * level.grid.cell_m, lines * level.grid.cell_m)
    return xy, site_at(level, lines, lines, xy, np.zeros((SIDE, SIDE, 2)), pixel_m, 16)


@pytest.mark.gl
@pytest.mark.parametrize("pixel_m", [0.05, 1.5, 20.0])
def test_weights_are_those_of_the_shader(ctx, coast, pixel_m):
    """From one site the same eight weights. Textures are filtered with 8 bits, and borders of patches take that noise
    twelve times (`wide_patch`): a few places on steep borders are off by more than a hundredth."""
    (x, y), site = site_of(coast, pixel_m)
    cover = coast.layers["cover"].array
    assert len(np.unique(weights_of(coast, site, cover).argmax(-1))) >= 6  # the coast has what the rule tells apart
    given = np.stack([site.rise, site.height, site.rough, site.open], -1).astype("f4")
    noise = noise_texture()
    textures = {
        "u_site": ctx.texture((SIDE, SIDE), 4, given.tobytes(), dtype="f4"),
        "u_painted": ctx.texture((SIDE, SIDE), 4, np.ascontiguousarray(cover, "f4").tobytes(), dtype="f4"),
        "u_noise": ctx.texture(noise.shape[1::-1], 4, noise.tobytes()),
    }
    textures["u_noise"].build_mipmaps()
    for number, texels in enumerate(noise_levels()):  # software rounds each level up, others to the nearest
        textures["u_noise"].write(texels.tobytes(), level=number)
    shore, ground = coast.settings.shore, coast.settings.ground
    uniforms = {
        **{name: value for name, value in look_uniforms(coast.settings, 0.0).items() if name.startswith("u_ground")},
        "u_ground_shingle": ground.shingle,
        "u_ground_weed": ground.weed,
        "u_swash_top_m": shore.range_m * shore.runup,
        "u_pixel_m": pixel_m,
        "u_cell": coast.grid.cell_m,
    }
    textures["u_noise"].filter = (moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR)
    at = np.stack([x.ravel(), y.ravel()], -1)
    found = transform(ctx, RULE, at, {"v_one": 4, "v_other": 4}, textures, uniforms, smooth=("u_noise",))
    wanted = weights_of(coast, site, cover).reshape(-1, 8)
    off = np.abs(found - wanted).max(-1)
    assert off.mean() < 0.006
    assert np.percentile(off, 99) < 0.1
    assert np.mean(found.argmax(-1) == wanted.argmax(-1)) > 0.985
    assert found.sum(-1) == pytest.approx(1, abs=1e-5)


@pytest.mark.gl
def test_open_sky_is_the_renderers_map(renderer, coast):
    """Horizon by horizon, to one step of its 8 bits."""
    render(coast, camera(), (32, 32), quality="high", renderer=renderer)
    held = renderer.kept["openness"][(SIDE, SIDE), 16]
    drawn = np.frombuffer(held.texture.read(), np.uint8).reshape(SIDE, SIDE, 4) / 255
    open_, rough = open_sky(coast.height, coast.grid.cell_m, np.arange(SIDE), np.arange(SIDE))
    assert np.abs(drawn[..., 0] - open_).max() < 1.5 / 255
    assert np.abs(drawn[..., 1] - 2 * rough).max() < 1.5 / 255
    assert open_.min() < 0.9
    assert rough.max() > 0.1


def test_noise_repeats_and_keeps_its_mean():
    x = np.linspace(0, 30, 50)
    assert noise_at(x, x, 9.0, 0.01) == pytest.approx(noise_at(x + 9.0, x - 18.0, 9.0, 0.01))
    assert noise_at(x, x, 9.0, 1e6)[0] == pytest.approx(noise_levels()[0].mean((0, 1)) / 255, abs=0.02)


def test_paint_counts_more_than_the_rule():
    site = Site(*(np.full(1, value) for value in (2.0, 20.0, 0.0, 1.0)), *(np.full((1, 4), 0.5) for _ in range(2)))
    level = Level(Grid(9, 9, 1.0), np.zeros((9, 9), np.float32))
    by_rule = weights_of(level, site, np.zeros((1, 4)))[0]
    sand, rock, grass = (weights_of(level, site, np.eye(4)[[i]])[0] for i in range(3))
    assert by_rule[2] > 0.9  # a cliff
    assert sand[0] == pytest.approx(1)
    assert rock[2] + rock[3] == pytest.approx(1)
    assert grass[4] + grass[5] == pytest.approx(1)
