"""One text of the level's GLSL: includes put in, conditions decided by what the level has, its comments kept.

What is left is only what this level's sea needs, which keeps the files of the kit short.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from ....level import BadInput

SHADERS = Path(__file__).parents[3] / "level" / "shaders"
TOP, FLOW = "level/waves.glsl", "level/flow_places.glsl"
# The field that things in the water stir (D18) is the running game's own: a kit has none.
REPLACED = {"level/force.glsl": "vec3 force_lift(vec2 xy) { return vec3(0.0); }\n"}
# what games ask and pictures never do, or ask of a texture unit
ASKED = """
// The surface over a world point: the waves' shift to the side is undone step by step, to 0.1 mm. Under
// a breaker's lip there are three surfaces; this is the one that the steps come to.
Sea sea_at(vec2 world) {
    Sea sea = sea_surface(world);
    vec2 before = world, off = world - sea.position.xy;
    for (int i = 0; i < 12 && dot(off, off) > 1e-8; ++i) {
        before += off;
        sea = sea_surface(before);
        off = world - sea.position.xy;
    }
    return sea;
}

uniform sampler2D u_current;       // east, north in m/s, quiet 0 … 1, metres to the shoreline
uniform float u_current_cell_m;

// The current in m/s to the east and to the north; beyond the level that of its border.
vec2 flow_at(vec2 xy) {
    vec2 size = vec2(textureSize(u_current, 0));
    vec2 at = clamp(xy / u_current_cell_m, vec2(0.0), size - 1.0), base = min(floor(at), size - 2.0), f = at - base;
    ivec2 cell = ivec2(base);
    vec2 v00 = texelFetch(u_current, cell, 0).xy, v10 = texelFetch(u_current, cell + ivec2(1, 0), 0).xy;
    vec2 v01 = texelFetch(u_current, cell + ivec2(0, 1), 0).xy, v11 = texelFetch(u_current, cell + ivec2(1, 1), 0).xy;
    return mix(mix(v00, v10, f.x), mix(v01, v11, f.x), f.y);
}
"""
_DIRECTIVE = re.compile(r"^\s*#\s*(\w+)\s*(.*?)\s*(?://.*)?$")


def one_text(defines: Iterable[str], top: str = TOP) -> str:
    """The text of `top` with every file that it includes once; BadInput for a directive that the kit doesn't know."""
    lines: list[str] = []
    seen: set[str] = set()
    _put(top, set(defines), seen, lines)
    if top == TOP:
        _put(FLOW, set(defines), seen, lines)
        lines.append(ASKED)
    return "\n".join(lines) + "\n"


def _put(name: str, defines: set[str], seen: set[str], lines: list[str]) -> None:
    if name in seen:
        return
    seen.add(name)
    text = REPLACED.get(name) or (SHADERS / name.removeprefix("level/")).read_text("utf-8")
    lines.append(f"\n// ---- {name}\n")
    kept: list[bool] = []
    for number, line in enumerate(text.splitlines(), 1):
        found = _DIRECTIVE.match(line)
        if not found:
            if all(kept):
                lines.append(line)
            continue
        word, rest = found.groups()
        if word in ("ifdef", "ifndef"):
            kept.append((rest in defines) == (word == "ifdef"))
        elif word == "else":
            kept[-1] = not kept[-1]
        elif word == "endif":
            kept.pop()
        elif word == "include":
            if all(kept):
                _put(rest.strip('"'), defines, seen, lines)
        else:
            raise BadInput(f"{name}:{number}: the runtime kit knows no #{word}")
