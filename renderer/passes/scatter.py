"""Rocks, driftwood and grass into the G-buffer (L09), before what lies under the water is copied."""

from __future__ import annotations

import math

import numpy as np

from ..camera import camera_matrices
from ..frame import Frame
from ..scatter import Batch, Eye, Meshes, contacts, gather
from ..uniforms import set_uniforms

GUSTS = ((23.0, 4.2, 0.0), (8.3, 2.9, 0.6), (2.1, 1.7, -0.9))  # length m, speed m/s at 5 m/s of wind, turn rad
MATERIALS = {"rocks": "ROCK", "driftwood": "WOOD", "grass": "GRASS"}


def held(frame: Frame) -> dict:
    """What this pass, contact and prop_shadow keep from frame to frame."""
    kept = frame.renderer.kept.setdefault("scatter", {})
    if not kept:
        kept["meshes"] = Meshes(frame.renderer.ctx)
        kept["seen"] = Batch(frame.renderer.ctx, kept["meshes"])
    return kept


def eye(frame: Frame) -> Eye:
    """One for all samples of a picture: without their jitter, a drawn pixel wider on each side."""
    steady = camera_matrices(frame.camera, frame.full_size, frame.matrices.near_m)
    steady.projection[:2] /= 1 + 2 / np.array(frame.size)[:, None]
    return Eye(steady.position, steady.planes, frame.uniforms["u_pixel_angle"])


def wind_uniforms(frame: Frame) -> dict:
    """Gusts that run with the wind, their phases wrapped here; `u_wind_bend` in radians of lean."""
    sea, sway = frame.level.settings.sea, frame.level.settings.scatter.sway
    waves = []
    for length, speed, turn in GUSTS:
        heading = math.radians(90.0 - sea.swell_heading_deg) + turn
        phase = frame.time_s * speed * (0.4 + 0.12 * sea.wind_mps) / length
        waves.append((math.cos(heading) / length, math.sin(heading) / length, phase - math.floor(phase), 0.0))
    heading = math.radians(90.0 - sea.swell_heading_deg)
    bend = sway * 0.55 * sea.wind_mps / (sea.wind_mps + 9.0)
    return {
        "u_gusts": np.array(waves, np.float32),
        "u_wind_way": (math.cos(heading), math.sin(heading)),
        "u_wind_bend": bend,
    }


def draw(frame: Frame) -> None:
    if not frame.level.settings.scatter.on:
        return
    kept, ctx = held(frame), frame.renderer.ctx
    batch, settings = kept["seen"], frame.level.settings.scatter
    seen_from = eye(frame)
    key = frame.tier.name, settings.distance_m, seen_from.planes.tobytes(), *seen_from.position, frame.size
    if not batch.fresh(frame.level, *key):
        groups = gather(frame.level, seen_from, frame.tier)
        frame.renderer.uploader.sent["scatter"] += batch.fill(frame.level, groups, *key)
        kept["contacts"] = ContactRows(contacts(groups, seen_from, frame.tier))
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


class ContactRows:
    """What contact.py draws, until it is gathered anew."""

    def __init__(self, rows: np.ndarray) -> None:
        self.rows = rows
        self.sent = False

    def release(self) -> None:
        """Holds nothing on the GPU."""
