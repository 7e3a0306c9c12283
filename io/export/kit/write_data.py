"""The numbers of a part of the kit as C and HLSL: uniforms with their values, maps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .tree import Unit, Variable, base, width
from .write_time import c_time

if TYPE_CHECKING:
    from .data import KitData


def number(value, kind: str, suffix: str) -> str:
    """One value as a literal that gives the same float32 back."""
    if kind == "bool":
        return "true" if value else "false"
    if kind in ("int", "uint"):
        return str(int(value))
    text = f"{float(np.float32(value)):.9g}"
    return (text if any(c in text for c in ".en") else text + ".0") + suffix


def rows_of(one: Variable, data: KitData) -> list[list]:
    """A uniform's value row by row (one row unless it is an array), as wide as its type."""
    kind = one.type.removesuffix("[]")
    value = np.atleast_1d(data.values[one.name])
    value = value.reshape(-1, value.shape[-1]) if value.ndim > 1 else value.reshape(1, -1)
    if value.shape[-1] < width(kind):  # the shader's type is wider than what it is given
        value = np.pad(value, ((0, 0), (0, width(kind) - value.shape[-1])))
    return value[:, : width(kind)].tolist()


def places(maps: dict[str, np.ndarray]) -> dict[str, int]:
    """Where each map begins in its file, in samples: float32 ones follow each other in the .f32, bytes in the .u8."""
    ends, found = {}, {}
    for name, values in maps.items():
        found[name] = ends.get(values.dtype, 0)
        ends[values.dtype] = found[name] + values.size
    return found


def c_data(unit: Unit, data: KitData, part: str) -> str:
    """`PART_set_up` and `PART_at_time` in C; the caller gives the texels of all maps, as in the files."""
    takes = f"{part}_state *g, const float *texels, const unsigned char *bytes"
    lines = [c_time(unit, data, part),
             "// `texels`: the whole .f32 beside this file, `bytes`: the .u8; both must live as long as the state.",
             f"static inline void {part}_set_up({takes}) {{"]  # fmt: skip
    at = places(data.maps)
    for name, values in data.maps.items():
        rows, cols, channels = values.shape
        where = f"0, bytes + {at[name]}" if values.dtype == np.uint8 else f"texels + {at[name]}, 0"
        lines.append(f"    g->{name} = (texel_map){{{where}, {cols}, {rows}, {channels}}};")
    for one in unit.variables():
        lines += _c_values(one, data)
    return "\n".join([*lines, f"    {part}_at_time(g, 0.0);", "}"]) + "\n"


def _c_values(one: Variable, data: KitData) -> list[str]:
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


def hlsl_data(unit: Unit, data: KitData) -> str:
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
