"""Godot 4's shader language from the tree: GLSL's words, but no global that changes: such ones are handed along."""

from __future__ import annotations

from dataclasses import replace

from ....level import BadInput
from .reach import changed
from .tree import Expr, Function, Unit, Variable
from .write import TIGHT, Writer

WORDS = (
    "global instance varying group_uniforms render_mode shader_type hint filter repeat "
    "lowp mediump highp flat smooth PI TAU E TIME"
)
ROOTS = ("sea_surface", "sea_at")  # nothing is handed to them


class GodotWriter(Writer):
    taken = frozenset(WORDS.split())
    overloads = False

    def __init__(self, unit: Unit) -> None:
        super().__init__(unit)
        self.changing = changed(unit)

    def declared(self, one: Variable) -> str:
        """Sizes of arrays as numbers: a product of constants is none to every version."""
        if one.size:
            one = replace(one, size=Expr("num", "int", str(self.count(one.size))))
        return super().declared(one)

    def count(self, of: Expr) -> int:
        """A size, worked out."""
        if of.kind == "name":
            value = self.globals[of.text].value
            return self.count(value) if value else 0
        if of.kind == "binary" and of.text == "*":
            return self.count(of.parts[0]) * self.count(of.parts[1])
        if of.kind != "num":
            raise BadInput(f"the runtime kit's Godot writer takes no {of.kind} for the size of an array")
        return int(of.text)

    def carried(self, function: Function) -> list[str]:
        return [] if function.name in ROOTS else [name for name in function.uses if name in self.changing]

    def x_call(self, of: Expr) -> tuple[str, int]:
        if of.text == "findLSB":  # Compatibility has none: of a power of two the logarithm is exact enough
            bits = self.expr(of.parts[0], TIGHT)
            return f"int(log2(float({bits} & (~{bits} + 1u))) + 0.5)", TIGHT + 2
        return super().x_call(of)

    def arguments(self, own: Function, of: Expr) -> list[str]:
        return [*self.carried(own), *super().arguments(own, of)]

    def extra(self, item: Function) -> list[str]:
        return [f"inout {self.globals[name].type} {name}" for name in self.carried(item)]

    def function(self, item: Function) -> list[str]:
        found = super().function(item)
        if item.name == "sea_surface":  # what is handed along begins here
            found[1:1] = [f"    {self.globals[n].type} {n};" for n in item.uses if n in self.changing]
        return found

    def variable(self, one: Variable) -> list[str]:
        if one.way == "uniform":
            hint = " : filter_nearest, repeat_disable" if one.type == "sampler2D" else ""
            return [f"uniform {self.declared(one).removeprefix('const ')}{hint};"]
        if one.way == "const":
            return [f"{self.declared(one)};"]
        return [] if one.name in self.changing else [f"const {self.declared(one)};"]
