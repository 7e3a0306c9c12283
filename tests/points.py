"""The level's GLSL over points, read back: what tests hold against the CPU twin."""

import numpy as np
from shorewright.level.beach_map import beach_map
from shorewright.level.noise import lattice
from shorewright.level.shore import shore_map
from shorewright.level.waves import wave_uniforms
from shorewright.renderer.program import resolve
from shorewright.renderer.uniforms import set_uniforms

GLSL = """
in vec2 in_before; out vec4 v_position; out vec4 v_masks; out vec4 v_sheet;
#include "level/waves.glsl"
void main() {
    Sea sea = sea_surface(in_before);
    v_position = vec4(sea.position, sea.deep);
    v_masks = vec4(sea.shore.line, sea.shore.back, sea.shore.fall, sea.normal.x);
    v_sheet = vec4(sea.sheet, sea.shore.arrived, sea.normal.y, sea.shore.edge_s);
}
"""


def feedback(ctx, level, t, at):
    """Run the level's GLSL over points in a vertex shader and read back its twelve varyings."""
    source = "#version 410 core\n" + resolve("points", {"points": GLSL}).text
    program = ctx.program(vertex_shader=source, varyings=["v_position", "v_masks", "v_sheet"])
    packed = np.ascontiguousarray(shore_map(level).packed)
    bed = ctx.texture(packed.shape[1::-1], 4, packed.tobytes(), dtype="f4")
    variety = ctx.texture((64, 64), 1, lattice(level.settings.level.seed).tobytes(), dtype="f4")
    sand = np.ascontiguousarray(beach_map(level).packed)
    beach = ctx.texture(sand.shape[1::-1], 2, sand.tobytes(), dtype="f2", alignment=1)
    for unit, (name, texture) in enumerate((("u_bed", bed), ("u_variety", variety), ("u_beach", beach))):
        texture.filter = (ctx.NEAREST, ctx.NEAREST)
        texture.use(unit)
        program[name] = unit
    set_uniforms(program, wave_uniforms(level, t))
    points = ctx.buffer(at.tobytes())
    out = ctx.buffer(reserve=len(at) * 48)
    array = ctx.vertex_array(program, [(points, "2f", "in_before")])
    target = ctx.simple_framebuffer((1, 1))  # a surfaceless context has none, and drawing needs one
    target.use()
    array.transform(out, ctx.POINTS, vertices=len(at))
    result = np.frombuffer(out.read(), np.float32).reshape(-1, 12)
    ctx.detect_framebuffer(0).use()  # a framebuffer that is gone must not stay bound
    for thing in (array, target, out, points, bed, beach, variety, program):
        thing.release()
    return result
