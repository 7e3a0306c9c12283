"""What words stand for where: scopes, types of operators, of GLSL's own functions and of fields."""

from __future__ import annotations

from ....level import BadInput
from .lex import Word
from .tree import Function, Struct, Variable, base, vector, width

BY_PART = {
    "floor", "fract", "abs", "sin", "cos", "exp", "exp2", "log2", "pow", "sqrt", "min", "max", "clamp", "mix", "mod",
    "step", "smoothstep",
}  # fmt: skip
COMPARE = {"lessThan": "<", "lessThanEqual": "<=", "greaterThan": ">", "greaterThanEqual": ">=", "equal": "=="}
PARTS = {"r": "x", "g": "y", "b": "z", "a": "w"}


class Scope:
    """Names in reach, the innermost last."""

    def __init__(self) -> None:
        self.names: list[dict[str, str]] = [{}]
        self.structs: dict[str, Struct] = {}
        self.functions: dict[str, list[Function]] = {}

    def push(self) -> None:
        self.names.append({})

    def pop(self) -> None:
        self.names.pop()

    def declare(self, one: Variable) -> None:
        self.names[-1][one.name] = one.type

    def type_of(self, word: Word) -> str:
        for names in reversed(self.names):
            if word.text in names:
                return names[word.text]
        raise BadInput(f"line {word.line} of the shader: nothing is called {word.text!r}")

    def function(self, name: str, types: list[str]) -> Function | None:
        """The function of that name for those arguments, or the one that takes as many."""
        found = [f for f in self.functions.get(name, []) if len(f.parameters) == len(types)]
        exact = [f for f in found if [p.type for p in f.parameters] == types]
        return (exact or found or [None])[0]


def binary_type(sign: str, a: str, b: str) -> str:
    """The type of `a sign b`."""
    if sign in ("==", "!=", "<", ">", "<=", ">=", "&&", "||"):
        return "bool"
    if sign in ("<<", ">>"):
        return a
    scalar = "float" if "float" in (base(a), base(b)) else "uint" if "uint" in (base(a), base(b)) else "int"
    return vector(scalar, max(width(a), width(b)))


def call_type(word: Word, types: list[str]) -> str:
    """The type of one of GLSL's own functions."""
    name = word.text
    if name in BY_PART:
        scalar = "float" if any(base(t) == "float" for t in types) else base(types[0])
        return vector(scalar, max(map(width, types)))
    if name in COMPARE:
        return vector("bool", width(types[0]))
    known = {"texelFetch": "vec4", "textureSize": "ivec2", "any": "bool", "all": "bool", "findLSB": "int"}
    known |= {"length": "float", "dot": "float", "distance": "float", "normalize": types[0], "cross": "vec3"}
    if name not in known:
        raise BadInput(f"line {word.line} of the shader: the runtime kit has no function {name!r}")
    return known[name]


def parts_of(name: str) -> str:
    """A field of a vector by x, y, z and w."""
    return "".join(PARTS.get(letter, letter) for letter in name)


def field_type(scope: Scope, kind: str, name: Word) -> str:
    """The type of a struct's member or of some parts of a vector."""
    if kind in scope.structs:
        for member in scope.structs[kind].members:
            if member.name == name.text:
                return member.type
        raise BadInput(f"line {name.line} of the shader: {kind} has no {name.text!r}")
    return vector(base(kind), len(name.text))
