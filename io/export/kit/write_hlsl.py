"""HLSL from the tree, for Unity's and Unreal's include files: textures are handed along, as a custom node has them."""

from __future__ import annotations

from .meaning import COMPARE
from .tree import Expr, Function, Struct, Variable, base, width
from .write import TIGHT, Writer

RENAMED = {"mix": "lerp", "fract": "frac", "findLSB": "firstbitlow"}
WORDS = (
    "point line lineadj triangle triangleadj sample pass technique shared vector matrix string texture precise "
    "linear centroid register packoffset out inout in lerp frac half fixed saturate noise interface near far"
)

# several parts of the kit may be read into one shader
SIZE = """#ifndef SHOREWRIGHT_TEXTURE_SIZE
#define SHOREWRIGHT_TEXTURE_SIZE
int2 texture_size(Texture2D<float4> map) {
    uint width, height;
    map.GetDimensions(width, height);
    return int2(width, height);
}
#endif
"""


class HlslWriter(Writer):
    taken = frozenset(WORDS.split())

    def kind(self, name: str) -> str:
        if name == "sampler2D":
            return "Texture2D<float4>"
        return f"{base(name)}{width(name)}" if width(name) > 1 else name

    def x_call(self, of: Expr) -> tuple[str, int]:
        if of.text in self.owned:
            return super().x_call(of)
        given = [self.expr(part) for part in of.parts]
        if of.text == "texelFetch":
            return f"{given[0]}.Load(int3({given[1]}, {given[2]}))", TIGHT + 2
        if of.text == "textureSize":
            known = of.parts[0].text in self.globals
            return f"{given[0]}_size" if known else f"texture_size({given[0]})", TIGHT + 2
        if of.text in COMPARE:
            return f"({given[0]} {COMPARE[of.text]} {given[1]})", TIGHT + 2
        if of.text == "mod":  # fmod turns round below 0
            a, b = (self.expr(part, TIGHT) for part in of.parts)
            return f"({a} - {b} * floor({a} / {b}))", TIGHT + 2
        if of.text == "findLSB":
            return f"(int)firstbitlow({given[0]})", TIGHT
        return f"{RENAMED.get(of.text, of.text)}({', '.join(given)})", TIGHT + 2

    def x_new(self, of: Expr) -> tuple[str, int]:
        given = ", ".join(map(self.expr, of.parts))
        if width(of.type) == 0:
            return f"make_{of.type}({given})", TIGHT + 2
        if len(of.parts) == 1:
            return f"({self.kind(of.type)})({given})", TIGHT
        return f"{self.kind(of.type)}({given})", TIGHT + 2

    def x_binary(self, of: Expr) -> tuple[str, int]:
        text, binds = super().x_binary(of)
        if of.text == "==" and width(of.parts[0].type) > 1:
            return f"all({text})", TIGHT + 2
        return text, binds

    # textures go along with every call that comes to one

    def textures(self, function: Function) -> list[str]:
        return [name for name in function.uses if self.globals[name].type == "sampler2D"]

    def arguments(self, own: Function, of: Expr) -> list[str]:
        return [*self.textures(own), *super().arguments(own, of)]

    def extra(self, item: Function) -> list[str]:
        return [f"Texture2D<float4> {name}" for name in self.textures(item)]

    def unset(self, one: Variable) -> str:
        return "" if one.size else f" = ({self.kind(one.type)})0"

    # the top

    def text(self) -> str:
        whole = super().text()
        return f"{SIZE}\n{whole}" if "texture_size(" in whole else whole

    def variable(self, one: Variable) -> list[str]:
        if one.way == "uniform":
            return []
        return [f"static {self.declared(one)};"]

    def declared(self, one: Variable) -> str:
        if one.way == "const" and one.value and one.value.kind == "new" and width(one.type) == 0:
            return f"const {one.type} {one.name} = {self.constant(one.value)}"
        return super().declared(one)

    def constant(self, of: Expr) -> str:
        """A struct's value as the flat list that an initialiser takes."""
        if of.kind == "new" and width(of.type) == 0:
            return "{" + ", ".join(map(self.constant, of.parts)) + "}"
        return self.expr(of)

    def struct(self, item: Struct) -> list[str]:
        lines = super().struct(item)
        if any(one.size for one in item.members):
            return lines
        takes = ", ".join(self.member(one) for one in item.members)
        sets = " ".join(f"made.{self.named(one.name)} = {self.named(one.name)};" for one in item.members)
        return [*lines, "", f"{item.name} make_{item.name}({takes}) {{ {item.name} made; {sets} return made; }}"]
