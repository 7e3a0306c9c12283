"""What a parsed shader is made of: every expression knows its type, a word of GLSL or the name of a struct.

An array's type ends in `[]`; its size is an expression of the declaration.
"""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Expr:
    """`kind` is num, name, call, new, index, field, unary, post, binary, choose or assign; `text` its word."""

    kind: str
    type: str
    text: str = ""
    parts: list[Expr] = field(default_factory=list)


@dataclass
class Variable:
    """A variable, parameter or member; `way` is in, out or inout, uniform, const or nothing."""

    type: str
    name: str
    size: Expr | None = None
    value: Expr | None = None
    way: str = ""
    doc: list[str] = field(default_factory=list)


@dataclass
class Statement:
    """`kind` is declare, do, if, for, return, block; `body` statements, `parts` expressions (None where left out)."""

    kind: str
    parts: list[Expr | None] = field(default_factory=list)
    body: list[Statement] = field(default_factory=list)
    other: list[Statement] = field(default_factory=list)
    variables: list[Variable] = field(default_factory=list)


@dataclass
class Struct:
    name: str
    members: list[Variable]
    doc: list[str] = field(default_factory=list)


@dataclass
class Function:
    """`uses`: the globals that it or a function called by it reads or writes, in the order of their declaration."""

    name: str
    type: str
    parameters: list[Variable]
    body: list[Statement]
    doc: list[str] = field(default_factory=list)
    uses: list[str] = field(default_factory=list)

    @property
    def key(self) -> str:
        """Its name and what it takes: two functions may share a name."""
        return f"{self.name}({','.join(p.type for p in self.parameters)})"


@dataclass
class Unit:
    """A whole shader, `items` in the order of the text."""

    items: list[Struct | Variable | Function]

    def functions(self) -> list[Function]:
        return [item for item in self.items if isinstance(item, Function)]

    def variables(self, way: str | None = None) -> list[Variable]:
        found = [item for item in self.items if isinstance(item, Variable)]
        return [item for item in found if way is None or item.way == way]

    def structs(self) -> dict[str, Struct]:
        return {item.name: item for item in self.items if isinstance(item, Struct)}


def width(kind: str) -> int:
    """Components of a vector's type, 1 for a scalar, 0 for anything else."""
    if kind in ("float", "int", "uint", "bool"):
        return 1
    return int(kind[-1]) if kind.rstrip("234") in ("vec", "ivec", "uvec", "bvec") and kind[-1] in "234" else 0


def base(kind: str) -> str:
    """The scalar that a vector is made of."""
    return {"v": "float", "i": "int", "u": "uint", "b": "bool"}[kind[0]] if width(kind) > 1 else kind


def vector(scalar: str, count: int) -> str:
    """The vector of so many scalars."""
    if count == 1:
        return scalar
    return {"float": "vec", "int": "ivec", "uint": "uvec", "bool": "bvec"}[scalar] + str(count)
