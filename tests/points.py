"""The level's GLSL over points, read back: what tests hold against the CPU twin."""

import numpy as np
from shorewright.level.arrival import arrival
from shorewright.level.beach_map import beach_map
from shorewright.level.river_map import river_map
from shorewright.level.shore import shore_map
from shorewright.level.tables import tables
from shorewright.level.wave_uniforms import wave_defines, wave_uniforms
from shorewright.renderer.program import resolve
from shorewright.renderer.uniforms import set_uniforms

SEA = """
in vec2 in_at; out vec4 v_position; out vec4 v_masks; out vec4 v_sheet; out vec4 v_breaks;
#include "level/waves.glsl"
void main() {
    Sea sea = sea_surface(in_at);
    v_position = vec4(sea.position, sea.deep);
    v_masks = vec4(sea.shore.line, sea.shore.back, sea.shore.fall, sea.normal.x);
    v_sheet = vec4(sea.sheet, sea.shore.arrived, sea.normal.y, sea.shore.edge_s);
    v_breaks = vec4(0.0);
#ifdef PLUNGE
    v_breaks = vec4(sea.shore.progress, sea.shore.white, sea.shore.breaker.plunging.x, sea.shore.breaker.leaning.x);
#endif
}
"""


def transform(
    ctx, source: str, at, varyings: dict[str, int], textures: dict, uniforms: dict, defines=(), texts=None, smooth=()
):
    """Run a vertex shader over points `in_at` (n, 2 or 3), read back its varyings (floats by name), release `textures`.

    All are read texel by texel but those of `smooth`, which keep their filters; `texts` overrides includes by name.
    """
    defines = [*defines, *(["TRAVEL_TIME"] if "u_arrival" in textures else [])]
    text = (
        "#version 410 core\n"
        + "".join(f"#define {name}\n" for name in defines)
        + resolve("points", {"points": source, **(texts or {})}).text
    )
    program = ctx.program(vertex_shader=text, varyings=list(varyings))
    for unit, (name, texture) in enumerate(textures.items()):
        if name not in smooth:
            texture.filter = (ctx.NEAREST, ctx.NEAREST)
        if program.get(name, None) is None:  # no function that is called here reads it
            continue
        texture.use(unit)
        program[name] = unit
    set_uniforms(program, uniforms)
    floats = sum(varyings.values())
    points = ctx.buffer(np.ascontiguousarray(at, np.float32).tobytes())
    out = ctx.buffer(reserve=len(at) * 4 * floats)
    array = ctx.vertex_array(program, [(points, f"{np.shape(at)[1]}f", "in_at")])
    target = ctx.simple_framebuffer((1, 1))  # a surfaceless context has none, and drawing needs one
    target.use()
    array.transform(out, ctx.POINTS, vertices=len(at))
    result = np.frombuffer(out.read(), np.float32).reshape(-1, floats)
    ctx.detect_framebuffer(0).use()  # a framebuffer that is gone must not stay bound
    for thing in (array, target, out, points, *textures.values(), program):
        thing.release()
    return result


def feedback(ctx, level, t, at):
    """The level's sea at undeformed points: position, weight, masks, sheet and phase, breaking, as SEA lists them."""
    packed, sand, rivers = shore_map(level).packed, np.ascontiguousarray(beach_map(level).packed), river_map(level)
    if rivers is not None:
        packed = np.concatenate([packed, rivers.packed])
    packed = np.ascontiguousarray(packed)
    textures = {
        "u_bed": ctx.texture(packed.shape[1::-1], 4, packed.tobytes(), dtype="f4"),
        "u_tables": ctx.texture((1024, 6), 4, tables(level).tobytes(), dtype="f4"),
        "u_beach": ctx.texture(sand.shape[1::-1], 2, sand.tobytes(), dtype="f2", alignment=1),
    }
    made = arrival(level, t)
    if made is not None:
        textures["u_arrival"] = ctx.texture(made.texture.shape[1::-1], 4, made.texture.tobytes(), dtype="f4")
    varyings = {"v_position": 4, "v_masks": 4, "v_sheet": 4, "v_breaks": 4}
    return transform(ctx, SEA, at, varyings, textures, wave_uniforms(level, t), wave_defines(level))
