"""The numbers of a sea as C and HLSL: set-up, and the phases at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .tree import Unit, Variable, base, width

if TYPE_CHECKING:
    from .data import SeaData

CYCLES = 4096  # of the shore clock, after which the same waves come
C_TIME = """
static inline float sea_phase(double start, double rate, double t) {
    double cycles = start + rate * t;
    return (float)(cycles - floor(cycles));
}

static inline float sea_turns(double start, double rate, double t, double turns) {
    double whole = floor(start + rate * t);
    return (float)(whole - floor(whole / turns) * turns);
}

// The sea at a time in seconds since its beginning; wrapped in double, so that it holds for weeks.
static inline void sea_at_time(sea_state *g, double t) {"""


def number(value, kind: str, suffix: str) -> str:
    """One value as a literal that gives the same float32 back."""
    if kind == "bool":
        return "true" if value else "false"
    if kind in ("int", "uint"):
        return str(int(value))
    text = f"{float(np.float32(value)):.9g}"
    return (text if any(c in text for c in ".en") else text + ".0") + suffix


def rows_of(one: Variable, data: SeaData) -> list[list]:
    """A uniform's value row by row (one row unless it is an array), as wide as its type."""
    kind = one.type.removesuffix("[]")
    value = np.atleast_1d(data.values[one.name])
    value = value.reshape(-1, value.shape[-1]) if value.ndim > 1 else value.reshape(1, -1)
    if value.shape[-1] < width(kind):  # the shader's type is wider than what it is given
        value = np.pad(value, ((0, 0), (0, width(kind) - value.shape[-1])))
    return value[:, : width(kind)].tolist()


def c_data(unit: Unit, data: SeaData) -> str:
    """`sea_set_up` and `sea_at_time` in C; a map's texels are given by the caller, one after another as in the .f32."""
    lines = [C_TIME]
    if data.loop_s > 0:
        lines.append(f"    t -= floor(t / {data.loop_s!r}) * {data.loop_s!r};")
    lines.append(f"    double waves = t * {data.clock_hz!r};")
    lines.append("    g->u_shore_clock = (float)(waves - floor(waves));")
    lines.append(f"    g->u_shore_cycle = (int)(floor(waves) - floor(waves / {CYCLES}.0) * {CYCLES}.0);")
    for phase in data.phases:
        row = f"[{phase.row}]" if phase.row >= 0 else ""
        asked = f"{phase.start!r}, {phase.rate_hz!r}, t"
        text = f"sea_turns({asked}, {phase.turns}.0)" if phase.turns else f"sea_phase({asked})"
        lines.append(f"    g->{phase.uniform}{row}.{'xyzw'[phase.part]} = {text};")
    lines += ["}", "", "// `texels`: the whole of the .f32 file beside this one; it must live as long as the state.",
              "static inline void sea_set_up(sea_state *g, const float *texels) {"]  # fmt: skip
    at = 0
    for name, values in data.maps.items():
        rows, cols, channels = values.shape
        lines.append(f"    g->{name} = (sea_map){{texels + {at}, {cols}, {rows}, {channels}}};")
        at += values.size
    for one in unit.variables():
        lines += _c_values(one, data)
    return "\n".join([*lines, "    sea_at_time(g, 0.0);", "}"]) + "\n"


def _c_values(one: Variable, data: SeaData) -> list[str]:
    if one.way == "const" or one.type == "sampler2D":
        return []
    kind = one.type.removesuffix("[]")
    if one.way != "uniform":  # what a drawing shader alone changes; 1 and 0
        if one.value is None:
            return []
        first = one.value if one.value.kind == "num" else one.value.parts[0]
        rows = [[float(first.text)] * width(kind)]
    else:
        rows = rows_of(one, data)
    found = []
    for n, row in enumerate(rows):
        parts = ", ".join(number(value, base(kind), "f") for value in row)
        text = parts if width(kind) == 1 else f"({kind}){{{parts}}}"
        found.append(f"    g->{one.name}{f'[{n}]' if one.size else ''} = {text};")
    return found


def hlsl_data(unit: Unit, data: SeaData) -> str:
    """The uniforms as globals with their values, sizes of the maps."""
    lines = []
    for one in unit.variables("uniform"):
        kind = one.type.removesuffix("[]")
        if one.type == "sampler2D":
            if one.name in data.maps:
                rows, cols, _ = data.maps[one.name].shape
                lines.append(f"static const int2 {one.name}_size = int2({cols}, {rows});")
            continue
        shown = f"{base(kind)}{width(kind)}" if width(kind) > 1 else kind
        rows = [", ".join(number(value, base(kind), "") for value in row) for row in rows_of(one, data)]
        values = rows if width(kind) == 1 else [f"{shown}({row})" for row in rows]
        if one.size:
            lines.append(f"static {shown} {one.name}[{len(values)}] = {{{', '.join(values)}}};")
        else:
            lines.append(f"static {shown} {one.name} = {values[0]};")
    return "\n".join(lines) + "\n"


def hlsl_time(data: SeaData) -> str:
    """`sea_at_time` in HLSL, in float32."""
    lines = [
        "",
        "// The sea at a time; in float32 good to a millimetre within the first quarter of an hour. A game that runs",
        "// longer wraps the phases in double, as the C header does, and sets these globals from its own constants.",
        "void sea_at_time(float t) {",
    ]  # fmt: skip
    if data.loop_s > 0:
        lines.append(f"    t -= floor(t / {data.loop_s!r}) * {data.loop_s!r};")
    lines += [
        f"    float waves = t * {data.clock_hz:.9g};",
        "    u_shore_clock = frac(waves);",
        f"    u_shore_cycle = int(floor(waves)) % {CYCLES};",
    ]
    for phase in data.phases:
        row = f"[{phase.row}]" if phase.row >= 0 else ""
        rate, start = (number(value, "float", "") for value in (phase.rate_hz, phase.start))
        text = f"frac({start} + {rate} * t)"
        text = f"fmod(floor({start} + {rate} * t), {phase.turns}.0)" if phase.turns else text
        lines.append(f"    {phase.uniform}{row}.{'xyzw'[phase.part]} = {text};")
    return "\n".join([*lines, "}"]) + "\n"
