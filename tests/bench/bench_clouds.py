"""What clouds cost: a sixteenth against the whole, cheap light and steps against dear ones, clear against covered."""

from __future__ import annotations

import importlib.util
import time
from importlib import import_module
from pathlib import Path

SIZE = (640, 360)
NAMES = (
    "clouds: one of sixteen and its resolve / full march",
    "clouds: cheap light from 0.3 opaque on / never",
    "clouds: cheap steps / none, half-covered sky",
    "clouds: clear sky / covered sky, the march alone",
    "sky and clouds, live: low",
    "clouds: one of sixteen and its resolve, moving / full march",
)
SKY = ("weather", "cloud_shadow", "cloud_dome", "lobes", "sky", "clouds", "rain")


def _renderer_bench():
    """bench_renderer.py: `best` and the yardstick."""
    path = Path(__file__).with_name("bench_renderer.py")
    spec = importlib.util.spec_from_file_location("shorewright_bench_renderer_shared", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _level(coverage: float, **terms: bool):
    """A beach under a fixed sky."""
    import numpy as np
    from shorewright.level import Grid, Level
    from shorewright.level.starter import sloping_beach

    grid = Grid(257, 257)
    level = Level(grid, np.asarray(sloping_beach(grid)))
    values = {"clouds.on": True, "weather.coverage": coverage, "weather.variety": 0.0, "weather.type": 0.9}
    if not coverage:
        values["weather.horizon_coverage"] = 0.0
    for path, value in (values | {f"cloud_terms.{name}": on for name, on in terms.items()}).items():
        level.set(path, value)
    return level


def _frame(renderer, level, camera, quality="medium", scale=1.0, time_s=12.0):
    from shorewright.renderer.passes import weather
    from shorewright.renderer.views import find_view

    frame = renderer.prepare(level, camera, SIZE, time_s, find_view("final"), None, quality, None, scale=scale)
    if quality == "medium":
        weather.draw(frame)
    return frame


def _live_passes(renderer, camera) -> dict[str, float]:
    """Seconds of each pass of the sky at low, live, camera and clock moving: the mean of two seconds of the clock.

    What is made only now and then counts by its share.
    """
    from shorewright.renderer.quality import tier

    level, ctx, took = _level(0.6), renderer.ctx, dict.fromkeys(SKY, 0.0)
    pictures = 60
    for number in range(-2, pictures):
        place = camera.model_copy(update={"x": camera.x + 0.3 * number})
        frame = _frame(renderer, level, place, "low", tier("low").scale, 20.0 + number / 30)
        frame.live = True
        for name in SKY:
            draw = import_module(f"shorewright.renderer.passes.{name}").draw
            ctx.finish()
            start = time.perf_counter()
            draw(frame)
            ctx.finish()
            took[name] += (time.perf_counter() - start) / pictures * (number >= 0)
    return took


def run() -> list[dict]:
    """Rows {name, ratio, limit, note}."""
    from shorewright.level.objects import Camera
    from shorewright.renderer import Renderer
    from shorewright.renderer.offscreen import own_context
    from shorewright.renderer.passes import clouds

    shared, ctx = _renderer_bench(), own_context()
    renderer, up = Renderer(ctx), Camera(id="up", x=100.0, y=40.0, z=20.0, yaw_deg=60.0, pitch_deg=22.0)

    def seconds(level, live: bool, rounds: int = 4, step_m: float = 0.0) -> float:
        """Of the image alone; `step_m` is how far the camera goes from picture to picture, 1/30 s apart."""
        took = []
        for number in range(rounds + 1):
            place = up.model_copy(update={"x": up.x + step_m * number})
            frame = _frame(renderer, level, place, time_s=12.0 + (number / 30 if step_m else 0.0))
            frame.live = live
            ctx.finish()
            start = time.perf_counter()
            clouds.make_image(frame)
            ctx.finish()
            took.append(time.perf_counter() - start)
        return min(took[1:])

    try:
        covered, dear = _level(0.85), _level(0.85, cheap_light=False)
        whole, part = seconds(covered, False), seconds(covered, True, 16)
        light = whole / seconds(dear, False)
        steps = seconds(_level(0.5), False) / seconds(_level(0.5, cheap_steps=False), False)
        clear = seconds(_level(0.0), False) / whole
        moving = seconds(covered, True, 16, 5.0) / whole
        passes = _live_passes(renderer, up)
        unit = shared.Yardstick(ctx, SIZE).seconds()
        told = ", ".join(f"{name} {took / unit:.2f}" for name, took in passes.items())
        note = f"640 × 360, medium, a still camera: {whole * 1e3:.0f} ms the full march"
        return [
            {"name": NAMES[0], "ratio": part / whole, "limit": 0.1, "note": note},
            {"name": NAMES[5], "ratio": moving, "limit": 0.1, "note": "5 m a picture sideways, the clock runs"},
            {"name": NAMES[1], "ratio": light, "limit": 1 / 1.5, "note": "a fixed covered sky"},
            {"name": NAMES[2], "ratio": steps, "limit": 0.5, "note": "tests say that no cloud is missed"},
            {"name": NAMES[3], "ratio": clear, "limit": 0.1, "note": "march of all pixels"},
            {
                "name": NAMES[4],
                "ratio": sum(passes.values()) / unit,
                "limit": 8.0,
                "note": f"Y = {unit * 1e3:.1f} ms; {told}",
            },
        ]
    finally:
        renderer.release()
