"""Shader programs: includes, places of errors, hot reload, samplers; everything compiles for OpenGL 4.1 (D01, T11)."""

import os

import pytest
from shorewright.renderer.frame import OFF, PASSES
from shorewright.renderer.program import MOST_SAMPLERS, SHADERS, Programs, Shader, ShaderError, explain, resolve
from shorewright.renderer.uniforms import set_uniforms
from shorewright.renderer.views import VIEWS

ALL_OFF = dict.fromkeys(OFF["sea.glsl"].values(), "")
VARIANTS = {"sea.glsl": ({"MESH": ""}, {"MESH": "", **ALL_OFF}, {"MESH": "", "COARSE": ""},
                         {"HORIZON": ""}, {"MESH": "", "TESSELLATED": ""},
                         {"MESH": "", "MEASURED": ""}, {"MESH": "", "MEASURED": "", "TESSELLATED": ""},
                         {"MESH": "", "PATCHED": "", "CLOUD_SHADOW": ""},
                         {"MESH": "", "WAVE_OBJECTS": ""}, {"MESH": "", "COARSE": "", "WAVE_REGIONS": ""},
                         {"MESH": "", "TESSELLATED": "", "WAVE_OBJECTS": "", "WAVE_REGIONS": ""},
                         {"HORIZON": "", "WAVE_OBJECTS": "", "WAVE_REGIONS": ""}, {"MESH": "", "PINS": ""},
                         {"MESH": "", "PINS": "", "TRAVEL_TIME": ""}, {"MESH": "", "PLUNGE": "", "TESSELLATED": ""},
                         {"MESH": "", "PLUNGE": "", "TRAVEL_TIME": "", "PLATE": ""},
                         {"MESH": "", "RIVERS": "", "PLATE": ""}, {"HORIZON": "", "RIVERS": "", "PLUNGE": ""},
                         {"MESH": "", "RIVERS": "", "PLATE": "", "RAIN_RINGS": "", "CLOUD_SHADOW": ""}),
            "shadow.glsl": ({"START": ""}, {"SPREAD": ""}), "openness.glsl": ({"WAYS": "8", "STEPS": "11"},),
            "terrain.glsl": ({"GROUND_CHEAP": ""}, {"RIVERS": ""},
                             {"SMOOTH_NEAR": "", "RELIEF": "", "SHOW_GROUND": "", "MOST_LAYERS": "3"}),
            "light.glsl": ({}, {"WHITE": ""}, {"LAND_FIRST": ""},
                           {"SEA_ALONE": "", "REFLECTIONS": "", "QUIET": "", "CLOUD_SHADOW": ""},
                           {"SEA_ALONE": "", "REFLECTIONS": "", "RIVERS": ""}),
            "lamps.glsl": ({}, {"UNDER": ""}), "props.glsl": ({}, {"MARK": ""}), "prop_shadow.glsl": ({}, {"PROP": ""}),
            "plate.glsl": ({"DOWN": ""}, {"DOWN": "", "RIVERS": ""},
                            {"ALONG": ""}, {"ACROSS": ""}), "overlay.glsl": ({}, {"WALKABLE": ""}),
            "lines.glsl": ({}, {"ON_WATER": ""}),
            "fronts.glsl": ({}, {"TRAVEL_TIME": ""}, {"TRAVEL_TIME": "", "PATCHED": ""}),
            "weather_inset.glsl": ({"INSET_MAP": ""},),
            "view.glsl": ({"VIEW_VALUE": "vec3(1.0)"},
                          {"VIEW_VALUE": "masked_shown(sea, s.before, 0.1)", "RIVERS": ""},
                          {"VIEW_VALUE": "flow_exported(s.before, 0.1)", "FLOW_BYTES": ""},
                          {"VIEW_VALUE": "breaking_colour(sea)", "PLUNGE": "", "TRAVEL_TIME": ""},
                          {"VIEW_VALUE": "vec3(rain_at(position.xy, ground.x), 0.0)", "WEATHER": ""},
                          {"VIEW_VALUE": "rain_shown(s.before, 0.1)", "RAIN_RINGS": ""},
                          {"VIEW_VALUE": "breaker_shown(passage_at(position.xy))", "PASSAGE": "", "TRAVEL_TIME": ""},
                          {"VIEW_VALUE": "weather_stage(position.xy)", "WEATHER_STAGE": ""},
                          {"VIEW_VALUE": "wave_objects_colour(position.xy, 1.0)", "WAVE_OBJECTS": "",
                           "WAVE_REGIONS": ""}),
            "sky.glsl": ({}, {"HIGH_CLOUDS": ""}), "lobes.glsl": ({}, {"CLOUDS": "", "HIGH_CLOUDS": ""}),
            "clouds.glsl": ({}, {"CHEAP_STEPS": ""}), "cloud_resolve.glsl": ({}, {"STILL": ""}, {"MOVED": ""}),
            "scatter.glsl": ({"ROCK": ""}, {"WOOD": ""}, {"GRASS": "", "MARK": ""})}  # fmt: skip
PROGRAMS = [
    (name, defines)
    for name in sorted(path.name for path in SHADERS.glob("*.glsl"))
    for defines in VARIANTS.get(name, ({"VIEW_VALUE": "vec3(1.0)"} if name == "cloud_view.glsl" else {},))
]
GOOD = """#ifdef VERTEX
void main() { gl_Position = vec4(0.0); }
#endif
#ifdef FRAGMENT
%s
out vec4 c;
void main() { c = %s; }
#endif
"""


def test_includes_are_guarded_numbered_and_nested():
    texts = {
        "a.glsl": '#include "b.glsl"\n#include "c.glsl"\nA',
        "b.glsl": '#include "c.glsl"\nB',
        "c.glsl": "C",
    }
    source = resolve("a.glsl", texts)
    assert source.files == ["a.glsl", "b.glsl", "c.glsl"]
    lines = source.text.splitlines()
    assert lines[: lines.index("C")].count("#ifndef INCLUDED_c_glsl") == 1
    after_b = lines.index("B")
    assert lines[after_b - 1] == "#line 2 1"
    assert lines[lines.index("A") - 1] == "#line 3 0"


def test_level_shaders_are_found_by_their_prefix():
    source = resolve("x.glsl", {"x.glsl": '#include "level/waves.glsl"'})
    assert {"level/waves.glsl", "level/bed.glsl", "level/gerstner.glsl"} <= set(source.files)


@pytest.mark.parametrize(
    ("texts", "names"),
    [
        ({"a.glsl": '#include "nowhere.glsl"'}, ("a.glsl", "nowhere.glsl")),
        ({"a.glsl": '#include "b.glsl"', "b.glsl": '#include "a.glsl"'}, ("b.glsl", "a.glsl")),
    ],
)
def test_missing_and_circular_includes_are_named(texts, names):
    with pytest.raises(ShaderError) as error:
        resolve("a.glsl", texts)
    assert all(name in str(error.value) for name in names)


@pytest.mark.parametrize("line", ["1:7(12): error: x", "ERROR: 1:7: x", "1(7) : error C0000: x"])
def test_errors_of_three_drivers_get_a_file_and_a_line(line):
    source = resolve("a.glsl", {"a.glsl": '#include "b.glsl"', "b.glsl": ""})
    assert "b.glsl:7" in explain(line, source)


@pytest.mark.gl
def test_an_error_in_an_include_names_its_file_and_line(ctx):
    texts = {"a.glsl": GOOD % ('#include "bad.glsl"', "vec4(f())"), "bad.glsl": "\n\nfloat f() { return nothing; }"}
    with pytest.raises(ShaderError, match=r"bad\.glsl:3"):
        Shader(ctx, "a.glsl", texts=texts)


@pytest.mark.gl
def test_an_include_counts_once_a_stage_even_inside_one_stage_only(ctx):
    texts = {
        "a.glsl": '#ifdef VERTEX\n#include "f.glsl"\nvoid main() { gl_Position = vec4(f()); }\n#endif\n'
        '#ifdef FRAGMENT\n#include "f.glsl"\n#include "f.glsl"\nout vec4 c;\nvoid main() { c = vec4(f()); }\n#endif\n',
        "f.glsl": "float f() { return 1.0; }",
    }
    Shader(ctx, "a.glsl", texts=texts).release()


@pytest.mark.gl
def test_hot_reload_keeps_the_last_good_program(ctx, tmp_path, monkeypatch):
    monkeypatch.setattr("shorewright.renderer.program.SHADERS", tmp_path)
    path = tmp_path / "hot.glsl"
    path.write_text(GOOD % ("uniform float u_a;", "vec4(u_a)"))
    shader = Shader(ctx, "hot.glsl")
    first = shader.program
    assert not shader.reload()
    for stamp, text in ((2, GOOD % ("", "vec4(oops)")), (3, GOOD % ("uniform float u_b;", "vec4(u_b)"))):
        path.write_text(text)
        os.utime(path, (stamp, stamp))
        changed = shader.reload()
        if stamp == 2:
            assert not changed
            assert shader.program is first
            assert "hot.glsl" in shader.error
        else:
            assert changed
            assert "u_b" in shader.program
            assert shader.error == ""
            assert shader.generation == 1
    shader.release()


@pytest.mark.gl
def test_a_uniform_that_the_compiler_removed_is_skipped(ctx):
    shader = Shader(ctx, "a.glsl", texts={"a.glsl": GOOD % ("uniform float u_a, u_gone;", "vec4(u_a)")})
    set_uniforms(shader.program, {"u_a": 2.0, "u_gone": 3.0, "u_never": 4.0})
    assert shader.program["u_a"].value == 2.0
    shader.release()


@pytest.mark.gl
@pytest.mark.parametrize(
    ("name", "defines"), PROGRAMS, ids=lambda v: v if isinstance(v, str) else "+".join(v) or "plain"
)
def test_every_program_compiles_with_at_most_16_samplers(ctx, name, defines):
    shader = Shader(ctx, name, defines)
    assert len(shader.samplers) <= MOST_SAMPLERS
    shader.release()


@pytest.mark.gl
def test_views_compile_with_at_most_16_samplers(ctx):
    """Every buffer and mask is a view (D01, D03, D04)."""
    programs = Programs(ctx)
    for view in VIEWS.values():
        if view.value:
            defines = {"LAYER": ""} if view.layer else {"WALKABLE": ""} if view.name == "walkable" else {}
            defines |= {"SHORE_FIELD": ""} if "shore_field" in view.value else {}
            defines |= {"HIGH_CLOUDS": ""} if "cirrus_at" in view.value or "alto_at" in view.value else {}
            defines |= {"PATCHES": ""} if "patch_colour" in view.value else {}
            defines |= {"BEACH_MESH": ""} if "beach_mesh" in view.value else {}
            defines |= {"WEATHER_STAGE": ""} if "weather_stage" in view.value else {}
            defines |= {"WEATHER": ""} if "rain_at" in view.value or "weather_map" in view.value else {}
            defines |= {"PASSAGE": ""} if "passage" in view.value else {}
            defines |= {"FLOW_BYTES": ""} if "flow_exported" in view.value or "flow_lost" in view.value else {}
            name = "cloud_view.glsl" if view.sky else "view.glsl"
            assert len(programs.get(name, VIEW_VALUE=view.value, **defines).samplers) <= MOST_SAMPLERS
    programs.release()


def test_passes_name_shaders_that_exist_and_a_module_each():
    from importlib.util import find_spec

    for row in PASSES:
        assert find_spec(f"shorewright.renderer.passes.{row.name}"), row.name
        for shader in row.shaders:
            assert (SHADERS / shader).is_file(), shader
    named = {shader for row in PASSES for shader in row.shaders} | {"copy.glsl"}
    assert named == {path.name for path in SHADERS.glob("*.glsl")}
