"""How samples become whole numbers and back: one row a code, for every map of MAPS, exporter and check alike.

Quantise once, with `round()`. A signed code has a value that is exactly zero, so that nothing drifts or tints where
nothing is: 0.5 of 65535 steps would be none (research, authoring 4).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Code:
    """`encode(values, low, high, top)` float → whole numbers as float, `decode` its opposite; `top` 255 or 65535.

    `low` and `high` are arrays, one number a channel; `step` is what one whole number more stands for, by channel.
    `formula` says the same in a sentence for a shader's author; v is the whole number, a sampler gives v / top.
    """

    name: str
    formula: str
    encode: Callable[[np.ndarray, np.ndarray, np.ndarray, int], np.ndarray]
    decode: Callable[[np.ndarray, np.ndarray, np.ndarray, int], np.ndarray]
    step: Callable[[np.ndarray, np.ndarray, int], np.ndarray]


def _signed(values: np.ndarray, low: np.ndarray, high: np.ndarray, top: int) -> np.ndarray:
    middle = (top + 1) // 2
    return middle + np.rint(values / high * (middle - 1))


CODES: dict[str, Code] = {
    row.name: row
    for row in (
        Code(
            "unsigned",
            "value = low + v / top * (high - low), low and high by channel",
            lambda x, low, high, top: np.rint((x - low) / (high - low) * top),
            lambda v, low, high, top: low + v / top * (high - low),
            lambda low, high, top: (high - low) / top,
        ),
        Code(
            "signed",
            "value = (v - (top + 1) / 2) / ((top - 1) / 2) * high, high by channel; exactly 0 in the middle",
            _signed,
            lambda v, low, high, top: (v - (top + 1) // 2) / ((top + 1) // 2 - 1) * high,
            lambda low, high, top: high / ((top + 1) // 2 - 1),
        ),
        Code(
            "float",
            "value = v, float32",
            lambda x, low, high, top: x,
            lambda v, low, high, top: v,
            lambda low, high, top: 0.0 * high,
        ),
    )
}


def encoded(values: np.ndarray, code: str, low, high, bits: int) -> np.ndarray:
    """`values` as uint8, uint16 or float32 (`bits` 32); what is out of the range is held at its end."""
    if code == "float":
        return np.asarray(values, np.float32)
    top = 2**bits - 1
    whole = CODES[code].encode(np.asarray(values, np.float64), np.asarray(low), np.asarray(high), top)
    return np.clip(whole, 1 if code == "signed" else 0, top).astype(np.uint8 if bits == 8 else np.uint16)


def decoded(samples: np.ndarray, code: str, low, high, bits: int) -> np.ndarray:
    """What samples stand for, float64."""
    return CODES[code].decode(np.asarray(samples, np.float64), np.asarray(low), np.asarray(high), 2**bits - 1)
