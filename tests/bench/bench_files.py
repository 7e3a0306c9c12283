"""Opening a 4097² level against reading its files raw, and saving one dirty sector against saving all of them."""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path

import numpy as np

SIDE = 4097


def coast(side: int) -> np.ndarray:
    """A bed with the grain of a surveyed one: float32 `(side, side)` m."""
    y, x = np.mgrid[0:side, 0:side].astype(np.float32)
    rng = np.random.default_rng(1)
    return (np.sin(x / 190) * 8 + np.cos(y / 140) * 6 + rng.normal(0, 0.02, x.shape)).astype(np.float32)


def best(action, times: int = 5) -> float:
    """Seconds of the fastest of a few runs, the first a warm-up."""
    took = []
    for _ in range(times + 1):
        start = time.perf_counter()
        action()
        took.append(time.perf_counter() - start)
    return min(took[1:])


def decode_plainly(files: list[Path]) -> None:
    import OpenImageIO

    for file in files:
        image = OpenImageIO.ImageInput.open(str(file))
        image.read_image("float")
        image.close()


def run(side: int = SIDE) -> list[dict]:
    """Rows {name, ratio, limit, note}."""
    from shorewright.io import read_level, write_level
    from shorewright.level import Grid, Level, Rect

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "bench.shore"
        level = Level(Grid(side, side), coast(side))
        start = time.perf_counter()
        write_level(level, path)
        whole_s = time.perf_counter() - start
        files = sorted((path / "layers").glob("*.exr"))
        plain_s = best(lambda: decode_plainly(files))
        bytes_s = best(lambda: [file.read_bytes() for file in files])
        open_s = best(lambda: read_level(path))
        level.write("height", Rect(10, 10, 20, 20), 1.0)
        start = time.perf_counter()
        written = write_level(level, path)
        dirty_s = time.perf_counter() - start
    megabytes = round(side * side * 4 / 1e6)
    opening = f"{open_s:.3f} s for {megabytes} MB in {len(files)} files; decoding them in a plain loop {plain_s:.3f} s"
    saving = f"{dirty_s:.3f} s for {len(written)} files, {whole_s:.2f} s for the whole level"
    return [
        {
            "name": "open a level / decode its files",
            "ratio": open_s / plain_s,
            "limit": 2.0,
            "note": f"{opening}; only reading the bytes {bytes_s:.3f} s ({open_s / bytes_s:.1f} ×)",
        },
        {"name": "save one dirty sector / save all", "ratio": dirty_s / whole_s, "limit": 0.5, "note": saving},
    ]


if __name__ == "__main__":
    for row in run(int(sys.argv[1]) if len(sys.argv) > 1 else SIDE):
        print(f"{row['name']}: {row['ratio']:.2f} (limit {row['limit']}): {row['note']}")
