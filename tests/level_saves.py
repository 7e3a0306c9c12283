"""A level, a change to it, and what tells two states of it apart: for tests of saving."""

import shutil

import numpy as np
from shorewright.io import LevelFolder, write_level
from shorewright.level import Grid, Level, Rect
from shorewright.level.objects import Camera


class Killed(BaseException):
    """Stands for the end of the process: nothing in the program catches it."""


def make():
    level = Level(Grid(40, 1200), np.random.default_rng(0).normal(0, 5, (40, 1200)).astype(np.float32))
    level.write("foam", Rect(0, 0, 5, 5), 0.5)
    return level


def change(level):
    """Rewrite a sector, add one, empty one, place an object."""
    level.write("height", Rect(0, 1000, 9, 1100), 9.0)
    level.layers["foam"].put_tile((0, 0), None)
    level.mark("foam", Rect(0, 0, 9, 9))
    level.put_object("play", Camera(id="play"))


def state(level):
    layers = {n: d.array[d.written.repeat(128, 0).repeat(128, 1)[: d.array.shape[0], : d.array.shape[1]]].tobytes()
              for n, d in level.layers.items() if not d.neutral}  # fmt: skip
    return level.height.tobytes(), layers, sorted(level.objects)


def steps_of(tmp_path, first):
    """What a save reports, in order."""
    level = make()
    path = tmp_path / "count.shore"
    if not first:
        write_level(level, path)
        change(level)
    seen = []
    with LevelFolder(path, seen.append) as folder:
        folder.save(level)
    shutil.rmtree(path)
    return seen
