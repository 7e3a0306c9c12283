"""The kit's own functions run in float32 by NumPy, over many points at once: what a game's machine will make of them.

    run = Run(unit, uniforms, maps, count)
    sea = run.call("sea_surface", points)      # points float32 (count, 2); structs come back as dicts

Values have the points first: scalars (count,), vectors (count, parts), arrays (count, size, …). Where points part ways
(if, for, return) both ways are walked, each for those that take it.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ....level import BadInput
from .meaning import COMPARE, parts_of
from .run_math import BUILT_IN, PLAIN, binary, fetched
from .tree import Expr, Function, Statement, Unit, Variable, base, width

KINDS = {"float": np.float32, "int": np.int32, "uint": np.uint32, "bool": np.bool_}
ENDLESS = 100_000  # turns of a loop, after which something is wrong


@dataclass
class Frame:
    """Names of a function under way; `live` are the points that have not returned, `value` what the others did."""

    live: np.ndarray
    names: dict[str, object] = field(default_factory=dict)
    value: object = None


class Run:
    def __init__(self, unit: Unit, uniforms: dict, maps: dict[str, np.ndarray], count: int) -> None:
        self.unit, self.maps, self.count = unit, maps, count
        self.functions = {one.key: one for one in unit.functions()}
        self.structs = unit.structs()
        self.every = np.ones(count, bool)
        self.globals: dict[str, object] = {}
        frame = Frame(self.every)
        for one in unit.variables():
            kind = one.type.removesuffix("[]")
            if one.type == "sampler2D":
                continue
            if one.way == "uniform":
                self.globals[one.name] = self.uniform(uniforms[one.name], kind, bool(one.size))
            elif one.value is not None:
                self.globals[one.name] = self.value(one.value, frame, self.every)
            else:
                self.globals[one.name] = self.zero(one, frame)

    def uniform(self, value, kind: str, array: bool) -> np.ndarray:
        """One value for all points; an array's rows keep their own axis."""
        value = np.asarray(value, KINDS[base(kind)])
        parts = width(kind)
        if parts > 1:
            value = value.reshape(-1, value.shape[-1])
            value = np.pad(value, ((0, 0), (0, max(parts - value.shape[1], 0))))[:, :parts]
        else:
            value = value.reshape(-1)
        value = value if array else value[0]
        return np.broadcast_to(value, (self.count, *value.shape))

    def call(self, name: str, *given):
        """A function by its name, from points."""
        function = next(one for one in self.functions.values() if one.name == name)
        with np.errstate(all="ignore"):
            return self.run(function, list(given), self.every)[0]

    def run(self, function: Function, given: list, mask: np.ndarray) -> tuple[object, dict]:
        """What a function returns for the points of a mask, and its names at the end."""
        frame = Frame(mask.copy())
        for one, value in zip(function.parameters, given, strict=True):
            frame.names[one.name] = self.zero(one, frame) if value is None else value
        self.walk(function.body, frame, mask)
        return frame.value, frame.names

    def zero(self, one: Variable, frame: Frame):
        kind = one.type.removesuffix("[]")
        size = int(np.max(self.value(one.size, frame, self.every))) if one.size else 0
        if kind in self.structs:
            return {part.name: self.zero(part, frame) for part in self.structs[kind].members}
        if one.type == "sampler2D":
            return None
        shape = (self.count, *([size] if size else []), *([width(kind)] if width(kind) > 1 else []))
        return np.zeros(shape, KINDS[base(kind)])

    def walk(self, body: list[Statement], frame: Frame, mask: np.ndarray) -> None:
        for statement in body:
            here = mask & frame.live
            if not here.any():
                return
            getattr(self, f"s_{statement.kind}")(statement, frame, here)

    def s_declare(self, of: Statement, frame: Frame, mask: np.ndarray) -> None:
        for one in of.variables:
            frame.names[one.name] = self.value(one.value, frame, mask) if one.value else self.zero(one, frame)

    def s_do(self, of: Statement, frame: Frame, mask: np.ndarray) -> None:
        self.value(of.parts[0], frame, mask)

    def s_block(self, of: Statement, frame: Frame, mask: np.ndarray) -> None:
        self.walk(of.body, frame, mask)

    def s_if(self, of: Statement, frame: Frame, mask: np.ndarray) -> None:
        asked = self.value(of.parts[0], frame, mask)
        self.walk(of.body, frame, mask & asked)
        self.walk(of.other, frame, mask & ~asked)

    def s_for(self, of: Statement, frame: Frame, mask: np.ndarray) -> None:
        self.walk(of.other, frame, mask)
        for _ in range(ENDLESS):
            mask = mask & frame.live
            if of.parts[0] is not None:
                mask = mask & self.value(of.parts[0], frame, mask)
            if not mask.any():
                return
            self.walk(of.body, frame, mask)
            if of.parts[1] is not None:
                self.value(of.parts[1], frame, mask & frame.live)
        raise BadInput("a loop of the runtime kit never ends")

    def s_return(self, of: Statement, frame: Frame, mask: np.ndarray) -> None:
        if of.parts[0] is not None:
            value = self.value(of.parts[0], frame, mask)
            frame.value = value if frame.value is None else self.chosen(mask, value, frame.value)
        frame.live &= ~mask

    def chosen(self, mask: np.ndarray, one, other):
        """One value where the mask is, else the other."""
        if isinstance(one, dict):
            return {name: self.chosen(mask, one[name], other[name]) for name in one}
        one, other = np.asarray(one), np.asarray(other)
        return np.where(mask.reshape(-1, *[1] * (max(one.ndim, other.ndim) - 1)), one, other)

    def value(self, of: Expr, frame: Frame, mask: np.ndarray):
        return getattr(self, f"x_{of.kind}")(of, frame, mask)

    def x_num(self, of: Expr, frame: Frame, mask: np.ndarray):
        return np.full(
            self.count, of.text == "true" if of.type == "bool" else float(of.text.rstrip("u")), KINDS[of.type]
        )

    def x_name(self, of: Expr, frame: Frame, mask: np.ndarray):
        if of.text in frame.names:
            return frame.names[of.text]
        return self.globals[of.text] if of.text in self.globals else self.maps[of.text]

    def x_field(self, of: Expr, frame: Frame, mask: np.ndarray):
        value = self.value(of.parts[0], frame, mask)
        if isinstance(value, dict):
            return value[of.text]
        letters = ["xyzw".index(c) for c in parts_of(of.text)]
        return value[..., letters[0]] if len(letters) == 1 else value[..., letters]

    def x_index(self, of: Expr, frame: Frame, mask: np.ndarray):
        value, at = (self.value(part, frame, mask) for part in of.parts)
        return value[np.arange(self.count), np.clip(at, 0, value.shape[1] - 1)]

    def x_unary(self, of: Expr, frame: Frame, mask: np.ndarray):
        if of.text in ("++", "--"):
            return self.x_post(of, frame, mask)
        value = self.value(of.parts[0], frame, mask)
        return {"-": np.negative, "!": np.logical_not, "~": np.invert, "+": np.positive}[of.text](value)

    def x_post(self, of: Expr, frame: Frame, mask: np.ndarray):
        before = self.value(of.parts[0], frame, mask)
        self.put(of.parts[0], before + before.dtype.type(1 if of.text == "++" else -1), frame, mask)
        return before

    def x_binary(self, of: Expr, frame: Frame, mask: np.ndarray):
        a, b = (self.value(part, frame, mask) for part in of.parts)
        if max(a.ndim, b.ndim) > 1:
            a, b = (v if v.ndim > 1 else v[..., None] for v in (a, b))
        return binary(of.text, a, b, width(of.parts[0].type) > 1)

    def x_choose(self, of: Expr, frame: Frame, mask: np.ndarray):
        asked = self.value(of.parts[0], frame, mask)
        return self.chosen(asked, *(self.value(part, frame, mask) for part in of.parts[1:]))

    def x_assign(self, of: Expr, frame: Frame, mask: np.ndarray):
        left, right = of.parts
        value = self.value(right, frame, mask)
        if of.text != "=":
            whole = Expr("binary", left.type, of.text[:-1], [left, right])
            value = self.x_binary(whole, frame, mask)
        self.put(left, value, frame, mask)
        return value

    def put(self, left: Expr, value, frame: Frame, mask: np.ndarray) -> None:
        """Write to a name, a member, an element or some parts of a vector, where the mask is."""
        if left.kind == "name":
            home = frame.names if left.text in frame.names else self.globals
            old = home[left.text]
            if isinstance(old, np.ndarray):
                value = np.asarray(value).astype(old.dtype)
            home[left.text] = self.chosen(mask, value, old)
            return
        old = self.value(left.parts[0], frame, mask)
        if isinstance(old, dict):
            new = {**old, left.text: self.chosen(mask, value, old[left.text])}
        elif left.kind == "index":
            new, at = old.copy(), np.clip(self.value(left.parts[1], frame, mask), 0, old.shape[1] - 1)
            new[np.flatnonzero(mask), at[mask]] = value[mask]
        else:
            new, letters = old.copy(), ["xyzw".index(c) for c in parts_of(left.text)]
            new[..., letters] = value if len(letters) > 1 else np.asarray(value)[..., None]
        self.put(left.parts[0], new, frame, mask)

    def x_new(self, of: Expr, frame: Frame, mask: np.ndarray):
        given = [self.value(part, frame, mask) for part in of.parts]
        if of.type in self.structs:
            return dict(zip((one.name for one in self.structs[of.type].members), given, strict=True))
        kind, parts = KINDS[base(of.type)], width(of.type)
        if parts == 1:
            return given[0].astype(kind)
        columns = [v[..., None] if v.ndim == 1 else v for v in given]
        whole = np.concatenate([column.astype(kind) for column in columns], -1)
        return np.repeat(whole, parts, -1) if whole.shape[-1] == 1 else whole[..., :parts]

    def x_call(self, of: Expr, frame: Frame, mask: np.ndarray):
        own = self.functions.get(of.text)
        if own is None:
            return self.built_in(of, frame, mask)
        given = [
            None if wanted.way == "out" else self.value(part, frame, mask)
            for part, wanted in zip(of.parts, own.parameters, strict=True)
        ]
        value, names = self.run(own, given, mask)
        for part, wanted in zip(of.parts, own.parameters, strict=True):
            if wanted.way in ("out", "inout"):
                self.put(part, names[wanted.name], frame, mask)
        return value

    def built_in(self, of: Expr, frame: Frame, mask: np.ndarray):
        given = [self.value(part, frame, mask) for part in of.parts]
        if of.text == "textureSize":
            return np.broadcast_to(np.int32(given[0].shape[1::-1]), (self.count, 2))
        if of.text == "texelFetch":
            return fetched(given[0], given[1])
        if of.text in COMPARE:
            return binary(COMPARE[of.text], given[0], given[1], False)
        if max(v.ndim for v in given) > 1 and of.text not in PLAIN:
            given = [v if v.ndim > 1 else v[..., None] for v in given]
        if base(of.type) == "float":
            given = [v.astype(np.float32) for v in given]
        return BUILT_IN[of.text](*given)
