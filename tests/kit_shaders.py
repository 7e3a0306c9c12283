"""The runtime kit's GLSL and HLSL run over points, for tests that hold them against the twin."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from points import transform
from shorewright.io.export.kit.data import uniforms_at
from shorewright.io.export.kit.files import text_of


def textures_of(ctx, data):
    """A texture of each map of a part, by sampler."""
    found = {}
    for name, values in data.maps.items():
        rows, cols, channels = values.shape
        kind = "f1" if values.dtype == np.uint8 else "f4"
        found[name] = ctx.texture((cols, rows), channels, values.tobytes(), dtype=kind, alignment=1)
    return found


def run_glsl(ctx, source, t, at, declares, body, varyings):
    """What `body` gives to `varyings` at points, in the GLSL of a part."""
    shader = f"{declares}\n{text_of(source, 'test', 'glsl')}\nvoid main() {{ {body} }}"
    values = {n: v if v.ndim else v.item() for n, v in uniforms_at(source.data, t).items()}
    return transform(ctx, shader, at, varyings, textures_of(ctx, source.data), values)


def validated(text, stage, folder, *words):
    """What glslangValidator says about a text; skips without it."""
    tool = shutil.which("glslangValidator")
    if tool is None:
        pytest.skip("no glslangValidator here (Debian: glslang-tools)")
    path = folder / f"text.{stage}"
    path.write_text(text)
    ran = subprocess.run([tool, *words, str(path)], capture_output=True, text=True, cwd=folder)
    assert ran.returncode == 0, ran.stdout[:2000]


def hlsl_slots(text, source, name):
    """Declarations of the textures that a function of the HLSL takes, and the arguments."""
    order = re.search(rf"^\w+ {name}\((.*)\) \{{", text, re.MULTILINE)[1]
    names = re.findall(r"Texture2D<float4> (\w+)", order)
    assert set(names) <= source.data.maps.keys()
    slots = "".join(f"Texture2D<float4> T_{name} : register(t{n});\n" for n, name in enumerate(names))
    return slots, [f"T_{name}" for name in names]


def hlsl_vertex(source, t, name, result, outputs):
    """HLSL of a vertex shader that calls one function over points p and gives `outputs`: expressions of `s`."""
    text = text_of(source, "test", "hlsl")
    split = repr(t) if t < 100 else f"float2({t // 64!r}, {t % 64!r})"
    slots, given = hlsl_slots(text, source, name)
    fields = "".join(f"float4 o{n} : O{n}; " for n in range(len(outputs)))
    sets = " ".join(f"v.o{n} = {what};" for n, what in enumerate(outputs))
    return (
        f"{text}\n{slots}struct V {{ {fields} float4 place : SV_POSITION; }};\nV main(float2 p : AT) {{"
        f" {source.part}_at_time({split}); {result} s = {name}({', '.join([*given, 'p'])}); V v; {sets}"
        " v.place = (float4)0; return v; }\n"
    )


def run_hlsl(ctx, source, t, at, folder, name, result, outputs):
    """(n, 4 · outputs) of HLSL, to SPIR-V and back to GLSL by Khronos's tools, run over points (n, 2)."""
    cross = shutil.which("spirv-cross")
    if cross is None:
        pytest.skip("no spirv-cross here")
    made = hlsl_vertex(source, t, name, result, outputs)
    validated(made, "vert", folder, "-D", "-V", "-e", "main", "-o", "kit.spv")
    words = [cross, "kit.spv", "--version", "410", "--no-es", "--no-420pack-extension"]
    back = subprocess.run(words, cwd=folder, capture_output=True, text=True, check=True).stdout
    back = re.sub(r"\bp\b", "in_at", back.split("\n", 1)[1])
    combined = "SPIRV_Cross_CombinedT_{}SPIRV_Cross_DummySampler"
    textures = {combined.format(name): one for name, one in textures_of(ctx, source.data).items()}
    return transform(ctx, back, at, {f"_entryPointOutput_o{n}": 4 for n in range(len(outputs))}, textures, {})
