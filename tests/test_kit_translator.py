"""The runtime kit's translator: GLSL to C99, HLSL and Godot's language (T09)."""

import numpy as np
import pytest
from kit_parts import placed
from shorewright.io.export.kit.files import sources
from shorewright.io.export.kit.parse import parse
from shorewright.io.export.kit.reach import changed, pruned
from shorewright.io.export.kit.run import Run
from shorewright.io.export.kit.source import one_text
from shorewright.io.export.kit.write_c import CWriter
from shorewright.io.export.kit.write_godot import GodotWriter
from shorewright.io.export.kit.write_hlsl import HlslWriter
from shorewright.level import BadInput

ALL = ["WAVE_OBJECTS", "WAVE_REGIONS", "PATCHED", "PINS", "RIVERS", "PLUNGE", "TRAVEL_TIME"]


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
    source = sources(placed(), "test")
    assert {one.name for one in source.unit.variables("uniform")} == {*source.data.values, *source.data.maps}


def test_points_part_ways_as_the_language_says():
    """T09: branches, loops that end at different turns, early returns, out parameters, whole numbers that are cut."""
    text = """
    uniform int u_most;
    int total = 0;
    void split(float x, out float low, inout vec2 sum) { low = floor(x); sum.y += x - low; ++total; }
    float f(float x) {
        if (x < 0.0) return -1.0;
        vec2 sum = vec2(0.0);
        float low;
        for (int i = 0; i < u_most && sum.x < x; ++i) { sum.x += 1.0; split(x, low, sum); }
        int cut = int(-x) / 2;
        return sum.x * 100.0 + low * 10.0 + float(cut) + (x > 2.0 ? sum.y : 0.0) + float(7 % 4 << 1) * 1000.0;
    }
    """
    run = Run(unit(text), {"u_most": 3}, {}, 4)
    given = np.float32([-2.0, 0.5, 2.25, 9.5])
    expected = [-1.0, 6100.0, 6319.0 + 3 * 0.25, 6386.0 + 3 * 0.5]
    assert run.call("f", given).tolist() == expected
