"""The small functions that C needs for vectors: made one by one as the writer asks for them, by the types they take."""

from __future__ import annotations

from .tree import base, vector, width

SCALAR = {
    "floor": "floorf({0})", "fract": "{0} - floorf({0})", "sin": "sinf({0})", "cos": "cosf({0})", "exp": "expf({0})",
    "sqrt": "sqrtf({0})", "abs": "{0} < 0 ? -{0} : {0}", "min": "{1} < {0} ? {1} : {0}", "max": "{0} < {1} ? {1} : {0}",
    "clamp": "{0} < {1} ? {1} : {2} < {0} ? {2} : {0}", "mix": "{0} * (1.0f - {2}) + {1} * {2}",
    "mod": "{0} - {1} * floorf({0} / {1})", "exp2": "exp2f({0})", "log2": "log2f({0})", "pow": "powf({0}, {1})",
    "step": "{1} < {0} ? 0.0f : 1.0f",
    "add": "{0} + {1}", "sub": "{0} - {1}", "mul": "{0} * {1}", "div": "{0} / {1}", "neg": "-{0}",
    "less": "{0} < {1}", "greater": "{0} > {1}", "greaterEqual": "{0} >= {1}", "lessEqual": "{0} <= {1}",
    "equal": "{0} == {1}",
}  # fmt: skip
LETTERS = "xyzw"


class Parts:
    """Texts of the functions asked for, in the order asked; `of(name, types)` gives the name to call."""

    def __init__(self) -> None:
        self.made: dict[str, str] = {}

    def types(self) -> str:
        """Every vector as a struct."""
        rows = [(vector(s, n), s, n) for s in ("float", "int", "uint", "bool") for n in (2, 3, 4)]
        return "\n".join(f"typedef struct {{ {s} {', '.join(LETTERS[:n])}; }} {kind};" for kind, s, n in rows)

    def of(self, what: str, types: list[str], result: str) -> str:
        """The name of the function `what` by parts over `types`, made when new."""
        short = [types[0]] if len(set(types)) == 1 else types
        name = f"{what}_{'_'.join(short)}"
        if name not in self.made:
            takes = ", ".join(f"{kind} {'abc'[at]}" for at, kind in enumerate(types))
            self.made[name] = f"static inline {result} {name}({takes}) {self._by_part(what, types, result)}"
        return name

    def _by_part(self, what: str, types: list[str], result: str) -> str:
        def term(letter: str) -> str:
            names = [["a", "b", "c"][at] + (f".{letter}" if width(kind) > 1 else "") for at, kind in enumerate(types)]
            return self._scalar(what, names)

        if width(result) == 1:
            return f"{{ return {term('')}; }}"
        return f"{{ return ({result}){{{', '.join(term(letter) for letter in LETTERS[: width(result)])}}}; }}"

    def _scalar(self, what: str, names: list[str]) -> str:
        if what == "smoothstep":
            self.whole("smooth_part", "float", "float low, float high, float x",
                       "float t = (x - low) / (high - low); t = t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t; "
                       "return t * t * (3.0f - 2.0f * t);")  # fmt: skip
            return f"smooth_part({', '.join(names)})"
        return SCALAR[what].format(*names)

    def whole(self, name: str, result: str, takes: str, text: str) -> str:
        """A function with a text of its own."""
        if name not in self.made:
            self.made[name] = f"static inline {result} {name}({takes}) {{ {text} }}"
        return name

    def reduced(self, what: str, kind: str) -> str:
        """dot, length, normalize, cross, any, all, same (==) of vectors."""
        letters = LETTERS[: width(kind)]
        name = f"{what}_{kind}"
        if what == "dot":
            return self.whole(
                name, "float", f"{kind} a, {kind} b", f"return {' + '.join(f'a.{c} * b.{c}' for c in letters)};"
            )
        if what == "distance":
            size, apart = self.reduced("length", kind), self.of("sub", [kind, kind], kind)
            return self.whole(name, "float", f"{kind} a, {kind} b", f"return {size}({apart}(a, b));")
        if what == "length":
            return self.whole(
                name, "float", f"{kind} a", f"return sqrtf({' + '.join(f'a.{c} * a.{c}' for c in letters)});"
            )
        if what == "normalize":
            size = self.reduced("length", kind)
            over = self.of("div", [kind, "float"], kind)
            return self.whole(name, kind, f"{kind} a", f"return {over}(a, {size}(a));")
        if what == "cross":
            return self.whole(
                name,
                "vec3",
                "vec3 a, vec3 b",
                "return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};",
            )
        if what == "same":
            return self.whole(
                name, "bool", f"{kind} a, {kind} b", f"return {' && '.join(f'a.{c} == b.{c}' for c in letters)};"
            )
        return self.whole(
            name,
            "bool",
            f"{kind} a",
            f"return {(' || ' if what == 'any' else ' && ').join(f'a.{c}' for c in letters)};",
        )

    def swizzled(self, kind: str, letters: str) -> str:
        """`v.yz` as a function."""
        result = vector(base(kind), len(letters))
        return self.whole(
            f"{kind}_{letters}", result, f"{kind} a", f"return ({result}){{{', '.join(f'a.{c}' for c in letters)}}};"
        )

    def picked(self, kind: str) -> str:
        """`v[i]` as a function."""
        letters = LETTERS[: width(kind)]
        chain = " : ".join(f"i == {at} ? a.{c}" for at, c in enumerate(letters[:-1])) + f" : a.{letters[-1]}"
        return self.whole(f"{kind}_at", base(kind), f"{kind} a, int i", f"return {chain};")

    def built(self, kind: str, types: list[str]) -> str:
        """A vector's constructor."""
        count, scalar = width(kind), base(kind)
        name = f"{kind}_of_{'_'.join(types)}"
        takes = ", ".join(f"{given} {'abcd'[at]}" for at, given in enumerate(types))
        if len(types) == 1 and width(types[0]) == 1:
            terms = ["a"] * count
        else:
            terms = [f"{'abcd'[at]}.{c}" if width(given) > 1 else "abcd"[at]
                     for at, given in enumerate(types) for c in LETTERS[: width(given)]][:count]  # fmt: skip
        return self.whole(name, kind, takes, f"return ({kind}){{{', '.join(f'({scalar}){t}' for t in terms)}}};")
