"""What passes cost in yardsticks, triangles of a large level, bytes that a dab sends, how soon a stroke is seen."""

from __future__ import annotations

import sys
import time
from importlib import import_module
from pathlib import Path

import numpy as np

SIZE = (640, 360)
ROUNDS = 5
SIDE = 4097
LIT = ("terrain", "scatter", "contact", "light", "sky", "fog")  # what land and light cost every frame
MOST_TRIANGLES = 150_000
SEA_LIMITS = {"low": 8.0, "medium": 25.0, "high": 60.0}  # Y
COVE = Path(__file__).parents[2] / "sample_levels" / "cove.shore"
YARDSTICK = Path(__file__).with_name("yardstick.glsl")
NAMES = (
    "frame: low, play",
    "frame: low, survey",
    "frame: medium, play",
    "frame: medium, survey",
    "frame: low / medium",
    "land, things, light, sky and air: low",
    "triangles of a 4097² level / 150 000",
    "bytes a dab sends / bytes of its rectangle",
    "bytes a dab sends of the shore map / bytes of its rectangle",
    "bytes a fast slanting stroke sends / bytes it touched",
    "start: a renderer from its cache / without",
    "liveness: stroke to finished picture / picture without a change",
    "liveness: stroke's end to finished picture / picture without a change",
    "the sea at the beach: low",
    "the sea at the beach: medium",
    "the sea at the beach: high",
    "the sea under 64 lamps / under none",
)


def best(ctx, action, rounds: int = ROUNDS) -> float:
    """Seconds of the fastest of some runs after a warm-up, each to the end of what the GPU does."""
    took = []
    for _ in range(rounds + 1):
        ctx.finish()
        start = time.perf_counter()
        action()
        ctx.finish()
        took.append(time.perf_counter() - start)
    return min(took[1:])


class Yardstick:
    """design.md: full-screen triangle, RGBA8 1024² noise, LINEAR, no mipmaps, REPEAT, sixteen fetches a pixel."""

    def __init__(self, ctx, size: tuple[int, int]) -> None:
        self.ctx = ctx
        head, text = "#version 410 core\n#define {}\n", YARDSTICK.read_text()
        self.program = ctx.program(head.format("VERTEX") + text, head.format("FRAGMENT") + text)
        noise = np.random.default_rng(1).integers(0, 256, (1024, 1024, 4), np.uint8)
        self.noise = ctx.texture((1024, 1024), 4, noise.tobytes())
        self.noise.filter = ctx.LINEAR, ctx.LINEAR
        self.target = ctx.framebuffer([ctx.texture(size, 4)])
        self.triangle = ctx.vertex_array(self.program, [])

    def seconds(self) -> float:
        self.target.use()
        self.noise.use(0)
        return best(self.ctx, lambda: self.triangle.render(vertices=3))


def pass_seconds(renderer, level, camera, quality: str) -> dict[str, float]:
    """Seconds of each pass of a picture, the best of some rounds; the passes before it are drawn for every round."""
    from shorewright.renderer.frame import PASSES
    from shorewright.renderer.quality import tier
    from shorewright.renderer.views import find_view

    took = {row.name: [] for row in PASSES}
    for _ in range(ROUNDS + 1):
        scale = tier(quality).scale
        frame = renderer.prepare(level, camera, SIZE, 12.0, find_view("final"), None, quality, None, scale=scale)
        for held in (*renderer.kept.get("shadows", {}).values(), *renderer.kept.get("openness", {}).values()):
            held.key = ()  # else it would have nothing to do
        if "lobes" in renderer.kept:
            renderer.kept["lobes"].key = ()
        renderer.ctx.disable(renderer.ctx.DEPTH_TEST | renderer.ctx.BLEND)
        for row in PASSES:
            module = import_module(f"shorewright.renderer.passes.{row.name}")
            renderer.ctx.finish()
            start = time.perf_counter()
            module.draw(frame)
            renderer.ctx.finish()
            took[row.name].append(time.perf_counter() - start)
    return {name: min(times[1:]) for name, times in took.items()}


def passes(renderer) -> list[dict]:
    from shorewright.io import read_level

    level = read_level(COVE)
    yardstick, units, parts, whole, rows = Yardstick(renderer.ctx, SIZE), [], {}, {}, []
    for quality in ("low", "medium"):
        for place in ("play", "survey"):
            camera = level.camera(place)
            units.append(yardstick.seconds())
            parts[quality, place] = pass_seconds(renderer, level, camera, quality)
            seconds = best(renderer.ctx, lambda c=camera, q=quality: renderer.draw(level, c, SIZE, 12.0, quality=q), 3)
            whole[quality, place] = seconds
    unit = min(units)  # of several: other programs may slow one down
    for (quality, place), seconds in whole.items():
        by_cost = sorted(parts[quality, place].items(), key=lambda row: -row[1])
        told = ", ".join(f"{name} {s / unit:.2f}" for name, s in by_cost if s > 0.005 * unit)
        note = f"Y at 640 × 360, Y = {unit * 1e3:.1f} ms; one by one, shadow and open sky made anew: {told}"
        rows.append({"name": f"frame: {quality}, {place}", "ratio": seconds / unit, "limit": None, "note": note})
    ratio = max(whole["low", place] / whole["medium", place] for place in ("play", "survey"))
    note = "; ".join(f"{q} {p} {s * 1e3:.0f} ms" for (q, p), s in whole.items())
    rows.append({"name": NAMES[4], "ratio": ratio, "limit": 0.5, "note": note})
    places = [parts["low", place] for place in ("play", "survey")]
    lit = max(sum(place[name] for name in LIT) for place in places) / unit
    note = f"Y; {', '.join(LIT)}, the dearer of play and survey; maps that are kept (shadows, open sky, mirrors) apart"
    rows.append({"name": NAMES[5], "ratio": lit, "limit": 12.0, "note": note})
    return rows


def sea(renderer) -> list[dict]:
    """What the sea adds to a picture at the beach, every row on; and what 64 lamps add with it and without it."""
    from shorewright.io import read_level
    from shorewright.level.objects import Disturbance, Hit, Mover, PointLight
    from shorewright.renderer.show import Show

    level, dry = read_level(COVE), Show.hide("water")
    camera = level.camera("beach")
    x, y = camera.x, camera.y
    level.put_object("mover", Mover(id="mover", x=x + 12, y=y - 12))
    level.put_object("burst", Disturbance(id="burst", x=x + 20, y=y - 15, time_s=11.0))
    for n in range(4):
        level.put_object(f"hit-{n}", Hit(id=f"hit-{n}", x=x + 8 + 3 * n, y=y - 10, time_s=8.0 + n))
    yardstick, rows = Yardstick(renderer.ctx, SIZE), []
    unit = min(yardstick.seconds() for _ in range(3))

    def seconds(quality, show=None):
        return best(renderer.ctx, lambda: renderer.draw(level, camera, SIZE, 12.0, show=show, quality=quality), 3)

    for quality, limit in SEA_LIMITS.items():
        wet, bare = seconds(quality), seconds(quality, dry)
        note = f"Y = {unit * 1e3:.1f} ms; picture {wet / unit:.1f} Y with the sea, {bare / unit:.1f} Y without"
        rows.append(
            {"name": f"the sea at the beach: {quality}", "ratio": (wet - bare) / unit, "limit": limit, "note": note}
        )
    own = seconds("medium") - seconds("medium", dry)
    for n in range(64):
        place = {"x": x + 5.0 * (n % 8), "y": y - 5.0 * (n // 8), "z": 3.0}
        level.put_object(f"l{n}", PointLight(id=f"l{n}", **place, orbit_m=2.0))
    lit = seconds("medium") - seconds("medium", dry)
    note = f"{lit / unit:.1f} Y more with the sea than without, under 64 lamps; {own / unit:.1f} Y under none"
    rows.append({"name": "the sea under 64 lamps / under none", "ratio": lit / own, "limit": 1.1, "note": note})
    return rows


def large_level():
    from shorewright.level import Grid, Level
    from shorewright.level.framing import cameras

    y, x = np.mgrid[0:SIDE, 0:SIDE].astype(np.float32)
    level = Level(Grid(SIDE, SIDE), (np.sin(x / 190) * 8 + np.cos(y / 140) * 6).astype(np.float32))
    for camera in cameras(level):
        level.put_object(camera.id, camera)
    return level


def triangles(renderer, level) -> list[dict]:
    told = {}
    for name in ("play", "beach", "survey"):
        renderer.draw(level, level.camera(name), (160, 90), quality="medium")
        told[name] = renderer.stats["terrain_triangles"]
    note = ", ".join(f"{name} {count}" for name, count in told.items()) + ", medium"
    return [{"name": NAMES[6], "ratio": max(told.values()) / MOST_TRIANGLES, "limit": 1.0, "note": note}]


def stroke(level, journal, radius: float):
    from shorewright.brushes import BRUSHES, Stroke

    brush = BRUSHES["raise"]
    return Stroke(level, journal, brush, brush.with_params({"size_m": radius, "strength": 0.3}))


def uploads(renderer, level) -> list[dict]:
    """Bytes of one dab's rectangle of height, of the shore map with it, and of a quick stroke across the level."""
    from shorewright.level import Journal

    uploader, journal, camera = renderer.uploader, Journal(level), level.camera("play")
    renderer.draw(level, camera, (32, 18))
    held = stroke(level, journal, 64.0)
    before, was = level.revision, dict(uploader.sent)
    rect = held.begin(1500.0, 1500.0)
    renderer.draw(level, camera, (32, 18))
    sent = {name: count - was.get(name, 0) for name, count in uploader.sent.items()}
    note = f"{rect.shape[1]} × {rect.shape[0]} cells at 4097²; " + ", ".join(f"{n} {b}" for n, b in sent.items() if b)
    rows = [
        {"name": NAMES[7], "ratio": sent["u_height"] / (rect.cells * 4), "limit": 1.5, "note": note},
        {"name": NAMES[8], "ratio": sent["u_bed"] / (rect.cells * 4), "limit": None,
         "note": "four floats for every fourth sample each way, and what the window round the dab changed"},
    ]  # fmt: skip
    held.end()
    renderer.draw(level, camera, (32, 18))
    was, before = uploader.sent["u_height"], level.height.copy()
    held = stroke(level, journal, 128.0)
    held.begin(800.0, 800.0)
    held.move(2600.0, 2600.0)
    renderer.draw(level, camera, (32, 18))
    touched = int((before != level.height).sum()) * 4
    ratio = (uploader.sent["u_height"] - was) / touched
    note = f"200 dabs of radius 128 between two pictures, {touched / 1e6:.1f} MB of samples changed"
    rows.append({"name": NAMES[9], "ratio": ratio, "limit": 2.5, "note": note})
    held.end()
    return rows


def start(ctx) -> list[dict]:
    """A renderer with what it keeps between starts and without; both in a process that has everything imported."""
    import os
    import tempfile

    from shorewright.level import Settings, ground_textures, textures
    from shorewright.level.params import replace
    from shorewright.renderer import TIERS, Renderer, air, sky_light, sky_table
    from shorewright.renderer.cache import VARIABLE

    made = [textures.noise_texture, textures.foam_texture, textures.ripple_texture, sky_light.made]
    made.append(ground_textures.ground_textures)
    made += [sky_table.sky_table, sky_table.aerial_table, air.multiple_table, air.transmittance_table]
    before, took = os.environ.get(VARIABLE), []
    with tempfile.TemporaryDirectory() as folder:
        os.environ[VARIABLE] = folder
        for _ in range(3):
            for function in made:
                function.cache_clear()
            begun = time.perf_counter()
            renderer = Renderer(ctx)
            for tier in TIERS.values():
                renderer.generated.settle(tier)
            sky_light.sky_light(replace(Settings(), "light.sun_elevation_deg", 40.0))
            ctx.finish()
            took.append(time.perf_counter() - begun)
            held = ", ".join(f"{name} {size / 1e6:.1f} MB" for name, size in renderer.generated.bytes.items())
            renderer.release()
    os.environ.pop(VARIABLE) if before is None else os.environ.update({VARIABLE: before})
    note = f"{took[-1]:.2f} s against {took[0]:.2f} s to make the textures of all tiers and the sky; on the GPU: {held}"
    return [{"name": NAMES[10], "ratio": took[-1] / took[0], "limit": 0.5, "note": note}]


def liveness(renderer) -> list[dict]:
    """T14 in small: pointer to picture, low and at a governor's size, against the same picture without a change."""
    from shorewright.app.session import Session
    from shorewright.io import read_level
    from shorewright.renderer import pick

    session, ctx = Session(read_level(COVE)), renderer.ctx
    level, camera = session.level, session.level.camera("play")
    x, y, _ = pick(level, camera, (320, 180), 160, 110)

    def draw():
        renderer.draw(level, camera, (320, 180), 5.0, quality="low", scale=1.0)
        ctx.finish()

    still = best(ctx, draw)
    moves = []
    session.stroke_begin(x, y)
    draw()
    for step in range(12):
        begun = time.perf_counter()
        session.stroke_move(x + 2.0 * (step + 1), y + 0.7 * step)
        draw()
        moves.append(time.perf_counter() - begun)
    begun = time.perf_counter()
    session.stroke_end()
    draw()
    end = time.perf_counter() - begun
    session.close()
    live = float(np.median(moves))
    note = f"{live * 1e3:.0f} ms (longest {max(moves) * 1e3:.0f}) against {still * 1e3:.0f} ms, low, 320 × 180"
    return [
        {"name": NAMES[11], "ratio": live / still, "limit": 2.0, "note": note},
        {"name": NAMES[12], "ratio": end / still, "limit": None, "note": f"{end * 1e3:.0f} ms: the shore map anew"},
    ]


def run() -> list[dict]:
    """Rows {name, ratio, limit, note}."""
    from shorewright.renderer import Renderer
    from shorewright.renderer.offscreen import own_context

    ctx = own_context()
    renderer = Renderer(ctx)
    try:
        rows = passes(renderer) + sea(renderer) + liveness(renderer)
        level = large_level()
        return rows + triangles(renderer, level) + uploads(renderer, level) + start(ctx)
    finally:
        renderer.release()


if __name__ == "__main__":
    for row in run():
        print(f"{row['name']}: {row['ratio']:.2f} (limit {row['limit']}): {row['note']}", file=sys.stdout)
