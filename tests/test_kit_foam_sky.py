"""The runtime kit's foam, weather and clouds: against the editor's own GLSL, and the twin where there is one (T09)."""

import numpy as np
import pytest
from kit_parts import LEVELS, asked, run_c, run_sky
from kit_shaders import run_glsl, run_hlsl, textures_of
from points import transform
from shorewright.io.export.kit.data import uniforms_at
from shorewright.io.export.kit.files import sources
from shorewright.io.export.kit.source import OWN
from shorewright.level.cloud_noise import CLOUD_NOISES
from shorewright.level.wave_uniforms import wave_defines
from shorewright.level.weather import weather_at

FOAM = """
in vec2 in_at; out float v_amount;
#include "level/foam_amount.glsl"
#include "level/current.glsl"
void main() {
    Sea sea = sea_surface(in_at);
    float column = water_column(sea, sea.position.z);
    v_amount = foam_amount(sea, on_face(in_at, sea), column, 1.0, PAINT, current_at(in_at), true, 0.0, 0.0).amount;
#ifdef RIVERS
    v_amount *= 1.0 - sea.river.share * smoothstep(RIVER_DROWNED_M.x, RIVER_DROWNED_M.y, sea.river.still);
#endif
}
"""
CLOUD = """
in vec3 in_at; out float v_density;
#include "lib/frame.glsl"
#include "lib/cloud_light.glsl"
void main() { v_density = cloud_extinction(vec3(in_at.xy - u_cloud_camera, in_at.z), in_at.z, 0.0, false); }
"""
SMOOTH = ("u_noise", "u_foam", "u_current", "u_weather_noise", *CLOUD_NOISES, "u_cloud_profile")


def foamy(name):
    level = LEVELS[name]()
    level.set("sea.wind_mps", 14.0)
    level.set("foam.shore", 0.5)
    level.set("foam.height", 0.8)
    return level


def smooth(ctx, textures, names):
    """Filters as the editor's textures have them."""
    for name in names:
        textures[name].filter = ctx.LINEAR, ctx.LINEAR
        if name in ("u_current", "u_cloud_profile"):
            textures[name].repeat_x = textures[name].repeat_y = False
    return textures


def editors_foam(ctx, level, source, t, at, paint="vec2(0.0)"):
    """Amount of foam by the editor's own functions and texture units."""
    textures = smooth(ctx, textures_of(ctx, source.data), ("u_noise", "u_foam", "u_current"))
    textures.pop("u_layer_foam").release()
    values = {n: v if v.ndim else v.item() for n, v in uniforms_at(source.data, t).items()}
    text = FOAM.replace("PAINT", paint)
    return transform(ctx, text, at, {"v_amount": 1}, textures, values, wave_defines(level), smooth=SMOOTH)[:, 0]


@pytest.mark.gl
@pytest.mark.parametrize("name", LEVELS)
def test_foam_is_the_editors(name, ctx, tmp_path):
    """T09, D04, H18: C and GLSL give the amount of the editor's shader, whose texture units round fractions."""
    level = foamy(name)
    source = sources(level, "test")
    for t in (0.0, 61.0):
        asks = asked(level, [t], 1500)
        its = editors_foam(ctx, level, source, t, asks[:, 1:])
        assert its.std() > 0.05
        c = run_c(level, asks, tmp_path)[:, 13]
        body = "v_amount = foam_on(sea_surface(in_at));"
        glsl = run_glsl(ctx, source, t, asks[:, 1:], "in vec2 in_at; out float v_amount;", body, {"v_amount": 1})[:, 0]
        for ours in (c, glsl):
            off = np.abs(ours - its)
            assert off.mean() < 5e-4
            assert off.max() < 0.02
        assert np.abs(c - glsl).max() < 5e-3


@pytest.mark.gl
def test_painted_foam_is_the_editors(ctx, tmp_path):
    """T09, D07: what is painted lies on the kit's sea too, with its waves and always."""
    level = foamy("plain")
    level.write("foam", level.grid.rect, np.broadcast_to(np.float32([0.7, 0.4]), (*level.grid.shape, 2)))
    asks = asked(level, [61.0], 800)
    its = editors_foam(ctx, level, sources(level, "test"), 61.0, asks[:, 1:], "vec2(0.7, 0.4)")
    ours = run_c(level, asks, tmp_path)[:, 13]
    assert ours.min() > 0.05
    assert np.abs(ours - its).mean() < 2e-3


@pytest.mark.parametrize("t", [3.3, 61.0, 604_800.75])
def test_the_kits_whitecaps_are_where_the_editors_are(t):
    """T09: generations, ages and places of caps by the kit's formulas, after a week too."""
    from shorewright.level.foam_uniforms import foam_uniforms

    level = foamy("plain")
    ours, its = uniforms_at(sources(level, "test").data, t), foam_uniforms(level.settings, t)
    for name in ("u_cap_age", "u_cap_place", "u_foam_cycle"):
        off = np.abs(ours[name] - np.asarray(its[name], np.float64))
        assert np.minimum(off, np.abs(1 - off)).max() < 1e-5, name


def clouded(**settings):
    level = LEVELS["plain"]()
    for name, value in {"clouds.on": True, "weather.coverage": 0.6, **settings}.items():
        level.set(name.replace("__", "."), value)
    return level


def places(t, count=1500):
    rng = np.random.default_rng(3)
    flat = np.float32(rng.uniform(-33_000, 33_000, (count, 2)))
    return np.column_stack([np.full(count, t), flat, np.float32(rng.uniform(1400, 4100, count))]).astype(np.float64)


@pytest.mark.parametrize("t", [0.0, 1234.5, 90_000.0])
def test_weather_is_the_twins(t, tmp_path):
    """T09, Z04: coverage, precipitation and type over any place and time, under a storm, with and without paint."""
    level = clouded(storm__chance=0.8, weather__precipitation=0.3)
    rng = np.random.default_rng(2)
    level.write("weather", level.layers["weather"].grid.rect, np.float32(rng.uniform(0, 1, (512, 512, 6))))
    asks = places(t, 1000)
    camera = tuple(side / 2 for side in level.grid.extent_m)
    told = run_sky(level, asks, tmp_path)
    twin = weather_at(level, t, asks[:, 1], asks[:, 2], camera)
    assert twin.std(0).min() > 0.02
    assert np.abs(told[:, :4] - twin).max() < 2e-3


@pytest.mark.gl
@pytest.mark.parametrize("t", [0.0, 1234.5])
def test_cloud_density_is_the_editors(t, ctx, tmp_path):
    """T09, Z03, Z22: extinction at a place as the march through the clouds has it, its weather asked there."""
    level = clouded()
    source = sources(level, "test", "sky")
    asks = places(t)
    textures = cloud_textures(ctx, source)
    values = {n: v if v.ndim else v.item() for n, v in uniforms_at(source.data, t).items()}
    values |= {"u_weather_shots": 0, "u_weather_over_shots": (1.0, 1.0)}
    texts = {"level/weather_map.glsl": (OWN / "weather_map.glsl").read_text()}
    its = transform(ctx, CLOUD, asks[:, 1:], {"v_density": 1}, textures, values, texts=texts, smooth=tuple(textures))[
        :, 0
    ]
    assert 0.02 < (its > 0).mean() < 0.6
    ours = run_sky(level, asks, tmp_path)[:, 4]
    most = level.settings.clouds.extinction
    assert np.abs(ours - its).mean() < 2e-3 * most
    assert np.quantile(np.abs(ours - its), 0.99) < 0.05 * most
    assert ((ours > 0) == (its > 0)).mean() > 0.995


def cloud_textures(ctx, source):
    """As the renderer has them: cubes, mips, filters."""
    found = {}
    for name, values in source.data.maps.items():
        rows, cols, channels = values.shape
        kind = "f1" if values.dtype == np.uint8 else "f4"
        if name == "u_cloud_detail_half":
            continue
        if name in ("u_cloud_shape", "u_cloud_detail"):
            cube = CLOUD_NOISES[name]()
            one = ctx.texture3d(cube.shape[2::-1], channels, cube.tobytes(), alignment=1)
            one.build_mipmaps()
            one.filter = ctx.LINEAR_MIPMAP_LINEAR, ctx.LINEAR
        else:
            one = ctx.texture((cols, rows), channels, values.tobytes(), dtype=kind, alignment=1)
            one.filter = ctx.LINEAR, ctx.LINEAR
        found[name] = one
    found["u_cloud_profile"].repeat_x = found["u_cloud_profile"].repeat_y = False
    found["u_weather_shot_skies"] = ctx.texture_array(
        (1, 1, 1), 3, np.zeros(3, np.float32).tobytes(), dtype="f4", alignment=1
    )
    return found


@pytest.mark.gl
def test_glsl_and_hlsl_give_the_twins_weather(ctx, tmp_path):
    """T09: both languages, run over points at 61 s."""
    level = clouded()
    source = sources(level, "test", "sky")
    asks = places(61.0, 400)
    twin = weather_at(level, 61.0, asks[:, 1], asks[:, 2], tuple(side / 2 for side in level.grid.extent_m))
    declares = "in vec2 in_at; out vec4 v_sky; out float v_density;"
    body = "v_sky = weather_at(in_at); v_density = cloud_density(vec3(in_at, 2000.0));"
    glsl = run_glsl(ctx, source, 61.0, asks[:, 1:3], declares, body, {"v_sky": 4, "v_density": 1})
    assert np.abs(glsl[:, :4] - twin).max() < 2e-3
    asks[:, 3] = 2000.0
    assert np.abs(glsl[:, 4] - run_sky(level, asks, tmp_path)[:, 4]).max() < 1e-3
    hlsl = run_hlsl(ctx, source, 61.0, asks[:, 1:3], tmp_path, "weather_at", "float4", ("s",))
    assert np.abs(hlsl - twin).max() < 2e-3
