"""What a river and its jet leave of the sea's waves that meet it (D35).

Waves against a current U: energy comes no farther than where cg + U = 0, in deep water U = −g P / (8 π). Till there
they get shorter and higher by wave action: with r = −U / (that speed) and s = √(1 − r), (cg + U) / cg is s, and
amplitudes grow as 2 / ((1 + s) √s) (Longuet-Higgins & Stewart 1961: deep water; the speed that stops them is that of
the depth).
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace

import numpy as np

from .dispersion import GRAVITY
from .gerstner import Fronts, groups
from .level import Level
from .river_flow import RiverFlow, river_flow
from .river_jet import Mouth, smooth
from .river_line import SPREAD, Line
from .river_map import PAINTED, RiverMap, code_of_waves, river_shape
from .weather_keys import base_settings

MOST_GAIN = 1.6  # waves get no higher than so many times what they were
STEEPEST = 0.14  # of waves, height by length, × tanh k h (Miche)
STOPS = (0.92, 1.08)  # of the speed that stops waves: all of them, none get through
WHITE = (0.2, 0.5)  # (cg + U) / cg up to which they are white, at which they aren't
TIDAL = 8.0  # widths up a quiet river over which waves die out on its banks and bed
TURNS_IN = 3.0  # widths before the mouth over which waves from all sides become waves up the river


@functools.lru_cache(1)
def _stopping() -> tuple[np.ndarray, np.ndarray]:
    """ω √(h / g), and the speed by √(g h) that stops waves of it: at the largest ω that k has against a current."""
    kh = np.geomspace(1e-3, 60, 800)
    tanh = np.tanh(kh)
    sigma = np.sqrt(kh * tanh)
    group = (tanh + kh * (1 - tanh * tanh)) / (2 * sigma)
    return sigma - kh * group, group


def stopping_speed(period_s, depth_m) -> np.ndarray:
    """m/s of a current against waves that lets none of that period pass; arrays of one shape."""
    depth = np.maximum(depth_m, 0.05)
    pace = 2 * np.pi / np.asarray(period_s, np.float64) * np.sqrt(depth / GRAVITY)
    known, stops = _stopping()
    return np.where(pace > known[-1], 0.25 / pace, np.interp(pace, known, stops)) * np.sqrt(GRAVITY * depth)


@dataclass
class Met:
    """What a current leaves of waves, arrays of one shape: × amplitude, share that gets through, how white 0 … 1."""

    gain: np.ndarray
    through: np.ndarray
    white: np.ndarray


def met(period_s, depth_m, against_mps, amplitude_m: float = 0.0) -> Met:
    """Waves of a period that meet a current, m/s against them; with it they get lower."""
    r = against_mps / stopping_speed(period_s, depth_m)
    s = np.sqrt(np.maximum(1 - r, 1e-4))
    most = MOST_GAIN
    if amplitude_m > 0:
        length = GRAVITY * np.asarray(period_s) ** 2 / (2 * np.pi) * (0.5 * (1 + s)) ** 2
        steepest = 0.5 * STEEPEST * length * np.tanh(2 * np.pi / length * np.maximum(depth_m, 0.05)) / amplitude_m
        most = np.clip(steepest, 1.0, MOST_GAIN)
    through = 1 - smooth(*STOPS, r)
    white = (1 - smooth(*WHITE, s)) * (1 - smooth(1.0, 1.5, r))
    return Met(np.minimum(2 / ((1 + s) * np.sqrt(s)), most), through, white)


@dataclass
class Shares:
    """Of swell and chop what comes to each place, × amplitude, and how white 0 … 1 they are there."""

    swell: np.ndarray
    chop: np.ndarray
    white: np.ndarray


def _group(fronts: Fronts, depth_m, east, north, up: float = 0.0, speed=None) -> Met:
    """Of a group: the mean over its fronts by amplitude against a current `east`, `north`, the whitest of them.

    `up` 0 … 1: how far all of them run straight against it, `speed` m/s.
    """
    total = Met(*(np.zeros(np.shape(depth_m)) for _ in range(3)))
    weights = fronts.amplitude_m / max(fronts.amplitude_m.sum(), 1e-9) if fronts.amplitude_m.sum() > 0 else \
        np.full(len(fronts.length_m), 1 / len(fronts.length_m))  # fmt: skip
    for i, weight in enumerate(weights):
        period = 2 * np.pi / np.sqrt(GRAVITY * 2 * np.pi / fronts.length_m[i])
        against = -(east * fronts.east[i] + north * fronts.north[i])
        if speed is not None:
            against = against + up * (speed - against)
        one = met(period, depth_m, against, float(fronts.amplitude_m[i]))
        total.gain += weight * one.gain
        total.through += weight * one.through
        total.white = np.maximum(total.white, one.white)
    return total


def shares(level: Level, shape: RiverMap, flow: RiverFlow) -> Shares:
    """What the level's rivers leave of the sea's waves on the map's samples: 1 wherever none of them is felt."""
    out = Shares(*(np.full(shape.owner.shape, value) for value in (1.0, 1.0, 0.0)))
    high, low = groups(base_settings(level).sea, level.settings.level.seed)
    strength = base_settings(level).flow.rivers
    stride = round(shape.cell_m / level.grid.cell_m)
    sea_depth = level.mean_sea_m - level.height[::stride, ::stride]
    for mouth in flow.mouths:
        _jet(out, mouth, strength, sea_depth, shape.cell_m, (high, low))
    for which in range(len(shape.lines)):
        _channel(out, which, shape, flow, strength, (high, low))
    painted = shape.packed[..., 1] * (shape.owner == PAINTED)  # no way leads there
    out.swell, out.chop = out.swell * (1 - painted), out.chop * (1 - painted)
    _by_hand(out, level, stride)
    return out


def _by_hand(out: Shares, level: Level, stride: int) -> None:
    """Painted −1 … 1: less of the waves down to none, or more of them up to those of the open sea."""
    layer = level.layers["mouth"]
    if layer.neutral:
        return
    paint = layer.read(level.grid.rect)[::stride, ::stride]
    less, more = 1 + np.minimum(paint, 0), np.maximum(paint, 0)
    for name in ("swell", "chop"):
        share = getattr(out, name) * less
        setattr(out, name, share + (np.maximum(share, 1) - share) * more)
    out.white = out.white * less * (1 - more)


def _jet(out: Shares, mouth: Mouth, strength: float, sea_depth, cell_m: float, fronts) -> None:
    wide = 4.0 * (mouth.half_m + SPREAD * mouth.reach_m) + 4 * cell_m
    ends = np.array([[mouth.x, mouth.y], [mouth.x + mouth.east * mouth.reach_m, mouth.y + mouth.north * mouth.reach_m]])
    low = np.floor((ends.min(0) - wide) / cell_m).astype(int)
    high = np.ceil((ends.max(0) + wide) / cell_m).astype(int) + 1
    rows, cols = (slice(max(low[i], 0), int(np.clip(high[i], 0, n))) for i, n in ((1, sea_depth.shape[0]),
                                                                                  (0, sea_depth.shape[1])))  # fmt: skip
    y, x = np.mgrid[rows, cols] * cell_m
    if not x.size:
        return
    speed = strength * mouth.speed(x, y, cell_m)
    ahead, _ = mouth.off(x, y)
    up = 1 - smooth(0.0, 2 * TURNS_IN * mouth.half_m, ahead)
    depth = np.maximum(sea_depth[rows, cols], mouth.depth_m)  # waves come in by the deepest way
    felt = speed > 0
    for name, group in zip(("chop", "swell"), fronts, strict=True):
        one = _group(group, depth, speed * mouth.east, speed * mouth.north, up, speed)
        getattr(out, name)[rows, cols] *= np.where(felt, one.gain * one.through, 1.0)
        if name == "chop":
            out.white[rows, cols] = np.maximum(out.white[rows, cols], np.where(felt, one.white, 0))


def _channel(out: Shares, which: int, shape: RiverMap, flow: RiverFlow, strength: float, fronts) -> None:
    """Up the river: waves that were stopped on the way don't come farther up."""
    own = (shape.owner == which) & (shape.packed[..., 1] > 0)
    line = shape.lines[which]
    own[own] = shape.nearest[own] < line.mouth
    if not own.any():
        return
    laid = {name: np.zeros(line.mouth) for name in ("swell", "chop", "white")}
    if line.mouth < len(line.x):
        speed, depth = _along(line, shape, flow)
        up = (line.along_m[line.mouth - 1] - line.along_m[: line.mouth]) / (2 * TIDAL * line.half_m[line.mouth - 1])
        dies = 1 - smooth(0.0, 1.0, up)
        for name, group in zip(("chop", "swell"), fronts, strict=True):
            one = _group(group, depth, 0.0, 0.0, 1.0, speed * strength)
            through = np.minimum.accumulate(one.through[::-1])[::-1]  # from the sea
            laid[name] = one.gain * through * dies
            if name == "chop":
                before = np.concatenate([through[1:], through[-1:]])
                laid["white"] = one.white * before * dies
    index = np.minimum(shape.nearest[own], line.mouth - 1)
    share = shape.packed[..., 1][own]
    for name, values in laid.items():
        whole = getattr(out, name)
        rest = 0.0 if name == "white" else 1.0
        whole[own] = rest + (values[index] - rest) * share


def _along(line: Line, shape: RiverMap, flow: RiverFlow) -> tuple[np.ndarray, np.ndarray]:
    """Speed in m/s and depth in m in the middle of a river, by point up to its mouth, evened over its width."""
    from scipy.ndimage import gaussian_filter1d

    row = np.rint(line.y[: line.mouth] / shape.cell_m).astype(int) - flow.corner[0]
    col = np.rint(line.x[: line.mouth] / shape.cell_m).astype(int) - flow.corner[1]
    inside = (row >= 0) & (row < flow.wet.shape[0]) & (col >= 0) & (col < flow.wet.shape[1])
    row, col = (np.clip(v, 0, n - 1) for v, n in zip((row, col), flow.wet.shape, strict=True))
    speed = np.where(inside, np.hypot(*np.moveaxis(flow.velocity[row, col], -1, 0)), 0)
    depth = np.where(inside, flow.depth_m[row, col], 0)
    step = max(float(np.diff(line.along_m[: line.mouth]).mean()), 1e-3) if line.mouth > 1 else 1.0
    sigma = max(float(line.half_m[line.mouth - 1]) / step, 0.5)
    return (gaussian_filter1d(v.astype(np.float64), sigma, mode="nearest") for v in (speed, np.maximum(depth, 0.1)))


def with_waves(level: Level) -> RiverMap | None:
    """The map of the level's rivers with what they leave of the sea's waves, kept until something changes."""
    shape, flow = river_shape(level), river_flow(level)
    if shape is None or flow is None:
        return None
    settings = base_settings(level)
    sea = tuple(getattr(settings.sea, name) for name in ("swell_m", "swell_length_m", "swell_heading_deg", "chop_m",
                                                         "chop_length_m", "variance"))  # fmt: skip
    key = (shape.key, flow.key, sea, settings.level.seed, settings.flow.rivers)
    key += (level.layer_revision("mouth"),)
    have = level.derived.get("river_map")
    if have is not None and level.live and have.key[0] == shape.key:
        return have  # till the stroke ends
    if have is None or have.key != key:
        found = shares(level, shape, flow)
        packed = shape.packed.copy()
        packed[..., 3] = code_of_waves(found.swell, found.chop, found.white, np.maximum(-packed[..., 3], 0))
        most = max(float(found.swell.max()), float(found.chop.max()), 1.0)
        have = level.derived["river_map"] = replace(shape, packed=packed, key=key, most_gain=most)
    return have
