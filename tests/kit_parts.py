"""Levels for the runtime kit's tests, and its C compiled and run."""

import shutil
import subprocess

import numpy as np
import pytest
from coasts import make_beach
from shorewright.io.export.kit.files import sources
from shorewright.level.objects import Pin, River, SwellRegion, WaveObject
from shorewright.level.river_bed import carved

MAIN = """#include <stdio.h>
#include <stdlib.h>
#include "sea.h"
int main(int count, char **words) {
    bool over = count > 2;
    FILE *file = fopen(words[1], "rb");
    fseek(file, 0, SEEK_END);
    size_t size = (size_t)ftell(file);
    rewind(file);
    float *texels = malloc(size);
    if (fread(texels, 1, size, file) != size) return 1;
    fclose(file);
    sea_state g;
    sea_set_up(&g, texels);
    double ask[3];
    while (fread(ask, sizeof(double), 3, stdin) == 3) {
        sea_at_time(&g, ask[0]);
        vec2 at = {(float)ask[1], (float)ask[2]};
        Sea sea = over ? sea_at(&g, at) : sea_surface(&g, at);
        vec2 flow = flow_at(&g, at), first, second;
        float weight;
        flow_places(&g, at, flow, 0.0f, &first, &second, &weight);
        float told[13] = {sea.position.x, sea.position.y, sea.position.z, sea.normal.x, sea.normal.y, sea.normal.z,
                          flow.x, flow.y, first.x, first.y, second.x, second.y, weight};
        fwrite(told, sizeof(float), 13, stdout);
    }
    free(texels);
    return 0;
}
"""


def plain():
    return make_beach(rows=97, cols=97, sway=0.3)


def plunging():
    level = make_beach(rows=97, cols=97)
    level.set("shore.plunge", 1.0)
    return level


def placed():
    """Wave objects, rings among them, and a region."""
    level = make_beach(rows=97, cols=97)
    level.put_object("w", WaveObject(id="w", x=40.0, y=25.0, radius_m=40.0, yaw_deg=33.0))
    level.put_object("o", WaveObject(id="o", x=60, y=20, ring=True, radius_m=15, length_m=3, amplitude_m=0.2))
    level.put_object("r", SwellRegion(id="r", x=50.0, y=20.0, radius_m=40.0, amplitude=1.7))
    return level


def river():
    level = make_beach(rows=161, cols=121)
    points = tuple((0.0, -81.0 * i / 4, 8.0, v, 1.0) for i, v in enumerate((4.5, 3.0, 2.4, 0.5, 0.0)))
    one = River(id="river", x=60, y=155, points=points)
    level.write("height", *carved(level, one))
    level.put_object("river", one)
    return level


LEVELS = {"plain": plain, "plunging": plunging, "placed": placed, "river": river}


def asked(level, times, count):
    """(n, 3) times and undeformed points, the points float32's own."""
    rng = np.random.default_rng(5)
    points = np.float32(rng.uniform(0, 1, (len(times) * count, 2)) * level.grid.extent_m).astype(np.float64)
    return np.column_stack([np.repeat(times, count), points])


def run_c(level, asks, folder, *words):
    """(n, 13) positions, normals, flow, places of its two copies, weight by a kit's C, at (n, 3) times and points.

    With a word, over world points: `sea_at`.
    """
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler here")
    made, data = sources(level, "test", ["c"])
    (folder / "sea.h").write_text(made["c"])
    (folder / "main.c").write_text(MAIN)
    (folder / "sea.f32").write_bytes(b"".join(values.tobytes() for values in data.maps.values()))
    strict = ["-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "-pedantic"]
    built = subprocess.run(
        [compiler, *strict, "main.c", "-o", "sea", "-lm"], cwd=folder, capture_output=True, text=True
    )
    assert built.returncode == 0, built.stderr[:2000]
    ran = subprocess.run(
        ["./sea", "sea.f32", *words], cwd=folder, input=asks.tobytes(), capture_output=True, check=True
    )
    return np.frombuffer(ran.stdout, np.float32).reshape(-1, 13)


def travelling():
    """Waves that refract, with plunging, pins and an overridden hectare."""
    level = make_beach(rows=97, cols=97)
    level.set("timing.source", "travel_time")
    level.set("shore.plunge", 1.0)
    level.put_object("pin", Pin(id="pin", x=50, y=25, time_s=4.0))
    return level


LEVELS["travelling"] = travelling
