"""Levels to export, and looks at what was written."""

import hashlib
import json
import os
import time

import numpy as np
from shorewright.level import LAYERS, BadInput, Grid, Level

GROUND = ["height", "flow"]  # maps of an export that is small
MANIFEST = "bay.shorewright.json"  # of an export named bay


def rough_level(rows, cols=None, cell_m=1.0, seed=1, low=-30.0, high=55.0, sea_m=0.0):
    """A rough level whose lowest and highest samples are exactly `low` and `high`."""
    noise = np.random.default_rng(seed).random((rows, cols or rows))
    noise = (noise - noise.min()) / (noise.max() - noise.min())
    level = Level(Grid(rows, cols or rows, cell_m), (low + noise * (high - low)).astype(np.float32))
    level.set("level.sea_level_m", sea_m)
    return level


def slope_level(rows=30, cols=41, cell_m=1.0, sea_m=0.0):
    """A rough ground that rises to the north-east, so that no flip or transposition goes unseen."""
    north, east = np.mgrid[0:rows, 0:cols] * cell_m
    noise = np.random.default_rng(8).normal(0, 0.4, (rows, cols))
    level = Level(Grid(rows, cols, cell_m), (-6 + 0.3 * north + 0.1 * east + noise).astype(np.float32))
    level.set("level.sea_level_m", sea_m)
    return level


def painted_level():
    """A small coast with something in every layer, uneven, and a sky."""
    level = slope_level(33, 47)
    rng = np.random.default_rng(5)
    for name, row in LAYERS.items():
        if name in ("height", "river_surface") or row.grid != "level":
            continue
        low, high = max(row.low, -1.0), min(row.high, 1.0)
        shape = (*level.grid.shape, len(row.channels)) if len(row.channels) > 1 else level.grid.shape
        level.write(name, level.grid.rect, rng.uniform(low, high, shape).astype(np.float32))
    level.set("clouds.on", True)
    return level


def read_manifest(folder):
    (path,) = folder.glob("*.shorewright.json")
    return json.loads(path.read_text("utf-8"))


def snapshot(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def one(findings, word):
    """The only finding, which names `word`."""
    assert len(findings) == 1, findings
    assert word in findings[0]
    assert "\n" not in findings[0]


def sign(folder, edit):
    """Edit the manifest as a program would that also makes its hash fit: only decoding can find that out."""
    path = folder / MANIFEST
    data = json.loads(path.read_text("utf-8"))
    edit(data)
    for file in data["files"]:
        inside = folder / file["name"]
        if inside.is_file():
            file["size_bytes"] = inside.stat().st_size
            file["sha256"] = hashlib.sha256(inside.read_bytes()).hexdigest()
    del data["manifest_sha256"]
    text = json.dumps(data, sort_keys=True, separators=(",", ":"))
    data["manifest_sha256"] = hashlib.sha256(text.encode()).hexdigest()
    path.write_text(json.dumps(data), "utf-8")


# Work for a process beside the window


def look_at(level, told, name):
    """What the process was given, and whether it is still wanted."""
    return told(0.5, name), level.height.copy()


def wait_until_stopped(level, told):
    while told(0.1, "on"):
        time.sleep(0.01)
    raise BadInput("no")


def die(level, told):
    os._exit(3)
