"""`sea_at_time` and `sky_at_time` in C and HLSL: phases, tide, and the tracks of what weather keys change."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .data import CYCLES, KitData
from .phases import FORMS, Phase
from .tree import Unit, width

C_TIME = """
static inline double PART_fract(double start, double rate, double t) {
    double cycles = start + rate * t;
    return cycles - floor(cycles);
}

static inline double PART_whole(double start, double rate, double t, double turns) {
    double whole = floor(start + rate * t);
    return turns > 0.0 ? whole - floor(whole / turns) * turns : whole;
}
"""


@dataclass(frozen=True)
class Tongue:
    """How one language says what the formulas of FORMS need; `fract` and `whole` of start, rate_hz (and turns)."""

    state: str  # before a uniform's name
    real: str
    time: str  # the type that t is kept in
    now: str  # t in seconds as one number
    fract: Callable[[float, float], str]
    whole: Callable[[float, float, int], str]
    fold: str
    absolute: str
    fixed: str  # a constant table
    cast: str


def _cycles(start: float, rate_hz: float) -> str:
    """Cycles in HLSL: of a block the whole ones, then the rest in a part that floats multiply without rounding."""
    block = rate_hz * BLOCK_S
    whole = math.floor(block)
    high = math.floor((block - whole) * STEPS) / STEPS
    return f"PART_cycles({start:.9g}, {whole:.1f}, {high!r}, {block - whole - high:.9g}, {rate_hz:.9g}, t)"


BLOCK_S = 64
STEPS = 1024  # a block's number has 14 bits then: twelve days
C = Tongue(
    "g->", "double", "double", "t", lambda start, rate: f"PART_fract({start!r}, {rate!r}, t)",
    lambda start, rate, turns: f"PART_whole({start!r}, {rate!r}, t, {turns}.0)",
    "PART_fract({first!r}, {hop!r}, {of})", "fabs", "static const", "(float)({0})",
)  # fmt: skip
HLSL = Tongue(
    "", "float", "float2", "now", lambda start, rate: _cycles(start, rate) + ".y",
    lambda start, rate, turns: f"PART_wrapped({_cycles(start, rate)}.x, {turns}.0)",
    "frac({first:.9g} + {hop:.9g} * {of})", "abs", "static const", "{0}",
)  # fmt: skip
HLSL_CYCLES = """
float PART_wrapped(float whole, float turns) { return turns > 0.0 ? whole - floor(whole / turns) * turns : whole; }

// Whole cycles and the rest of one at a time; `high` has so few bits that it times a block's number is exact.
float2 PART_cycles(float start, float whole, float high, float low, float rate, float2 t) {
    float turned = high * t.x;
    float rest = frac(turned) + low * t.x + start + rate * t.y;
    return float2(whole * t.x + floor(turned) + floor(rest), frac(rest));
}
"""
HLSL_DOC = """
// The PART at t.x blocks of 64 s and t.y seconds more, for twelve days: floor(s / 64) and s - 64 floor(s / 64), which
// whoever keeps the clock works out in double (of a level with a loop from the time within it)."""
HLSL_SHORT_DOC = (
    "\n// The same of seconds, for as long as a float holds them finely enough: a quarter of an hour or so."
)
C_DOC = "\n// The PART at a time in seconds since its beginning; wrapped in double, so that it holds for weeks."


def c_time(unit: Unit, data: KitData, part: str) -> str:
    """`PART_at_time(state, t)` in C."""
    head = [C_TIME, *_tide(data, C), *_track(unit, data, C, f"{part}_state *g, "), C_DOC]
    lines = [f"static inline void {part}_at_time({part}_state *g, double t) {{", *_body(data, C, "g, ")]
    return "\n".join([*head, *lines, "}"]).replace("PART", part) + "\n"


def hlsl_time(unit: Unit, data: KitData, part: str) -> str:
    """`PART_at_time(t)` in HLSL, of two floats and of one."""
    head = [HLSL_CYCLES, *_tide(data, HLSL), *_track(unit, data, HLSL, ""), HLSL_DOC]
    lines = [f"void {part}_at_time(float2 t) {{", *_body(data, HLSL, ""), "}", HLSL_SHORT_DOC]
    lines += [f"void {part}_at_time(float t) {{", *_loop(data), f"    float block = floor(t / {BLOCK_S}.0);"]
    lines.append(f"    {part}_at_time(float2(block, t - {BLOCK_S}.0 * block));")
    return "\n".join([*head, *lines, "}"]).replace("PART", part) + "\n"


def _loop(data: KitData) -> list[str]:
    return [f"    t -= floor(t / {data.loop_s!r}) * {data.loop_s!r};"] if data.loop_s > 0 else []


def _body(data: KitData, tongue: Tongue, given: str) -> list[str]:
    lines = _loop(data) if tongue is C else [f"    float now = {BLOCK_S}.0 * t.x + t.y;"]
    if data.track.values:
        lines.append(f"    PART_follow({given}{tongue.now});")
    if data.clock_hz:
        fract, whole = tongue.fract(0.0, data.clock_hz), tongue.whole(0.0, data.clock_hz, CYCLES)
        lines.append(f"    {tongue.state}u_shore_clock = {tongue.cast.format(fract)};")
        lines.append(f"    {tongue.state}u_shore_cycle = (int){whole};")
    lines += [_phase(phase, tongue) for phase in sorted(data.phases, key=lambda phase: phase.from_s)]
    if data.tide:
        for name, base in data.tide.base.items():
            lines.append(f"    {tongue.state}{name} = {tongue.cast.format(f'{base!r} + PART_tide(t)')};")
    return lines or ["    (void)g; (void)t;"]


def _phase(phase: Phase, tongue: Tongue) -> str:
    row = f"[{phase.row}]" if phase.row >= 0 else ""
    fract = tongue.fract(phase.start, phase.rate_hz)
    whole = tongue.whole(phase.start, phase.rate_hz, phase.turns)
    hop, fold = (tongue.fold.format(first=phase.first, hop=phase.hop, of=of) for of in (whole, fract))
    text = FORMS[phase.form].text.format(fract=fract, whole=whole, hop=hop, fold=fold, abs=tongue.absolute)
    if phase.scale != 1.0:
        text = f"{phase.scale!r} * {text}"
    if phase.offset:
        text = f"{phase.offset!r} + {text}"
    when = f"if ({tongue.now} >= {phase.from_s!r}) " if phase.from_s > 0 else ""
    return f"    {when}{tongue.state}{phase.uniform}{row}.{'xyzw'[phase.part]} = {tongue.cast.format(text)};"


def _tide(data: KitData, tongue: Tongue) -> list[str]:
    if not data.tide:
        return []
    tide, real = data.tide, tongue.real
    at, height = list(tide.curve[::2]), list(tide.curve[1::2])
    at, height = [at[-1] - 1.0, *at, at[0] + 1.0], [height[-1], *height, height[0]]
    part_of = tongue.fract(-tide.high_s / tide.period_s, 1 / tide.period_s)
    inline = "static inline " if tongue is C else ""
    return [
        "", "// The tide over the mean level, m: half a cosine from each point of its curve to the next.",
        f"{inline}{real} PART_tide({tongue.time} t) {{",
        f"    {tongue.fixed} {real} at[{len(at)}] = {{{', '.join(map(repr, at))}}};",
        f"    {tongue.fixed} {real} height[{len(at)}] = {{{', '.join(map(repr, height))}}};",
        f"    {real} part = {part_of};",
        "    int n = 0;",
        f"    while (n < {len(at) - 2} && part >= at[n + 1]) ++n;",
        f"    {real} along = (part - at[n]) / (at[n + 1] - at[n]);",
        f"    {real} h = height[n] + (height[n + 1] - height[n]) * 0.5 * (1.0 - cos(3.141592653589793 * along));",
        f"    return {tide.range_m!r} * (h - 0.5);", "}",
    ]  # fmt: skip


def _track(unit: Unit, data: KitData, tongue: Tongue, given: str) -> list[str]:
    """`PART_follow(t)`: what keys change, straight lines between knots."""
    if not data.track.values:
        return []
    times, real = data.track.times_s, tongue.real
    inline = "static inline " if tongue is C else ""
    kinds = {one.name: one.type.removesuffix("[]") for one in unit.variables("uniform")}
    lines = ["", "// What weather keys and storms change, straight lines between knots.",
             f"{inline}void PART_follow({given}{real} t) {{",
             f"    {tongue.fixed} {real} at[{len(times)}] = {{{', '.join(f'{t:.10g}' for t in times)}}};",
             f"    int n = 0, last = {len(times) - 2};",
             "    while (n < last && t >= at[n + 1]) ++n;",
             f"    float part = {tongue.cast.format('(t - at[n]) / (at[n + 1] - at[n])')};",
             "    part = part < 0 ? 0 : part > 1 ? 1 : part;"]  # fmt: skip
    for name, values in data.track.values.items():
        parts = width(kinds[name])
        table = values.reshape(len(times), -1, values.shape[-1] if values.ndim > 1 else 1)[..., :parts]
        for row in range(table.shape[1]):
            for n in range(table.shape[2]):
                lines += _line(name, table[:, row, n], row if values.ndim > 2 else -1, n if parts > 1 else -1, tongue)
    return [*lines, "}"]


def _line(name: str, values: np.ndarray, row: int, part: int, tongue: Tongue) -> list[str]:
    if np.ptp(values) == 0:
        return []
    suffix = "f" if tongue is C else ""
    label = f"{name}_{max(row, 0)}_{max(part, 0)}"
    numbers = ", ".join(f"{v:.9g}" + ("" if any(c in f"{v:.9g}" for c in ".en") else ".0") + suffix for v in values)
    place = (f"[{row}]" if row >= 0 else "") + (f".{'xyzw'[part]}" if part >= 0 else "")
    return [
        f"    {tongue.fixed} float {label}[{len(values)}] = {{{numbers}}};",
        f"    {tongue.state}{name}{place} = {label}[n] + ({label}[n + 1] - {label}[n]) * part;",
    ]
