"""What a river and its jet leave of the sea's waves that meet it (D35).

Waves by band: of a group the mean over its fronts of what the current leaves of each (`blocking.py`), in the jet by
the angle between them, up the river straight against it. What was stopped on the way comes no farther up.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .blocking import Met, met
from .earth import GRAVITY
from .gerstner import Fronts, groups
from .level import Level
from .river_flow import RiverFlow, river_flow
from .river_jet import Mouth, smooth
from .river_line import Line
from .river_map import PAINTED, RiverMap, code_of_waves, river_shape
from .weather_keys import base_settings

TIDAL = 8.0  # widths up a quiet river over which waves die out on its banks and bed
EVENS = 0.2  # lengths: over less, waves don't change their height along their crests; half a mouth at most
TURNS_IN = 3.0  # widths before the mouth over which waves from all sides become waves up the river


@dataclass
class Shares:
    """Of swell and chop what comes to each place, × amplitude, and how white 0 … 1 it is there; float32."""

    swell: np.ndarray
    chop: np.ndarray
    white: np.ndarray


def _group(fronts: Fronts, depth_m, east, north, up: float = 0.0, speed=None) -> Met:
    """Of a group: the mean over its fronts by amplitude against a current `east`, `north`, the whitest of them.

    `up` 0 … 1: how far all of them run straight against it, `speed` m/s.
    """
    total = Met(*(np.zeros(np.shape(depth_m)) for _ in range(3)))
    weights = fronts.amplitude_m + 1e-9  # of a flat sea all alike
    weights = weights / weights.sum()
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


@dataclass
class _Around:
    """The part of the map that rivers and their jets may reach, as views, and what becomes of waves there."""

    rows: slice
    cols: slice
    cell_m: float
    owner: np.ndarray
    nearest: np.ndarray
    share: np.ndarray
    sea_depth_m: np.ndarray
    out: Shares


def _around(level: Level, shape: RiverMap, flow: RiverFlow) -> _Around:
    own, cell_m = shape.packed[..., 1] > 0, shape.cell_m
    spans = [np.flatnonzero(own.any(axis)) for axis in (1, 0)]
    for mouth in flow.mouths:
        spans = [np.append(span, box) for span, box in zip(spans, mouth.box(cell_m), strict=True)]
    if not level.layers["mouth"].neutral:
        spans = [np.array([0, n]) for n in own.shape]
    rows, cols = (slice(int(max(span.min(initial=n), 0)), int(np.clip(span.max(initial=-1) + 1, 0, n)))
                  for span, n in zip(spans, own.shape, strict=True))  # fmt: skip
    stride = round(cell_m / level.grid.cell_m)
    depth = np.float32(level.mean_sea_m) - level.height[::stride, ::stride][rows, cols]
    out = Shares(*(np.full(depth.shape, value, np.float32) for value in (1, 1, 0)))
    return _Around(rows, cols, cell_m, shape.owner[rows, cols], shape.nearest[rows, cols],
                   shape.packed[rows, cols, 1], depth, out)  # fmt: skip


def shares(level: Level, shape: RiverMap, flow: RiverFlow) -> tuple[Shares, tuple[slice, slice]]:
    """What the level's rivers leave of the sea's waves, and the part of the map where: elsewhere it is all of them."""
    around = _around(level, shape, flow)
    high, low = groups(base_settings(level).sea, level.settings.level.seed)
    strength = base_settings(level).flow.rivers * base_settings(level).flow.on
    for mouth in flow.mouths:
        _jet(around, mouth, strength, (high, low))
    for which, line in enumerate(shape.lines):
        own = (around.owner == which) & (around.share > 0)
        own[own] = around.nearest[own] < line.mouth
        if own.any():
            _channel(around, own, line, _along(line, shape, flow), strength, (high, low))
    out = around.out
    painted = around.share * (around.owner == PAINTED)  # no way leads there
    out.swell *= 1 - painted
    out.chop *= 1 - painted
    _by_hand(out, level, shape)
    return out, (around.rows, around.cols)


def _by_hand(out: Shares, level: Level, shape: RiverMap) -> None:
    """Painted −1 … 1: less of the waves down to none, or more of them up to those of the open sea."""
    layer = level.layers["mouth"]
    if layer.neutral:
        return
    stride = round(shape.cell_m / level.grid.cell_m)
    paint = layer.read(level.grid.rect)[::stride, ::stride]
    less, more = 1 + np.minimum(paint, 0), np.maximum(paint, 0)
    for name in ("swell", "chop"):
        share = getattr(out, name) * less
        setattr(out, name, share + (np.maximum(share, 1) - share) * more)
    out.white = out.white * less * (1 - more)


def _jet(around: _Around, mouth: Mouth, strength: float, fronts) -> None:
    from scipy.ndimage import gaussian_filter

    window, spans = (around.rows, around.cols), mouth.box(around.cell_m)
    box = tuple(slice(max(low, own.start), max(min(high, own.stop), own.start))
                for (low, high), own in zip(spans, window, strict=True))  # fmt: skip
    here = tuple(slice(part.start - own.start, part.stop - own.start) for part, own in zip(box, window, strict=True))
    y, x = np.mgrid[box] * around.cell_m
    speed = strength * mouth.speed(x, y, around.cell_m, 2 * mouth.half_m)
    felt = speed > 0
    speed, (ahead, _) = speed[felt], mouth.off(x[felt], y[felt])
    up = 1 - smooth(0.0, 2 * TURNS_IN * mouth.half_m, ahead)
    depth = np.maximum(around.sea_depth_m[here][felt], mouth.depth_m)  # waves come in by the deepest way
    if not felt.any():
        return
    for name, group in zip(("chop", "swell"), fronts, strict=True):
        one = _group(group, depth, speed * mouth.east, speed * mouth.north, up, speed)
        changes = np.zeros(felt.shape, np.float32)
        changes[felt] = one.gain * one.through - 1
        wide = min(EVENS * float(group.length_m.mean()), mouth.half_m) / around.cell_m
        getattr(around.out, name)[here] *= 1 + gaussian_filter(changes, wide, mode="nearest", truncate=3)
        if name == "chop":
            white = around.out.white[here]
            white[felt] = np.maximum(white[felt], one.white)


def _channel(around: _Around, own: np.ndarray, line: Line, runs, strength: float, fronts) -> None:
    """Up the river: waves that were stopped on the way don't come farther up. `runs`: its speed and depth by point."""
    laid = {name: np.zeros(line.mouth) for name in ("swell", "chop", "white")}
    if line.mouth < len(line.x):
        speed, depth = runs
        up = (line.along_m[line.mouth - 1] - line.along_m[: line.mouth]) / (2 * TIDAL * line.half_m[line.mouth - 1])
        dies = 1 - smooth(0.0, 1.0, up)
        for name, group in zip(("chop", "swell"), fronts, strict=True):
            one = _group(group, depth, 0.0, 0.0, 1.0, speed * strength)
            through = np.minimum.accumulate(one.through[::-1])[::-1]  # from the sea
            laid[name] = one.gain * through * dies
            if name == "chop":
                laid["white"] = one.white * np.append(through[1:], through[-1]) * dies
    index, share = around.nearest[own], around.share[own]
    goes = np.ones(line.mouth)
    if line.mouth < len(line.x):  # over one width the jet at the mouth goes over into it
        goes = smooth(0.0, 2 * line.half_m[line.mouth - 1], line.along_m[line.mouth - 1] - line.along_m[: line.mouth])
    for name, values in laid.items():
        rest, whole = 0.0 if name == "white" else 1.0, getattr(around.out, name)
        whole[own] += (rest + (values[index] - rest) * share - whole[own]) * goes[index]


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
    key = (shape.key, flow.key, sea, settings.level.seed, settings.flow.rivers, settings.flow.on)
    key += (level.layer_revision("mouth"),)
    have = level.derived.get("river_map")
    if have is not None and level.live and have.key[0] == shape.key:
        return have  # till the stroke ends
    if have is not None and have.key != key and flow.key[0] != shape.key and have.packed.shape == shape.packed.shape:
        have = level.derived["river_map"] = _till_it_flows(shape, have, key)
    if have is None or have.key != key:
        found, there = shares(level, shape, flow)
        packed = shape.packed.copy()
        packed[..., 3] = code_of_waves(1.0, 1.0, 0.0, 0.0)
        rough = np.maximum(-shape.packed[there][..., 3], 0)
        packed[there][..., 3] = code_of_waves(found.swell, found.chop, found.white, rough)
        most = max(float(values.max(initial=1.0)) for values in (found.swell, found.chop))
        have = level.derived["river_map"] = replace(shape, packed=packed, key=key, most_gain=most)
    return have


def _till_it_flows(shape: RiverMap, before: RiverMap, key: tuple) -> RiverMap:
    """A new shape with the waves of the map before it, none in new water: its flow is still on its way."""
    packed, now, was = shape.packed.copy(), shape.packed[..., 1] > 0, before.packed[..., 1] > 0
    kept = np.where(was & ~now, code_of_waves(1.0, 1.0, 0.0, 0.0), before.packed[..., 3])
    packed[..., 3] = np.where(now & ~was, packed[..., 3], kept)
    return replace(shape, packed=packed, key=key, most_gain=before.most_gain)
