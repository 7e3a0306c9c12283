"""What the sea's pass costs with rivers and without, in yardsticks of bench_renderer.py (D13 to D16)."""

from __future__ import annotations

import sys
from pathlib import Path

DELTA = Path(__file__).parents[2] / "sample_levels" / "delta.shore"
PLACES = ("rapids", "mouth")
NAMES = tuple(f"the sea's pass with rivers: {place}" for place in PLACES)


def run() -> list[dict]:
    """Rows {name, ratio, limit, note}."""
    sys.path.insert(0, str(Path(__file__).parent))
    from bench_renderer import SIZE, Yardstick, pass_seconds
    from shorewright.io import read_level
    from shorewright.renderer import Renderer
    from shorewright.renderer.offscreen import own_context

    ctx = own_context()
    renderer = Renderer(ctx)
    try:
        yardstick, level, rows = Yardstick(ctx, SIZE), read_level(DELTA), []
        unit = min(yardstick.seconds() for _ in range(3))
        for name, place in zip(NAMES, PLACES, strict=True):
            units = []
            for on in (True, False):
                level.set("river.on", on)
                units.append(pass_seconds(renderer, level, level.camera(place), "medium")["sea"] / unit)
            note = f"Y = {unit * 1e3:.1f} ms; {units[1]:.1f} Y with river.on off; delta, medium"
            rows.append({"name": name, "ratio": units[0], "limit": None, "note": note})
        return rows
    finally:
        renderer.release()


if __name__ == "__main__":
    for row in run():
        print(f"{row['name']}: {row['ratio']:.2f} (limit {row['limit']}): {row['note']}", file=sys.stdout)
