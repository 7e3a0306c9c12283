"""What a dab costs against the same maths in plain NumPy, and what undo keeps and costs (T01, T08)."""

from __future__ import annotations

import math
import sys
import time

import numpy as np

SIDE = 4097
RADIUS = 128  # cells
DABS = 200
NAMES = (
    "raise dab, radius 128, first of a stroke / plain NumPy",
    "raise dab, radius 128, along a stroke / plain NumPy",
    "undo of 200 dabs / bytes of the tiles it changed",
    "undo and redo at 4097² / at 1025²",
    "foam dab, radius 200 on 2048² / plain NumPy",
)


def noisy_level(side: int):
    from shorewright.level import Grid, Level

    noise = np.random.default_rng(1).normal(size=(side, side)).astype(np.float32)
    level = Level(Grid(side, side), noise)
    level.layers["height"].array  # noqa: B018 - the one copy of the base that the first stroke of a session makes
    return level


def start(level, journal, name: str = "raise", **params):
    from shorewright.brushes import BRUSHES, Stroke

    brush = BRUSHES[name]
    return Stroke(level, journal, brush, brush.with_params(params))


class Plain:
    """The reference: float32, the rectangle of the dab only, one line of NumPy for each line of the maths."""

    def __init__(self, height: np.ndarray, radius: float = RADIUS) -> None:
        self.base, self.radius = height, radius
        self.height = height.copy()
        self.mask = np.zeros_like(height)

    def dab(self, x: float, y: float, strength: float = 0.5, falloff: float = 0.7) -> None:
        row0, row1 = math.ceil(y - self.radius), math.floor(y + self.radius) + 1
        col0, col1 = math.ceil(x - self.radius), math.floor(x + self.radius) + 1
        where = slice(row0, row1), slice(col0, col1)
        rows = (np.arange(row0, row1) - y).astype(np.float32)[:, None]
        cols = (np.arange(col0, col1) - x).astype(np.float32)[None, :]
        distance = np.sqrt(rows * rows + cols * cols) / np.float32(self.radius)
        t = np.clip((distance - np.float32(1 - falloff)) / np.float32(falloff), 0, 1)
        weight = 1 - t * t * (3 - 2 * t)
        self.mask[where] = np.maximum(self.mask[where], weight)
        self.height[where] = self.base[where] + np.float32(strength) * self.mask[where]


def seconds(action) -> float:
    begun = time.perf_counter()
    action()
    return time.perf_counter() - begun


def winding(dabs: int, radius: float, spacing: float = 0.1) -> list[tuple[float, float]]:
    """Samples of a stroke of so many dabs that turns about, in a kilometre where the radius allows."""
    x, y, heading = 300.0, 300.0, 0.2
    points = [(x, y)]
    for number in range(dabs - 1):
        heading += 1.6 / dabs + 0.05 * math.sin(number / 17)
        x += math.cos(heading) * radius * spacing
        y += math.sin(heading) * radius * spacing
        points.append((x, y))
    return points


def play(stroke, points) -> None:
    stroke.begin(*points[0])
    for point in points[1:]:
        stroke.move(*point)
    stroke.end()


def dabs() -> list[dict]:
    from shorewright.level import Journal

    level = noisy_level(SIDE)
    journal, plain = Journal(level), Plain(level.layers["height"].base)
    first_s, plain_s, along_s = [], [], []
    places = np.random.default_rng(2).uniform(300, SIDE - 300, (60, 2))
    for x, y in places:
        plain_s.append(seconds(lambda x=x, y=y: plain.dab(x, y)))
        stroke = start(level, journal, size_m=RADIUS, strength=0.5)
        first_s.append(seconds(lambda stroke=stroke, x=x, y=y: stroke.begin(x, y)))
        stroke.end()
    for _ in range(3):
        stroke = start(level, journal, size_m=RADIUS, strength=0.5)
        points = winding(DABS, RADIUS * 1.001)
        stroke.begin(*points[0])
        along_s += [seconds(lambda stroke=stroke, point=point: stroke.move(*point)) for point in points[1:]]
        stroke.end()
    base = float(np.median(plain_s[5:]))
    rows = []
    for name, took in zip(NAMES[:2], (first_s[5:], along_s), strict=True):
        ours = float(np.median(took))
        note = f"{ours * 1e6:.0f} µs with its tile saves against {base * 1e6:.0f} µs, median"
        rows.append({"name": name, "ratio": ours / base, "limit": 2.5, "note": note})
    return rows


def foam_dab() -> list[dict]:
    """T03: a dab of foam against the same blend on an array of one channel, kept in one piece."""
    from shorewright.level import Grid, Journal, Level

    side, radius = 2048, 200
    level = Level(Grid(side, side), np.zeros((side, side), np.float32))
    level.write("foam", level.grid.rect, 0.2)
    journal, plain = Journal(level), Plain(level.layers["foam"].array[..., 1].copy(), radius)
    ours_s, plain_s = [], []
    for x, y in np.random.default_rng(4).uniform(radius + 20, side - radius - 20, (40, 2)):
        plain_s.append(seconds(lambda x=x, y=y: plain.dab(x, y)))
        stroke = start(level, journal, "paint", onto="foam.constant", size_m=radius)
        stroke.begin(x, y)
        ours_s.append(seconds(lambda stroke=stroke, x=x, y=y: stroke.move(x + 20.001, y)))
        stroke.abort()
    ours, base = float(np.median(ours_s[5:])), float(np.median(plain_s[5:]))
    note = f"{ours * 1e6:.0f} µs along a stroke against {base * 1e6:.0f} µs, median"
    return [{"name": NAMES[4], "ratio": ours / base, "limit": 2.5, "note": note}]


def sculpt(level, journal, kind: str) -> None:
    """Earlier work under the stroke to be measured."""
    if kind == "sculpted":
        for name, shift in (("flatten", 0), ("raise", 90), ("smooth", 40)):
            for lane in range(0, 1500, 300):
                points = [(shift + t * 150.0, lane + shift + 100 * math.sin(t)) for t in range(20)]
                play(start(level, journal, name, size_m=170), points)
    elif kind == "white noise":
        noise = np.random.default_rng(3).normal(size=level.grid.shape).astype(np.float32)
        level.write("height", level.grid.rect, noise * 2)


def undo_bytes() -> list[dict]:
    from shorewright.level import Journal

    rows = []
    for kind in ("never written", "sculpted", "white noise"):
        worst, told = 0.0, []
        level = noisy_level(SIDE if kind == "never written" else 3001)
        sculpt(level, Journal(level), kind)
        for name in ("raise", "smooth", "flatten"):
            for radius in (12, RADIUS):
                journal = Journal(level)
                play(start(level, journal, name, size_m=radius), winding(DABS, radius * 1.001))
                atom = journal.done[-1].atoms[0]
                ratio = atom.bytes / (len(atom.held) * 128 * 128 * 4)
                worst = max(worst, ratio)
                told.append(f"{name} {radius}: {ratio:.2f} of {len(atom.held)} tiles")
                journal.undo()
        rows.append({"name": f"{NAMES[2]}, {kind}", "ratio": worst, "limit": 0.6, "note": "; ".join(told)})
    return rows


def undo_cost() -> list[dict]:
    from shorewright.level import Journal

    journals = [Journal(noisy_level(side)) for side in (1025, SIDE)]
    took: list[list[float]] = [[], []]
    for journal in journals:
        play(start(journal.level, journal, size_m=60), winding(DABS, 40))
        play(start(journal.level, journal, size_m=60), winding(DABS, 40))
    for _ in range(12):  # in turns, so that another program's load falls on both
        for journal, times in zip(journals, took, strict=True):
            times.append(seconds(lambda journal=journal: (journal.undo(), journal.redo())))
    small, large = (min(times) for times in took)
    tiles = len(journals[0].done[-1].atoms[0].held)
    note = f"{large * 1e3:.1f} ms against {small * 1e3:.1f} ms for undo and redo of {tiles} tiles"
    return [{"name": NAMES[3], "ratio": large / small, "limit": 1.5, "note": note}]


def run() -> list[dict]:
    """Rows {name, ratio, limit, note}."""
    return dabs() + foam_dab() + undo_bytes() + undo_cost()


if __name__ == "__main__":
    for row in run():
        print(f"{row['name']}: {row['ratio']:.2f} (limit {row['limit']}): {row['note']}", file=sys.stdout)
