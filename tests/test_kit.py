"""The runtime kit's sea in C, GLSL and HLSL against the CPU twin (T09)."""

import numpy as np
import pytest
from kit_parts import LEVELS, asked, placed, run_c
from kit_shaders import hlsl_slots, run_glsl, run_hlsl, validated
from shorewright.io.export.kit.files import sources, text_of
from shorewright.level.flow import current
from shorewright.level.objects import SeaPatch
from shorewright.level.waves import sea_at, surface_at

TIMES = (0.0, 3.7, 600.5, 604_800.75)


def patched():
    level = LEVELS["plain"]()
    level.put_object("p", SeaPatch(id="p", x=50.0, y=30.0, sea="open"))
    return level


def far_out():
    """Waves break where it is deeper than any shore wave reaches."""
    level = LEVELS["travelling"]()
    level.set("shore.range_m", 1.0)
    level.set("shore.height_m", 0.8)
    return level


ALL = {**LEVELS, "patched": patched, "far_out": far_out}


def holds(level, asks, told, short_m=1e-3):
    """Positions within a millimetre of the twin's, normals within a tenth of a degree."""
    for t in np.unique(asks[:, 0]):
        here = asks[:, 0] == t
        sea = surface_at(level, t, asks[here, 1], asks[here, 2])
        twin = np.stack([sea.x, sea.y, sea.height_m], -1)
        assert np.abs(told[here, :3] - twin).max() < short_m
        assert np.degrees(np.linalg.norm(told[here, 3:6] - sea.normal, axis=1)).max() < 0.1


@pytest.mark.parametrize("name", ALL)
def test_c_gives_the_twins_sea(name, tmp_path):
    """T09: 10,000 points and times over each of seven levels, C99 without a warning."""
    level = ALL[name]()
    asks = asked(level, TIMES, 2500)
    holds(level, asks, run_c(level, asks, tmp_path))


@pytest.mark.parametrize("name", ["plain", "placed", "river"])
def test_c_finds_the_sea_over_a_place(name, tmp_path):
    """T09: sea_at undoes the shift to the side, as a floating body needs it."""
    level = LEVELS[name]()
    asks = asked(level, [61.0], 500)
    told = run_c(level, asks, tmp_path, "over")
    sea = sea_at(level, 61.0, asks[:, 1], asks[:, 2])
    off = np.abs(told[:, 2] - sea.height_m)
    assert np.abs(told[:, :2] - asks[:, 1:]).max() < 5e-4
    assert off.max() < 1e-3


@pytest.mark.parametrize("t", [7.9, 604_801.3])
def test_c_moves_things_with_the_current_in_two_copies(t, tmp_path):
    """T09, D05: the current is the editor's; each copy lies where its own cycle has brought it, whole when mid-way."""
    level = placed()
    level.write("flow", level.grid.rect, np.broadcast_to(np.float32([0.5, -0.3]), (*level.grid.shape, 2)))
    interval_s, tile_m = level.settings.flow.interval_s, level.settings.water.foam_tile_m
    asks = asked(level, [t], 300)
    told = run_c(level, asks, tmp_path)
    flow = np.stack(current(level).at(asks[:, 1], asks[:, 2]), -1)
    assert np.abs(flow).max() > 0.1
    assert np.abs(told[:, 6:8] - flow).max() < 1e-5
    moves = np.linalg.norm(flow, axis=1) > 2e-3
    for n, (places, jump, off) in enumerate(
        [((8, 10), (0.24, 0.2083333), 0.0), ((10, 12), (0.2083333, 0.24), (0.37, 0.61))]
    ):
        cycles = t / interval_s % 600 + 0.5 * n
        at = asks[:, 1:] / tile_m + off + np.array(jump) * np.floor(cycles)
        at -= flow * (interval_s / tile_m) * (cycles % 1 - 0.5)
        assert np.abs(told[:, slice(*places)] - at)[moves].max() < 1e-3
    weight = abs(2 * (t / interval_s % 1) - 1)
    assert np.abs(told[moves, 12] - weight).max() < 1e-4


def test_c_under_a_lip_gives_one_of_the_surfaces_there(tmp_path):
    """T09, H23: where waves plunge, the height is the twin's over the same point of the undeformed sea, and the twin's
    own answer but where three surfaces lie over each other."""
    level = LEVELS["plunging"]()
    asks = asked(level, [61.0, 62.3, 63.1], 1500)
    told = run_c(level, asks, tmp_path, "over")
    found = np.linalg.norm(told[:, :2] - asks[:, 1:], axis=1) < 5e-4
    assert found.mean() > 0.99  # the rest hang in the air: the steps go to and fro
    for t in np.unique(asks[:, 0]):
        here = (asks[:, 0] == t) & found
        own = surface_at(level, t, told[here, 14].astype(float), told[here, 15].astype(float))
        assert np.abs(told[here, 2] - own.height_m).max() < 1e-3
        sea = sea_at(level, t, asks[here, 1], asks[here, 2])
        same = np.hypot(sea.x - asks[here, 1], sea.y - asks[here, 2]) < 5e-4
        off = np.abs(told[here, 2] - sea.height_m)[same]
        assert (off < 1e-3).mean() > 0.99  # the others stand on another of the three


@pytest.mark.gl
@pytest.mark.parametrize("name", ALL)
def test_glsl_gives_the_twins_sea(name, ctx):
    """T09: the GLSL of the kit with the numbers and maps of its own files."""
    level = ALL[name]()
    source = sources(level, "test")
    declares = "in vec2 in_at; out vec3 v_position; out vec3 v_normal;"
    body = "Sea sea = sea_surface(in_at); v_position = sea.position; v_normal = sea.normal;"
    for t in TIMES[1::2]:
        asks = asked(level, [t], 400)
        told = run_glsl(ctx, source, t, asks[:, 1:], declares, body, {"v_position": 3, "v_normal": 3})
        holds(level, asks, told)


@pytest.mark.gl
@pytest.mark.parametrize("name", ALL)
def test_hlsl_gives_the_twins_sea(name, ctx, tmp_path):
    """T09: HLSL to SPIR-V to GLSL by Khronos's tools, run: within a millimetre after a minute and after a week."""
    level = ALL[name]()
    outputs = ("float4(s.position, 0.0)", "float4(s.normal, 0.0)")
    for t in (61.0, 604_801.3):
        asks = asked(level, [t], 400)
        told = run_hlsl(ctx, sources(level, "test"), t, asks[:, 1:], tmp_path, "sea_surface", "Sea", outputs)
        holds(level, asks, told[:, [0, 1, 2, 4, 5, 6]])


@pytest.mark.parametrize("name", ALL)
def test_glsl_and_hlsl_compile(name, tmp_path):
    """T09: by Khronos's own compiler, every function that a game calls; HLSL to SPIR-V."""
    source = sources(ALL[name](), "test")
    glsl, hlsl = (text_of(source, "test", word) for word in ("glsl", "hlsl"))
    main = "in vec2 at; out vec4 o; void main() { Sea s = sea_at(at); o = vec4(s.position, foam_on(s)); }"
    validated(f"#version 410 core\n{glsl}\n{main}", "frag", tmp_path)
    slots, given = hlsl_slots(hlsl, source, "sea_at")
    _, others = hlsl_slots(hlsl, source, "foam_on")
    slots += "".join(f"Texture2D<float4> {name};\n" for name in others if name not in given)
    main = (
        f"{slots}float4 main(float4 p : SV_POSITION) : SV_TARGET {{ sea_at_time(p.z); Sea s = sea_at("
        f"{', '.join([*given, 'p.xy'])}); return float4(s.position, foam_on({', '.join([*others, 's'])})); }}\n"
    )
    validated(hlsl + main, "frag", tmp_path, "-D", "-V", "-e", "main")
