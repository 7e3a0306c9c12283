"""The runtime kit: the sea for games in C, GLSL, HLSL and Godot's language, made from the one source (T09)."""

import json
import re
import shutil
import subprocess

import numpy as np
import pytest
from kit_parts import LEVELS, asked, placed, plain, run_c
from points import transform
from shorewright.io.export import check, export
from shorewright.io.export.kit.data import sea_data, uniforms_at
from shorewright.io.export.kit.files import sources
from shorewright.io.export.kit.parse import parse
from shorewright.io.export.kit.reach import changed, pruned
from shorewright.io.export.kit.source import one_text
from shorewright.io.export.kit.write_c import CWriter
from shorewright.io.export.kit.write_godot import GodotWriter
from shorewright.io.export.kit.write_hlsl import HlslWriter
from shorewright.level import BadInput
from shorewright.level.flow import current
from shorewright.level.wave_uniforms import wave_uniforms
from shorewright.level.waves import sea_at, surface_at

TIMES = (0.0, 3.7, 600.5, 604_800.75)
ALL = ["WAVE_OBJECTS", "WAVE_REGIONS", "PATCHED", "PINS", "RIVERS", "PLUNGE", "TRAVEL_TIME"]


def holds(level, asks, told):
    """Positions within a millimetre of the twin's, normals within a tenth of a degree."""
    for t in np.unique(asks[:, 0]):
        here = asks[:, 0] == t
        sea = surface_at(level, t, asks[here, 1], asks[here, 2])
        twin = np.stack([sea.x, sea.y, sea.height_m], -1)
        assert np.abs(told[here, :3] - twin).max() < 1e-3
        assert np.degrees(np.linalg.norm(told[here, 3:6] - sea.normal, axis=1)).max() < 0.1


@pytest.mark.parametrize("name", LEVELS)
def test_c_gives_the_twins_sea(name, tmp_path):
    """T09: 10,000 points and times over four levels, C99 without a warning."""
    level = LEVELS[name]()
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


@pytest.mark.parametrize("name", LEVELS)
def test_glsl_gives_the_twins_sea(name, ctx):
    """T09: the GLSL of the kit with the numbers and maps of its own files."""
    level = LEVELS[name]()
    made, data = sources(level, "test", ["glsl"])
    shader = f"in vec2 in_at; out vec3 v_position; out vec3 v_normal;\n{made['glsl']}\n"
    shader += "void main() { Sea sea = sea_surface(in_at); v_position = sea.position; v_normal = sea.normal; }"
    for t in TIMES[1::2]:
        asks = asked(level, [t], 400)
        textures = {}
        for sampler, values in data.maps.items():
            rows, cols, channels = values.shape
            if sampler != "u_current":
                textures[sampler] = ctx.texture((cols, rows), channels, values.tobytes(), dtype="f4")
        values = {n: v if v.ndim else v.item() for n, v in uniforms_at(data, t).items()}
        told = transform(ctx, shader, asks[:, 1:], {"v_position": 3, "v_normal": 3}, textures, values)
        holds(level, asks, told)


def validated(text, stage, folder, *words):
    """What glslangValidator says about a text; skips without it."""
    tool = shutil.which("glslangValidator")
    if tool is None:
        pytest.skip("no glslangValidator here (Debian: glslang-tools)")
    path = folder / f"text.{stage}"
    path.write_text(text)
    ran = subprocess.run([tool, *words, str(path)], capture_output=True, text=True, cwd=folder)
    assert ran.returncode == 0, ran.stdout[:2000]


@pytest.mark.parametrize("name", LEVELS)
def test_glsl_and_hlsl_compile(name, tmp_path):
    """T09: by Khronos's own compiler, HLSL to SPIR-V."""
    made, data = sources(LEVELS[name](), "test", ["glsl", "hlsl"])
    main = "in vec2 at; out vec4 o; void main() { Sea s = sea_surface(at); o = vec4(s.position, s.normal.x); }"
    validated(f"#version 410 core\n{made['glsl']}\n{main}", "frag", tmp_path)
    validated(hlsl_main(made["hlsl"], data), "frag", tmp_path, "-D", "-V", "-e", "main")


@pytest.mark.parametrize("name", ["plain", "placed", "travelling"])
def test_hlsl_gives_the_twins_sea(name, ctx, tmp_path):
    """T09: HLSL to SPIR-V to GLSL by Khronos's tools, run: positions within a millimetre at 61 s."""
    level, cross = LEVELS[name](), shutil.which("spirv-cross")
    if cross is None:
        pytest.skip("no spirv-cross here")
    made, data = sources(level, "test", ["hlsl"])
    validated(hlsl_vertex(made["hlsl"], data), "vert", tmp_path, "-D", "-V", "-e", "main", "-o", "sea.spv")
    words = [cross, "sea.spv", "--version", "410", "--no-es", "--no-420pack-extension"]
    back = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    back = re.sub(r"\bp\b", "in_at", back.split("\n", 1)[1])
    asks, textures = asked(level, [61.0], 400), {}
    for sampler, values in data.maps.items():
        if sampler == "u_current":
            continue
        rows, cols, channels = values.shape
        textures[f"SPIRV_Cross_CombinedT_{sampler}SPIRV_Cross_DummySampler"] = ctx.texture(
            (cols, rows), channels, values.tobytes(), dtype="f4"
        )
    outs = {"_entryPointOutput_at": 3, "_entryPointOutput_up": 3}
    holds(level, asks, transform(ctx, back, asks[:, 1:], outs, textures, {}))


def textures_of(text, data):
    """Declarations of the textures that sea_surface takes, and the arguments."""
    order = text.split("Sea sea_surface(")[1].split(")")[0]
    names = [word.split()[-1] for word in order.split(",")[:-1]]
    assert {*names, "u_current"} == {*data.maps}
    slots = "".join(f"Texture2D<float4> T_{name} : register(t{n});\n" for n, name in enumerate(names))
    return slots, ", ".join(f"T_{name}" for name in names)


def hlsl_vertex(text, data):
    slots, given = textures_of(text, data)
    return (
        f"{text}\n{slots}struct V {{ float3 at : A; float3 up : B; float4 place : SV_POSITION; }};\n"
        f"V main(float2 p : AT) {{ sea_at_time(61.0); Sea s = sea_surface({given}, p); V v; v.at = s.position;"
        " v.up = s.normal; v.place = (float4)0; return v; }\n"
    )


def hlsl_main(text, data):
    slots, given = textures_of(text, data)
    return (f"{text}\n{slots}float4 main(float4 p : SV_POSITION) : SV_TARGET {{ sea_at_time(p.z);"
            f" Sea s = sea_surface({given}, p.xy); return float4(s.position, s.normal.x); }}\n")  # fmt: skip


@pytest.mark.parametrize("name", LEVELS)
def test_phases_of_the_kit_are_the_levels(name):
    """T09: what the json's formulas make of the uniforms is what the editor gives its own shaders, after a week too."""
    level = LEVELS[name]()
    _, data = sources(level, "test", [])
    assert data.held == []
    for t in (12.34, 604_801.5):
        its = wave_uniforms(level, t)
        for key, value in uniforms_at(data, t).items():
            if key not in its:
                continue
            off = np.abs(np.asarray(value, np.float64) - np.asarray(its[key], np.float64))
            assert np.minimum(off, np.abs(1 - off)).max() < 2e-6, key


def test_what_the_tide_moves_is_said_to_be_held():
    """T09: a kit stands for one moment of tide; its list says so, and its probes keep to that moment."""
    level = plain()
    level.set("tide.on", True)
    made = sources(level, "test", [])[1]
    assert "u_tide_m" in made.held


def test_an_export_with_the_kit_checks_and_a_changed_file_is_found(tmp_path):
    """T09: all files listed with hashes; 200 probes with heights and normals, which C's answers fit."""
    level = placed()
    export(level, "raw", tmp_path / "out", name="bay", only="kit")
    assert check(tmp_path / "out") == []
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {f"bay_sea{s}" for s in (".h", ".hlsl", ".glsl", ".gdshaderinc", ".json", ".f32")} < names
    probes = json.loads((tmp_path / "out" / "bay_sea.json").read_text())["probes"]
    assert len(probes) == 200
    asks = np.array([[p["time_s"], *p["before"]] for p in probes])
    told = run_c(level, asks, tmp_path)
    assert np.abs(told[:, :6] - [[*p["position"], *p["normal"]] for p in probes]).max() < 1e-3
    path = tmp_path / "out" / "bay_sea.h"
    path.write_text(path.read_text() + "\n")
    assert any("bay_sea.h" in finding for finding in check(tmp_path / "out"))


# The translator


def unit(text, wanted="f"):
    return pruned(parse(text), (wanted,))


def test_expressions_keep_their_meaning():
    """T09: brackets, swizzles that are written, chains of assignments, copies of vectors."""
    text = "vec3 f(float a, inout vec3 v) { vec3 w; w = v = vec3(a * (a - 1.0)); v.yz *= 2.0;"
    text += " return a > 0.0 ? w.zyx : v; }"
    c = CWriter(unit(text)).text()
    assert "a * (a - 1.0f)" in c
    assert "(*v).y = part.x; (*v).z = part.y;" in c
    assert "a > 0.0f ? vec3_zyx(w) : (*v)" in c
    hlsl = HlslWriter(unit(text)).text()
    assert "float3 f(float a, inout float3 v)" in hlsl
    assert "v.yz *= 2.0;" in hlsl


def test_only_what_is_needed_is_kept():
    """T09: functions, structs, constants and uniforms that the wanted one never comes to are left out."""
    made = unit("uniform float u_a, u_b; float g() { return u_a; } float h() { return u_b; } float f() { return g(); }")
    assert [one.name for one in made.functions()] == ["g", "f"]
    assert [one.name for one in made.variables()] == ["u_a"]


def test_godot_hands_globals_along_and_names_no_two_functions_alike():
    """T09: its language has neither globals that change nor overloads."""
    made = pruned(parse(one_text(ALL)), ("sea_surface",))
    assert changed(made) == {"objects_depth", "objects_sea"}
    text = GodotWriter(made).text()
    heads = [line for line in text.splitlines() if line.endswith(") {") and line[0].isalpha()]
    names = [line.split("(")[0].split()[-1] for line in heads]
    assert len(names) == len(set(names)) > 40
    assert "\nvec3 objects_depth" not in text
    assert "inout vec3 objects_depth" in text
    assert "uniform vec4 u_region_way[32];" in text


@pytest.mark.parametrize(("text", "word"), [
    ("float f() { return other(1.0); }", "other"), ("float f() { return a; }", "a"), ("float f() @", "@"),
    ("float f() { return 1.0 }", "}"), ("struct S { float a; }; float f(S s) { return s.b; }", "S has no 'b'"),
])  # fmt: skip
def test_what_the_translator_does_not_know_is_named_with_its_line(text, word):
    """T09: a shader that uses more of GLSL than the kit knows is refused, never translated wrongly."""
    with pytest.raises(BadInput, match="line 1") as told:
        parse(text)
    assert word in str(told.value)


def test_data_of_a_kit_is_what_its_unit_declares():
    """T09: every uniform has a value and every sampler a map."""
    level = placed()
    made = pruned(parse(one_text(["WAVE_OBJECTS", "WAVE_REGIONS"])), ("sea_at", "flow_at", "flow_places"))
    data = sea_data(level, made)
    assert {one.name for one in made.variables("uniform")} == {*data.values, *data.maps}
