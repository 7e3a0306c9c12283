"""Rocks, driftwood and grass into the G-buffer (L09), before what lies under the water is copied."""

from __future__ import annotations

import math

import numpy as np

from ...level.loop import looped, moment
from ...level.weather_keys import run_m
from ..camera import camera_matrices
from ..frame import Frame
from ..scatter import CONTACT_FLOATS, Batch, Eye, Meshes, contacts, gather
from ..uniforms import set_uniforms

GUSTS = ((23.0, 4.2, 0.0), (8.3, 2.9, 0.6), (2.1, 1.7, -0.9))  # length m, speed m/s at 5 m/s of wind, turn rad
KEPT = 2  # so many tiers and sizes
MATERIALS = {"rocks": "ROCK", "driftwood": "WOOD", "grass": "GRASS"}


class Seen:
    """What is seen in pictures of one tier and size: groups on the GPU, dark feet for contact.py."""

    def __init__(self, frame: Frame) -> None:
        self.batch = Batch(frame.renderer.ctx, meshes(frame))
        self.feet = np.empty((0, CONTACT_FLOATS), np.float32)
        self.discs = None  # of these feet, made by contact.py

    def release(self) -> None:
        for thing in filter(None, (self.batch, self.discs)):
            thing.release()


def recent(frame: Frame, make, *key):
    """`make(frame)`, kept by `key` of tier and size: what moves and what stands still may differ in both."""
    kept, key = frame.renderer.kept.setdefault("scatter", {}), (make, *key)
    thing = kept.pop(key, None) or make(frame)
    kept[key] = thing  # the last one is the one used last
    for old in [other for other in kept if other[0] is make][:-KEPT]:
        kept.pop(old).release()
    return thing


def seen_in(frame: Frame) -> Seen:
    return recent(frame, Seen, frame.tier.name, frame.size)


def meshes(frame: Frame) -> Meshes:
    """Those of all batches."""
    kept = frame.renderer.kept
    return kept.get("scatter_meshes") or kept.setdefault("scatter_meshes", Meshes(frame.renderer.ctx))


def eye(frame: Frame) -> Eye:
    """One for all samples of a picture: without their jitter, a drawn pixel wider on each side."""
    steady = camera_matrices(frame.camera, frame.full_size, frame.matrices.near_m)
    steady.projection[:2] /= 1 + 2 / np.array(frame.size)[:, None]
    return Eye(steady.position, steady.planes, frame.uniforms["u_pixel_angle"])


def wind_uniforms(frame: Frame) -> dict:
    """Gusts that run about along `u_wind_way`, phases wrapped here; `u_wind_bend` in radians of lean."""
    sea, sway = frame.level.settings.sea, frame.level.settings.scatter.sway
    loop_s, blown_m = frame.level.settings.time.loop_s, run_m(frame.level, frame.time_s, "sea.wind_mps")
    waves = []
    for length, speed, turn in GUSTS:
        heading = math.radians(90.0 - sea.swell_heading_deg) + turn
        phase = speed * (0.4 * frame.time_s + 0.12 * blown_m) / length
        if loop_s > 0:  # gusts come round with the sea that they run over
            rate = speed * (0.4 + 0.12 * sea.wind_mps) / length
            phase = moment(frame.time_s, loop_s) / looped(1 / rate, loop_s)
        waves.append((math.cos(heading) / length, math.sin(heading) / length, phase - math.floor(phase), 0.0))
    bend = sway * 0.55 * sea.wind_mps / (sea.wind_mps + 9.0)
    return {"u_gusts": np.array(waves, np.float32), "u_wind_bend": bend}


def draw(frame: Frame) -> None:
    if not frame.level.settings.scatter.on:
        return
    seen, ctx = seen_in(frame), frame.renderer.ctx
    batch, settings = seen.batch, frame.level.settings.scatter
    seen_from = eye(frame)
    key = frame.tier.name, settings.distance_m, seen_from.planes.tobytes(), *seen_from.position, frame.size
    if not batch.fresh(frame.level, *key):
        groups = gather(frame.level, seen_from, frame.tier)
        frame.renderer.uploader.sent["scatter"] += batch.fill(frame.level, groups, *key)
        seen.feet = contacts(groups, seen_from, frame.tier)
    frame.targets.gbuffer.use()
    wind, mark = wind_uniforms(frame), {"MARK": ""} if frame.view.name == "scatter" else {}
    shaders = {}

    def shader(kind):
        if kind.name not in shaders:
            made = frame.shader("scatter.glsl", **{MATERIALS[kind.channel]: ""}, **mark)
            set_uniforms(made.program, wind)
            shaders[kind.name] = made
        made = shaders[kind.name]
        set_uniforms(made.program, {"u_kind_wind": kind.wind, "u_kind_tall": float(kind.name == "dune_grass"),
                                    "u_kind_colour": kind.colour})  # fmt: skip
        return made

    ctx.enable(ctx.DEPTH_TEST)
    triangles, instances = batch.draw(shader)
    ctx.disable(ctx.DEPTH_TEST)
    frame.stats["scatter_triangles"], frame.stats["scatter_instances"] = triangles, instances
