"""C99 from the tree: vectors are structs, their operators small functions, globals live in a `sea_state`."""

from __future__ import annotations

import re

from ....level import BadInput
from .c_parts import Parts
from .meaning import BY_PART, COMPARE, parts_of
from .parse import swizzle
from .tree import Expr, Function, Statement, Struct, Unit, Variable, base, width
from .write import TIGHT, Writer

OPERATORS = {"+": "add", "-": "sub", "*": "mul", "/": "div"}
COMPARED = {"<": "less", "<=": "lessEqual", ">": "greater", ">=": "greaterEqual", "==": "equal"}
WORDS = (
    "auto break case char const continue default do double else enum extern float for goto if inline int long "
    "register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while bool "
    "true false g near far small interface"
)
TYPES = """#ifndef SHOREWRIGHT_TYPES
#define SHOREWRIGHT_TYPES
VECTORS
typedef struct { const float *texels; const unsigned char *bytes; int width, height, channels; } texel_map;

static inline vec4 texel_of(const texel_map *map, ivec2 at) {
    size_t first = ((size_t)at.y * (size_t)map->width + (size_t)at.x) * (size_t)map->channels;
    float v[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    for (int i = 0; i < map->channels && i < 4; ++i)
        v[i] = map->bytes ? (float)map->bytes[first + (size_t)i] / 255.0f : map->texels[first + (size_t)i];
    return (vec4){v[0], v[1], v[2], v[3]};
}

#define SHOREWRIGHT_JOIN_(a, b) a##b
#define SHOREWRIGHT_JOIN(a, b) SHOREWRIGHT_JOIN_(a, b)
#endif
"""
# two levels in one program: every name of a header goes through one macro
NAMES = """#ifndef SHOREWRIGHT_PREFIX
#define SHOREWRIGHT_PREFIX
#endif
"""


class CWriter(Writer):
    taken = frozenset(WORDS.split())
    overloads = False

    def __init__(self, unit: Unit, part: str = "sea") -> None:
        super().__init__(unit)
        self.part = part
        self.parts = Parts()
        self.pointers: set[str] = set()
        self.body_now: list[Statement] = []

    def kept(self, name: str) -> bool:
        """True for what the state holds: uniforms and globals that may change."""
        return name in self.globals and self.globals[name].way != "const" and name not in self.local

    def name(self, of: Expr) -> str:
        if of.text in self.pointers:
            return f"(*{self.named(of.text)})"
        return f"g->{of.text}" if self.kept(of.text) else self.named(of.text)

    def x_num(self, of: Expr) -> tuple[str, int]:
        return of.text + ("f" if of.type == "float" else ""), TIGHT + 2

    def x_unary(self, of: Expr) -> tuple[str, int]:
        if width(of.type) > 1:
            return f"{self.parts.of('neg', [of.type], of.type)}({self.expr(of.parts[0])})", TIGHT + 2
        return super().x_unary(of)

    def x_binary(self, of: Expr) -> tuple[str, int]:
        types = [part.type for part in of.parts]
        if max(map(width, types)) == 1:
            return super().x_binary(of)
        if of.text == "==":
            name = self.parts.reduced("same", types[0])
        else:
            name = self.parts.of(OPERATORS[of.text], types, of.type)
        return f"{name}({', '.join(map(self.expr, of.parts))})", TIGHT + 2

    def x_field(self, of: Expr) -> tuple[str, int]:
        if swizzle(of):
            name = self.parts.swizzled(of.parts[0].type, parts_of(of.text))
            return f"{name}({self.expr(of.parts[0])})", TIGHT + 2
        return super().x_field(of)

    def x_index(self, of: Expr) -> tuple[str, int]:
        if width(of.parts[0].type) > 1:
            return f"{self.parts.picked(of.parts[0].type)}({', '.join(map(self.expr, of.parts))})", TIGHT + 2
        return super().x_index(of)

    def x_new(self, of: Expr) -> tuple[str, int]:
        given = ", ".join(map(self.expr, of.parts))
        if width(of.type) == 0:
            return f"({of.type}){{{given}}}", TIGHT + 2
        if width(of.type) == 1:
            return f"({of.type}){self.expr(of.parts[0], TIGHT + 1)}", TIGHT
        return f"{self.parts.built(of.type, [part.type for part in of.parts])}({given})", TIGHT + 2

    def x_call(self, of: Expr) -> tuple[str, int]:
        if of.text in self.owned:
            return super().x_call(of)
        types, given = [part.type for part in of.parts], [self.expr(part) for part in of.parts]
        if of.text == "texelFetch":
            return f"texel_of({self.map_of(of.parts[0])}, {given[1]})", TIGHT + 2
        if of.text == "textureSize":
            name = self.parts.whole("size_of", "ivec2", "const texel_map *a", "return (ivec2){a->width, a->height};")
            return f"{name}({self.map_of(of.parts[0])})", TIGHT + 2
        if of.text == "findLSB":
            text = "int n = 0; while (n < 32 && !(a >> n & 1u)) ++n; return n < 32 ? n : -1;"
            name = self.parts.whole("first_bit", "int", "uint a", text)
        elif of.text in BY_PART:
            name = self.parts.of(of.text, [self.raised(kind, of.type) for kind in types], of.type)
        elif of.text in COMPARE:
            name = self.parts.of(COMPARED[COMPARE[of.text]], types, of.type)
        else:
            name = self.parts.reduced(of.text, types[0])
        return f"{name}({', '.join(given)})", TIGHT + 2

    @staticmethod
    def raised(kind: str, result: str) -> str:
        """A whole number among reals is one of them."""
        return "float" if base(result) == "float" and width(kind) == 1 else kind

    def map_of(self, of: Expr) -> str:
        return f"&{self.name(of)}" if self.kept(of.text) else self.name(of)

    def arguments(self, own: Function, of: Expr) -> list[str]:
        found = ["g"] if self.needs(own) else []
        for part, wanted in zip(of.parts, own.parameters, strict=True):
            if wanted.type == "sampler2D":
                found.append(self.map_of(part))
            else:
                found.append(f"&{self.expr(part, TIGHT)}" if wanted.way in ("out", "inout") else self.expr(part))
        return found

    def needs(self, function: Function) -> bool:
        return any(self.globals[name].way != "const" for name in function.uses)

    # statements

    def do(self, of: Expr, pad: str) -> list[str]:
        if of.kind != "assign" or (of.text == "=" and of.parts[1].kind == "assign"):
            return super().do(of, pad)
        left, right = of.parts
        if width(left.type) <= 1:
            return super().do(of, pad)
        if of.text != "=":
            right = Expr("binary", left.type, of.text[:-1], [left, right])
        if not swizzle(left):
            return [f"{pad}{self.expr(left)} = {self.expr(right, -2)};"]
        target, letters = self.expr(left.parts[0], TIGHT + 1), parts_of(left.text)
        each = " ".join(f"{target}.{to} = part.{by};" for to, by in zip(letters, "xyzw", strict=False))
        return [f"{pad}{{ {left.type} part = {self.expr(right)}; {each} }}"]

    def unset(self, one: Variable) -> str:
        return " = {0}" if one.size or width(one.type) != 1 else " = 0"

    def statement(self, of: Statement, depth: int) -> list[str]:
        lines = super().statement(of, depth)
        unread = [one.name for one in of.variables if not _names(self.body_now, one.name)]
        return [*lines, *(f"{'    ' * depth}(void){self.named(name)};" for name in unread)]

    def function(self, item: Function) -> list[str]:
        self.pointers = {one.name for one in item.parameters if one.way in ("out", "inout")}
        self.body_now = item.body
        found = super().function(item)
        self.pointers = set()
        unread = [one.name for one in item.parameters if not _names(item.body, one.name)]
        found[1:1] = [f"    (void){self.named(name)};" for name in unread]
        return found

    def head(self, item: Function) -> str:
        return f"static inline {self.kind(item.type)} {self.function_name(item)}"

    def extra(self, item: Function) -> list[str]:
        return [f"{self.part}_state *g"] if self.needs(item) else []

    def parameter(self, one: Variable) -> str:
        if one.type == "sampler2D":
            return f"const texel_map *{self.named(one.name)}"
        return f"{self.kind(one.type)} {'*' if one.way in ('out', 'inout') else ''}{self.named(one.name)}"

    # the top

    def variable(self, one: Variable) -> list[str]:
        if one.way != "const":
            return []
        if width(one.type) == 1:
            return [f"#define {one.name} ({self.expr(one.value)})" if one.value else ""]
        return [f"static const {one.type} {one.name} = {self.constant(one.value)};"]

    def constant(self, of: Expr | None) -> str:
        """An initialiser that a C compiler takes for a constant."""
        if of is None or of.kind != "new":
            return self.expr(of) if of else "{0}"
        if width(of.type) > 1 and len(of.parts) == 1:
            return "{" + ", ".join([self.constant(of.parts[0])] * width(of.type)) + "}"
        return "{" + ", ".join(map(self.constant, of.parts)) + "}"

    def struct(self, item: Struct) -> list[str]:
        lines = super().struct(item)
        return [f"typedef struct {item.name} {{", *lines[1:-1], f"}} {item.name};"]

    def state(self) -> list[str]:
        """The struct of everything that a sea is at a moment."""
        lines = [f"typedef struct {self.part}_state {{"]
        for one in self.unit.variables():
            if one.way == "const":
                continue
            size = f"[{self.expr(one.size)}]" if one.size else ""
            kind = "texel_map" if one.type == "sampler2D" else one.type.removesuffix("[]")
            lines.append(f"    {kind} {one.name}{size};")
        return [*lines, f"}} {self.part}_state;"]

    def text(self, numbers: str = "") -> str:
        """The whole header but its guard; `numbers`: functions that set the state up."""
        fixed = [one for one in self.unit.variables("const") if width(one.type) == 1]
        constants = [line for one in fixed for line in self.variable(one)]
        self.unit = Unit([item for item in self.unit.items if item not in fixed])
        body = super().text()
        head = ["#include <math.h>", "#include <stdbool.h>", "#include <stddef.h>", ""]
        head.append(TYPES.replace("VECTORS", self.parts.types()))
        names = self.own_names(numbers)
        made = "\n".join([*constants, "", *self.state(), "", *self.parts.made.values(), "", body, numbers])
        ends = [f"#undef {name}" for name in [*(one.name for one in fixed), *names, "SHOREWRIGHT_PREFIX"]]
        text = "\n".join([*head, NAMES, *names.values(), "", made, *ends]) + "\n"
        return re.sub(r"\buint\b", "unsigned", text)

    def own_names(self, numbers: str) -> dict[str, str]:
        """The macro that puts the prefix before each name; helpers, which parts share, have the part's name too."""
        plain = [self.function_name(one) for one in self.unit.functions()] + list(self.unit.structs())
        plain += [one.name for one in self.unit.variables("const")] + [f"{self.part}_state"]
        plain += re.findall(r"^static inline \w+ (\w+)\(", numbers, re.MULTILINE)
        told = dict.fromkeys(plain, "") | dict.fromkeys(self.parts.made, f"{self.part}_part_")
        fields = {one.name for item in self.unit.structs().values() for one in item.members}
        if both := sorted(fields & told.keys()):
            raise BadInput(f"the runtime kit's C has {both[0]!r} both for a member and for a function")
        return {name: f"#define {name} SHOREWRIGHT_JOIN(SHOREWRIGHT_PREFIX, {own}{name})" for name, own in told.items()}


def _names(body: list[Statement], name: str) -> bool:
    from .reach import expressions

    return any(part.kind == "name" and part.text == name for part in expressions(body))
