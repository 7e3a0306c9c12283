"""GLSL's operators and functions on arrays of points, as C has them: whole numbers are cut, not rounded down."""

from __future__ import annotations

import numpy as np


def _smoothstep(low, high, x):
    t = np.clip((x - low) / (high - low), np.float32(0), np.float32(1))
    return t * t * (np.float32(3) - np.float32(2) * t)


def _length(a):
    return np.sqrt((a * a).sum(-1, dtype=np.float32))


def _first_bit(a):
    low = a & (~a + np.uint32(1))
    return np.where(a == 0, -1, np.round(np.log2(np.maximum(low, 1).astype(np.float64)))).astype(np.int32)


BUILT_IN = {
    "floor": np.floor, "fract": lambda a: a - np.floor(a), "abs": np.abs, "sin": np.sin, "cos": np.cos, "exp": np.exp,
    "exp2": np.exp2, "log2": np.log2, "sqrt": np.sqrt, "pow": np.power, "min": np.minimum, "max": np.maximum,
    "clamp": lambda a, low, high: np.minimum(np.maximum(a, low), high),
    "mix": lambda a, b, t: a * (np.float32(1) - t) + b * t, "mod": lambda a, b: a - b * np.floor(a / b),
    "step": lambda edge, a: (a >= edge).astype(np.float32), "smoothstep": _smoothstep,
    "dot": lambda a, b: (a * b).sum(-1, dtype=np.float32), "length": _length,
    "distance": lambda a, b: _length(a - b), "normalize": lambda a: a / _length(a)[..., None], "cross": np.cross,
    "any": lambda a: a.any(-1), "all": lambda a: a.all(-1), "findLSB": _first_bit,
}  # fmt: skip
PLAIN = ("dot", "length", "distance", "normalize", "cross", "any", "all")  # take whole vectors
SIGNS = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "<": np.less, "<=": np.less_equal, ">": np.greater,
    ">=": np.greater_equal, "&&": np.logical_and, "||": np.logical_or, "&": np.bitwise_and, "|": np.bitwise_or,
    "^": np.bitwise_xor, "<<": np.left_shift, ">>": np.right_shift,
}  # fmt: skip


def binary(sign: str, a, b, vectors: bool):
    """`a sign b`; of two vectors == and != give one answer."""
    a, b = np.asarray(a), np.asarray(b)
    if sign in ("==", "!="):
        same = (a == b).all(-1) if vectors else a == b
        return same if sign == "==" else ~same
    kind = np.float32 if np.float32 in (a.dtype, b.dtype) else a.dtype if sign in ("<<", ">>") else np.result_type(a, b)
    if a.dtype != np.bool_:
        a, b = a.astype(kind), b.astype(kind)
    whole = kind != np.float32
    if sign == "/":
        return np.trunc(a / np.where(b == 0, 1, b)).astype(kind) if whole else a / b
    if sign == "%":
        return np.fmod(a, np.where(b == 0, 1, b)).astype(kind)
    return SIGNS[sign](a, b)


def fetched(texels: np.ndarray, at: np.ndarray) -> np.ndarray:
    """texelFetch: (n, 4) of a map (rows, cols, channels) at (n, 2) columns and rows."""
    rows, cols, channels = texels.shape
    own = texels[np.clip(at[:, 1], 0, rows - 1), np.clip(at[:, 0], 0, cols - 1)]
    found = np.zeros((len(at), 4), np.float32)
    found[:, 3] = 1.0
    found[:, :channels] = own / np.float32(255) if own.dtype == np.uint8 else own
    return found
