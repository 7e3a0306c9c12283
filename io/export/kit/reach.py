"""Which functions a kit needs, and which globals each of them touches."""

from __future__ import annotations

from collections.abc import Iterator

from .tree import Expr, Function, Statement, Struct, Unit, Variable


def expressions(body: list[Statement]) -> Iterator[Expr]:
    """Every expression in some statements, those inside others too."""
    for statement in body:
        for part in statement.parts:
            yield from _inside(part)
        for one in statement.variables:
            yield from _inside(one.size)
            yield from _inside(one.value)
        yield from expressions(statement.body)
        yield from expressions(statement.other)


def _inside(part: Expr | None) -> Iterator[Expr]:
    if part is None:
        return
    yield part
    for inner in part.parts:
        yield from _inside(inner)


def pruned(unit: Unit, wanted: tuple[str, ...]) -> Unit:
    """A unit with what the `wanted` functions need and no more; `uses` of each function is filled in."""
    walk = _Walk(unit)
    for function in unit.functions():
        if function.name in wanted:
            walk.visit(function)
    structs, before = unit.structs(), -1
    while before != len(walk.names):
        before = len(walk.names)
        for name in list(walk.names):
            if name in walk.variables:
                walk.note(walk.variables[name])
            for member in structs[name].members if name in structs else ():
                walk.note(member)
    return Unit([item for item in unit.items if _stays(item, walk.kept, walk.names)])


class _Walk:
    """`kept`: keys of functions that were come to; `names` of types, globals and struct members that they need."""

    def __init__(self, unit: Unit) -> None:
        self.by_key = {function.key: function for function in unit.functions()}
        self.order = {one.name: at for at, one in enumerate(unit.variables())}
        self.variables = {one.name: one for one in unit.variables()}
        self.kept: set[str] = set()
        self.names: set[str] = set()

    def note(self, one: Variable) -> None:
        self.names.add(one.type.removesuffix("[]"))
        for part in (*_inside(one.size), *_inside(one.value)):
            self.names.add(part.text)

    def visit(self, function: Function) -> None:
        """Come to a function and to all that it calls."""
        if function.key in self.kept:
            return
        self.kept.add(function.key)
        local = {p.name for p in function.parameters} | {v.name for v in _declared(function.body)}
        used: set[str] = set()
        self.names.update([function.type, *(p.type for p in function.parameters)])
        self.names.update(v.type.removesuffix("[]") for v in _declared(function.body))
        for part in expressions(function.body):
            if part.kind == "name" and part.text in self.variables and part.text not in local:
                used.add(part.text)
            if part.kind == "call" and part.text in self.by_key:
                self.visit(self.by_key[part.text])
                used.update(self.by_key[part.text].uses)
            if part.kind == "new":
                self.names.add(part.text)
        self.names.update(used)
        function.uses = sorted(used, key=self.order.__getitem__)


def _stays(item: Struct | Variable | Function, kept: set[str], names: set[str]) -> bool:
    return item.key in kept if isinstance(item, Function) else item.name in names


def _declared(body: list[Statement]) -> Iterator[Variable]:
    for statement in body:
        yield from statement.variables
        yield from _declared(statement.body)
        yield from _declared(statement.other)


def changed(unit: Unit) -> set[str]:
    """Globals without a way (neither uniform nor const) that some function writes."""
    free = {one.name for one in unit.variables("")}
    found: set[str] = set()
    for function in unit.functions():
        for part in expressions(function.body):
            if part.kind == "assign":
                of = part.parts[0]
                while of.kind in ("field", "index"):
                    of = of.parts[0]
                if of.kind == "name" and of.text in free:
                    found.add(of.text)
    return found
