"""What the writers of all languages share: statements, operators, brackets, indents."""

from __future__ import annotations

from .meaning import parts_of
from .parse import LEVELS, swizzle
from .tree import Expr, Function, Statement, Struct, Unit, Variable, width

BINDS = {sign: level for level, signs in enumerate(LEVELS) for sign in signs}
TIGHT = len(LEVELS)


class Writer:
    """A unit in one language; the languages override what is theirs.

    `taken` are words that a name must not be there; `overloads`: whether two functions may share a name.
    """

    taken: frozenset[str] = frozenset()
    overloads = True

    def __init__(self, unit: Unit) -> None:
        self.unit = unit
        self.globals = {one.name: one for one in unit.variables()}
        self.owned = {function.key: function for function in unit.functions()}
        self.local: set[str] = set()
        names = [function.name for function in unit.functions()]
        self.shared = {name for name in names if names.count(name) > 1}

    # names

    def named(self, name: str) -> str:
        return f"{name}_" if name in self.taken else name

    def kind(self, name: str) -> str:
        return name

    def function_name(self, function: Function) -> str:
        if self.overloads or function.name not in self.shared:
            return self.named(function.name)
        same = [one for one in self.unit.functions() if one.name == function.name]
        counts = [len(one.parameters) for one in same]
        kinds = function.parameters[0].type if len(set(counts)) < len(counts) else str(len(function.parameters))
        return f"{function.name}_{kinds}"

    def name(self, of: Expr) -> str:
        return self.named(of.text)

    # expressions

    def expr(self, of: Expr, binds: int = 0) -> str:
        """The text of an expression, in brackets where it binds less than `binds`."""
        text, own = getattr(self, f"x_{of.kind}")(of)
        return f"({text})" if own < binds else text

    def x_num(self, of: Expr) -> tuple[str, int]:
        return of.text, TIGHT + 2

    def x_name(self, of: Expr) -> tuple[str, int]:
        return self.name(of), TIGHT + 2

    def x_call(self, of: Expr) -> tuple[str, int]:
        own = self.owned.get(of.text)
        if own:
            return f"{self.function_name(own)}({', '.join(self.arguments(own, of))})", TIGHT + 2
        return f"{of.text}({', '.join(map(self.expr, of.parts))})", TIGHT + 2

    def arguments(self, own: Function, of: Expr) -> list[str]:
        return [self.expr(part, -2) for part in of.parts]

    def x_new(self, of: Expr) -> tuple[str, int]:
        return f"{of.text}({', '.join(map(self.expr, of.parts))})", TIGHT + 2

    def x_index(self, of: Expr) -> tuple[str, int]:
        return f"{self.expr(of.parts[0], TIGHT + 1)}[{self.expr(of.parts[1])}]", TIGHT + 2

    def x_field(self, of: Expr) -> tuple[str, int]:
        name = parts_of(of.text) if width(of.parts[0].type) > 1 else self.named(of.text)
        return f"{self.expr(of.parts[0], TIGHT + 1)}.{name}", TIGHT + 2

    def x_unary(self, of: Expr) -> tuple[str, int]:
        return of.text + self.expr(of.parts[0], TIGHT + 1), TIGHT

    def x_post(self, of: Expr) -> tuple[str, int]:
        return self.expr(of.parts[0], TIGHT) + of.text, TIGHT

    def x_binary(self, of: Expr) -> tuple[str, int]:
        at = BINDS[of.text]
        # mixed && and ||, and bits among comparisons, are bracketed: compilers warn otherwise
        inner = at if of.text in "+*" else TIGHT if of.text in ("&", "|", "^", "<<", ">>", "&&", "||", "%") else at
        return f"{self.expr(of.parts[0], inner)} {of.text} {self.expr(of.parts[1], max(inner, at + 1))}", at

    def x_choose(self, of: Expr) -> tuple[str, int]:
        asked, one, other = of.parts
        return f"{self.expr(asked, 1)} ? {self.expr(one, 0)} : {self.expr(other, 0)}", -1

    def x_assign(self, of: Expr) -> tuple[str, int]:
        return f"{self.expr(of.parts[0])} {of.text} {self.expr(of.parts[1], -2)}", -2

    # statements

    def body(self, body: list[Statement], depth: int) -> list[str]:
        return [line for statement in body for line in self.statement(statement, depth)]

    def statement(self, of: Statement, depth: int) -> list[str]:
        pad = "    " * depth
        if of.kind == "declare":
            return [f"{pad}{self.declared(one)};" for one in of.variables]
        if of.kind == "do":
            return self.do(of.parts[0], pad)
        if of.kind == "return":
            return [f"{pad}return {self.expr(of.parts[0], -2)};" if of.parts[0] else f"{pad}return;"]
        if of.kind == "block":
            return [f"{pad}{{", *self.body(of.body, depth + 1), f"{pad}}}"]
        if of.kind == "if":
            lines = [f"{pad}if ({self.expr(of.parts[0])}) {{", *self.body(of.body, depth + 1)]
            if of.other:
                lines += [f"{pad}}} else {{", *self.body(of.other, depth + 1)]
            return [*lines, f"{pad}}}"]
        first = "; ".join(line.strip().rstrip(";") for line in self.body(of.other, 0))
        asked, step = (self.expr(part) if part else "" for part in of.parts)
        return [f"{pad}for ({first}; {asked}; {step}) {{", *self.body(of.body, depth + 1), f"{pad}}}"]

    def do(self, of: Expr, pad: str) -> list[str]:
        """An expression for its effect; a chain a = b = c becomes one assignment a line."""
        if of.kind == "assign" and of.text == "=" and of.parts[1].kind == "assign":
            inner = of.parts[1]
            return [*self.do(inner, pad), *self.do(Expr("assign", of.type, "=", [of.parts[0], inner.parts[0]]), pad)]
        return [f"{pad}{self.expr(of, -3)};"]

    def declared(self, one: Variable) -> str:
        size = f"[{self.expr(one.size)}]" if one.size else ""
        value = f" = {self.expr(one.value, -2)}" if one.value else self.unset(one)
        constant = "const " if one.way == "const" else ""
        return f"{constant}{self.kind(one.type.removesuffix('[]'))} {self.named(one.name)}{size}{value}"

    def unset(self, one: Variable) -> str:
        return ""

    # the top

    def text(self) -> str:
        lines: list[str] = []
        for item in self.unit.items:
            made = self.item(item)
            doc = getattr(item, "doc", []) if made else []
            if made and (doc or not isinstance(item, Variable)):
                lines.append("")
            lines += [*doc, *made]
        return "\n".join(lines).strip() + "\n"

    def item(self, item: Struct | Variable | Function) -> list[str]:
        if isinstance(item, Struct):
            return self.struct(item)
        if isinstance(item, Variable):
            return self.variable(item)
        return self.function(item)

    def variable(self, one: Variable) -> list[str]:
        return [f"{self.declared(one)};"]

    def struct(self, item: Struct) -> list[str]:
        return [f"struct {item.name} {{", *(f"    {self.member(one)};" for one in item.members), "};"]

    def member(self, one: Variable) -> str:
        size = f"[{self.expr(one.size)}]" if one.size else ""
        return f"{self.kind(one.type.removesuffix('[]'))} {self.named(one.name)}{size}"

    def function(self, item: Function) -> list[str]:
        takes = ", ".join([*self.extra(item), *map(self.parameter, item.parameters)])
        self.local = {one.name for one in item.parameters}
        return [f"{self.head(item)}({takes}) {{", *self.body(item.body, 1), "}"]

    def head(self, item: Function) -> str:
        return f"{self.kind(item.type)} {self.function_name(item)}"

    def extra(self, item: Function) -> list[str]:
        """Parameters that the language needs beyond those of the text."""
        return []

    def parameter(self, one: Variable) -> str:
        return f"{one.way + ' ' if one.way else ''}{self.kind(one.type)} {self.named(one.name)}"


__all__ = ["TIGHT", "Writer", "swizzle"]
