"""Levels for the runtime kit's tests, and its C compiled and run."""

import shutil
import subprocess

import numpy as np
import pytest
from coasts import make_beach
from shorewright.io.export.kit.files import sources, text_of
from shorewright.level.objects import Pin, River, SwellRegion, WaveObject
from shorewright.level.river_bed import carved

STRICT = ["-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", "-pedantic"]
READ = """#include <stdio.h>
#include <stdlib.h>
static void *whole_file(const char *name) {
    FILE *file = fopen(name, "rb");
    if (!file) return NULL;
    fseek(file, 0, SEEK_END);
    size_t size = (size_t)ftell(file);
    rewind(file);
    char *text = malloc(size);
    if (fread(text, 1, size, file) != size) exit(1);
    fclose(file);
    return text;
}
"""
SEA = (
    READ
    + """
#include "sea.h"
int main(int count, char **words) {
    bool over = count > 1 && words[1][0] == 'o';
    float *texels = whole_file("sea.f32");
    unsigned char *bytes = whole_file("sea.u8");
    sea_state g;
    sea_set_up(&g, texels, bytes);
    double ask[3];
    while (fread(ask, sizeof(double), 3, stdin) == 3) {
        sea_at_time(&g, ask[0]);
        vec2 at = {(float)ask[1], (float)ask[2]};
        Sea sea = over ? sea_at(&g, at) : sea_surface(&g, at);
        vec2 flow = flow_at(&g, at), first, second;
        float weight;
        flow_places(&g, at, flow, 0.0f, &first, &second, &weight);
        float told[16] = {sea.position.x, sea.position.y, sea.position.z, sea.normal.x, sea.normal.y, sea.normal.z,
                          flow.x, flow.y, first.x, first.y, second.x, second.y, weight, foam_on(&g, sea),
                          sea.before.x, sea.before.y};
        fwrite(told, sizeof(float), 16, stdout);
    }
    free(texels);
    free(bytes);
    return 0;
}
"""
)
SKY = (
    READ
    + """
#include "sky.h"
int main(void) {
    float *texels = whole_file("sky.f32");
    unsigned char *bytes = whole_file("sky.u8");
    sky_state g;
    sky_set_up(&g, texels, bytes);
    double ask[4];
    while (fread(ask, sizeof(double), 4, stdin) == 4) {
        sky_at_time(&g, ask[0]);
        vec4 weather = weather_at(&g, (vec2){(float)ask[1], (float)ask[2]});
        float density = cloud_density(&g, (vec3){(float)ask[1], (float)ask[2], (float)ask[3]});
        float told[5] = {weather.x, weather.y, weather.z, weather.w, density};
        fwrite(told, sizeof(float), 5, stdout);
    }
    free(texels);
    free(bytes);
    return 0;
}
"""
)


def plain():
    return make_beach(rows=97, cols=97, sway=0.3)


def plunging():
    level = make_beach(rows=97, cols=97)
    level.set("shore.plunge", 1.0)
    return level


def placed():
    """Wave objects, rings among them, a region, and a rectangle that the artist marked as calm."""
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


def travelling():
    """Waves that refract, with plunging and pins."""
    level = make_beach(rows=97, cols=97)
    level.set("timing.source", "travel_time")
    level.set("shore.plunge", 1.0)
    level.put_object("pin", Pin(id="pin", x=50, y=25, time_s=4.0))
    return level


LEVELS = {"plain": plain, "plunging": plunging, "placed": placed, "river": river, "travelling": travelling}


def asked(level, times, count):
    """(n, 3) times and undeformed points, the points float32's own."""
    rng = np.random.default_rng(5)
    points = np.float32(rng.uniform(0, 1, (len(times) * count, 2)) * level.grid.extent_m).astype(np.float64)
    return np.column_stack([np.repeat(times, count), points])


def put_files(source, folder, stem):
    """A part's header and maps, as the C programs here look for them."""
    (folder / f"{stem}.h").write_text(text_of(source, "test", "c"))
    for kind, suffix in (("<f4", ".f32"), ("|u1", ".u8")):
        maps = [values for values in source.data.maps.values() if values.dtype.str == kind]
        (folder / f"{stem}{suffix}").write_bytes(b"".join(values.tobytes() for values in maps))


def build(folder, *files):
    """C99 without a warning, to the program `run`; skips without a compiler."""
    compiler = shutil.which("gcc") or shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler here")
    built = subprocess.run([compiler, *STRICT, *files, "-o", "run", "-lm"], cwd=folder, capture_output=True, text=True)
    assert built.returncode == 0, built.stderr[:2000]


def run_c(level, asks, folder, *words):
    """(n, 16) by the sea's C at (n, 3) times and points: position, normal, flow, its two places, weight, foam, before.

    With a word, over world points: `sea_at`.
    """
    put_files(sources(level, "test", "sea"), folder, "sea")
    return _ran(SEA, asks, folder, 16, *words)


def run_sky(level, asks, folder):
    """(n, 5) by the sky's C at (n, 4) times and places: weather, density."""
    put_files(sources(level, "test", "sky"), folder, "sky")
    return _ran(SKY, asks, folder, 5)


def _ran(main, asks, folder, columns, *words):
    (folder / "main.c").write_text(main)
    build(folder, "main.c")
    ran = subprocess.run(["./run", *words], cwd=folder, input=asks.tobytes(), capture_output=True, check=True)
    return np.frombuffer(ran.stdout, np.float32).reshape(-1, columns)
