"""What times of travel and the shaping of fronts cost (T06, T07, T14), in yardsticks of NumPy work in the same run."""

from __future__ import annotations

import sys
import time
from pathlib import Path

import numpy as np

ROUNDS = 3
YARD_S = 0.0072  # of the yardstick on the computer that the limits in seconds are meant for
COVE = Path(__file__).parents[2] / "sample_levels" / "cove.shore"
PLACE, MOMENT_S, RADIUS_M, SIDE_M = (256.0, 265.0), 14.0, 40.0, 512
LIMITS_S = {
    "times of a swell anew, 257²": 0.1,
    "times of a swell anew, 1025²": 1.5,
    "times of three swells anew, 1025²": 3.0,
    "shaping a front: preview, depth": 0.15,
    "shaping a front: preview, travel_time": 0.15,
    "shaping a front: settled, depth": 1.5,
    "shaping a front: settled, travel_time": 1.5,
    "a dab of radius 128 that keeps the pace even": 0.05,
}
BESIDE = "an arrival map from the process beside / in this one"
SEA = "the sea by travel times / by depth"
NAMES = (*LIMITS_S, BESIDE, SEA)


def least(action, clock=time.process_time, rounds: int = ROUNDS) -> float:
    """Seconds of the fastest of some runs: of this process's work, or of the wall."""
    took = []
    for _ in range(rounds):
        start = clock()
        action()
        took.append(clock() - start)
    return min(took)


def yardstick() -> float:
    """Seconds of a fixed piece of float64 work that fits no cache, without BLAS."""
    values = np.random.default_rng(1).random((1024, 1024))

    def work():
        for _ in range(4):
            np.sqrt(values * values + 1.0)

    return least(work, rounds=9)


def beach(source: str = "depth"):
    """A level of 513² that a new session begins with, without the session's folders."""
    from shorewright.level import Grid, Level
    from shorewright.level.starter import sloping_beach

    grid = Grid(SIDE_M + 1, SIDE_M + 1)
    level = Level(grid, sloping_beach(grid))
    level.set("timing.source", source)
    return level


def travel() -> dict[str, float]:
    """Seconds of solving anew after a change of the bed, by row."""
    from shorewright.level.swell_request import Swell, SwellRequest, solve_request

    def bed(side: int) -> np.ndarray:
        y, x = np.mgrid[0:side, 0:side] / (side - 1)
        return (12.0 * (0.8 - y) + 1.5 * np.sin(9 * x) * np.sin(7 * y)).astype(np.float32)

    swells = tuple(Swell(period, heading) for period, heading in ((9.0, 10.0), (6.5, 25.0), (5.0, -15.0)))
    found = {}
    for name, side, count in zip(LIMITS_S, (257, 1025, 1025), (1, 1, 3), strict=False):
        request = SwellRequest(bed(side), 512.0 / (side - 1), swells[:count])
        found[name] = least(lambda request=request: solve_request(request))
    return found


def shaping() -> dict[str, float]:
    """Seconds of a look at a line in the hand and at rest, by row."""
    from shorewright.level.shaping import Shaping
    from shorewright.level.shaping_lines import crest_near, dragged

    found = {}
    for source in ("depth", "travel_time"):
        level = beach(source)
        wave, crest = crest_near(level, MOMENT_S, PLACE, RADIUS_M)
        at = tuple(float(v) for v in crest[np.hypot(*(crest - PLACE).T).argmin()])
        line = dragged(crest, at, (0.0, -5.0), RADIUS_M)
        held = Shaping(level, MOMENT_S, at, RADIUS_M, wave, quick=True)
        held.shape(line)
        found[f"shaping a front: preview, {source}"] = least(lambda held=held, line=line: held.shape(line))

        def rest(level=level, at=at, wave=wave, line=line):
            Shaping(level, MOMENT_S, at, RADIUS_M, wave).shape(line)

        found[f"shaping a front: settled, {source}"] = least(rest)
    return found


def dab() -> float:
    """Seconds of one dab of a raise stroke with all of `even_pace`."""
    from shorewright.brushes import BRUSHES, Stroke
    from shorewright.level import Journal

    level, brush = beach(), BRUSHES["raise"]
    stroke = Stroke(level, Journal(level), brush, brush.with_params({"size_m": 128.0, "even_pace": 1.0}))
    stroke.begin(200.0, 256.0)
    places = iter(range(1, 100))
    return least(lambda: stroke.move(200.0 + 13.0 * next(places), 256.0))


def beside() -> dict:
    """The way through the other process, against the same map worked out here; wall time."""
    from shorewright.app.arrival_worker import ArrivalWorker
    from shorewright.level.arrival import asked_of

    asked = asked_of(beach("travel_time"), 0.0)
    here = least(asked.answered, time.perf_counter)
    with ArrivalWorker() as worker:

        def there():
            worker.ask(1, asked)
            while worker.poll() is None:
                time.sleep(0.001)

        there()  # the process starts
        through = least(there, time.perf_counter)
    note = f"{through * 1e3:.0f} ms against {here * 1e3:.0f} ms, 513²"
    return {"name": BESIDE, "ratio": through / here, "limit": 1.5, "note": note}


def sea() -> dict:
    """What the sea adds to a picture of the beach in both sources."""
    from shorewright.io import read_level
    from shorewright.renderer import Renderer
    from shorewright.renderer.offscreen import own_context
    from shorewright.renderer.show import Show

    ctx = own_context()
    renderer, level, adds = Renderer(ctx), read_level(COVE), {}
    camera, dry = level.camera("play"), Show.hide("water")
    try:
        for source in ("travel_time", "depth"):
            level.set("timing.source", source)

            def draw(show=None):
                renderer.draw(level, camera, (320, 180), 12.0, show=show, quality="low", scale=1.0)
                ctx.finish()

            draw()
            adds[source] = least(draw, time.perf_counter, 5) - least(lambda: draw(dry), time.perf_counter, 5)
    finally:
        renderer.release()
    note = f"{adds['travel_time'] * 1e3:.0f} ms against {adds['depth'] * 1e3:.0f} ms, low, 320 × 180, play"
    return {"name": SEA, "ratio": adds["travel_time"] / adds["depth"], "limit": 1.6, "note": note}


def run() -> list[dict]:
    """Rows {name, ratio, limit, note}."""
    found = {**travel(), **shaping(), "a dab of radius 128 that keeps the pace even": dab()}
    unit = yardstick()
    rows = []
    for name, limit_s in LIMITS_S.items():
        note = f"{found[name] * 1e3:.0f} ms of work, {1e3 * unit:.1f} ms the yardstick"
        rows.append({"name": name, "ratio": found[name] / unit, "limit": limit_s / YARD_S, "note": note})
    return [*rows, beside(), sea()]


if __name__ == "__main__":
    for row in run():
        print(f"{row['name']}: {row['ratio']:.2f} (limit {row['limit']:.1f}): {row['note']}", file=sys.stdout)
