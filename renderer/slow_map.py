"""Maps that live pictures make ahead of the clock, some rows a picture, while those before are shown (Z16, Z17, Z19).

A kept map is that of a whole moment (`at_whole`). A still picture makes it at once; in live ones that of the next whole
moment is drawn by strips beside it, in the rhythm that has it ready in time, and takes its place when that comes. What
an artist changes, a jump of the clock or of the camera is answered at once, as in a still picture.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from ..level.sun import day_runs
from ..level.weather_keys import base_settings
from .kept_map import KeptMap
from .sky_textures import SkyTextures

AHEAD = "_ahead"  # ends the names of maps in the making
STRIPS = 32  # of a map
MOST_SHARE = 1 / 8  # of all strips a picture, however slowly pictures follow each other
READY = 0.7  # of the time between two maps: then the next is to be whole
SUN_DEG, LEAST_S = 1.0, 0.5
JUMP_S, JUMP_M = 1.0, 200.0  # from one picture to the next; more is no way but a jump
SECTIONS = ("clouds", "cloud_terms", "weather", "storm", "light", "fog", "level")


class Step(NamedTuple):
    """A part of a map: how many texels, and what draws them."""

    texels: int
    draw: Callable[[], None]


class Making(NamedTuple):
    """A map, what it is made for, and the steps that make it; `stat` is the name under which texels are counted."""

    made: KeptMap
    key: tuple
    steps: list[Step]
    stat: str


class Slow(NamedTuple):
    """Maps that take turns together: their names, how often they are made, and what does (`make(frame, ending, strips)`
    gives the Makings of maps whose names have that ending; each may read those before it)."""

    names: tuple[str, ...]
    every_s: float
    make: Callable[..., list[Making]]


class Coming:
    """The maps in the making, and the picture that last asked."""

    def __init__(self) -> None:
        self.fixed: tuple = ()
        self.time_s, self.position = math.inf, np.zeros(3)
        self.sky: SkyTextures | None = None
        self.drop()

    def drop(self) -> None:
        """Nothing is in the making."""
        self.due_s = 0.0
        self.makings: list[Making] | None = None
        self.steps: list[tuple[Step, str]] = []
        self.done = 0

    @property
    def whole(self) -> bool:
        return self.makings is not None and self.done == len(self.steps)

    @property
    def textures(self) -> list:
        return list(self.sky.textures.values()) if self.sky else []

    def release(self) -> None:
        if self.sky:
            self.sky.release()


def in_strips(made: KeptMap, draw: Callable[[], None], strips: int, box: tuple[int, ...] | None = None) -> list[Step]:
    """The drawing of a map, or of a box (left, bottom, width, height) of it, by strips of rows."""
    left, bottom, width, height = box or (0, 0, *made.size)

    def strip(low: int, high: int) -> None:
        made.framebuffer.viewport = left, bottom, width, height
        made.framebuffer.scissor = left, bottom + low, width, high - low
        made.framebuffer.use()
        try:
            draw()
        finally:
            made.framebuffer.scissor = None

    edges = [height * n // strips for n in range(strips + 1)]
    return [
        Step(width * (high - low), lambda low=low, high=high: strip(low, high))
        for low, high in pairwise(edges)
        if high > low
    ]


def keep_up(frame, slow: Slow) -> None:
    """Bring maps to what this picture shows: at once, or in live pictures a share of the next."""
    coming = frame.renderer.kept.setdefault(slow.names[-1] + AHEAD + "_made", Coming())
    fixed, gone_s = _fixed(frame), frame.time_s - coming.time_s
    moved_m = float(np.linalg.norm(frame.matrices.position - coming.position))
    steady = frame.live and fixed == coming.fixed and moved_m <= JUMP_M
    if steady and gone_s == moved_m == 0.0:
        return
    steady = steady and 0.0 < gone_s <= JUMP_S
    coming.fixed, coming.time_s, coming.position = fixed, frame.time_s, frame.matrices.position.copy()
    if not steady:
        coming.drop()
        for making in slow.make(frame, "", 1):
            if making.made.key != making.key:
                _run(frame, [(step, making.stat) for step in making.steps])
                making.made.key = making.key
        return
    _take_turns(frame, slow, coming)
    if coming.makings is None:
        _begin(frame, slow, coming)
    _go_on(frame, slow, coming, gone_s)
    _take_turns(frame, slow, coming)  # those that are late


def _fixed(frame) -> tuple:
    """What maps depend on that does not follow from the clock and the camera's place."""
    settings, level = base_settings(frame.level), frame.level
    revisions = level.objects_revision, level.layer_revision("weather")
    looks = frame.tier.name, frame.view.name, frame.show, frame.camera.id, frame.textures.get("u_noise")
    return (level.layers["weather"], level.sea_level_m, *revisions, *looks,
            *(getattr(settings, name) for name in SECTIONS))  # fmt: skip


def _take_turns(frame, slow: Slow, coming: Coming) -> None:
    """What is whole is shown from its moment on; what was shown is drawn over next."""
    if not coming.whole or coming.due_s > frame.time_s:
        return
    kept = frame.renderer.kept
    for making in coming.makings:
        making.made.key = making.key
    for name in slow.names:
        kept[name], kept[name + AHEAD] = kept[name + AHEAD], kept[name]
        kept[name].name, kept[name + AHEAD].name, kept[name + AHEAD].key = name, name + AHEAD, ()
    coming.drop()


def _every_s(frame, slow: Slow) -> float:
    """The time from map to map: halved until the sun goes no more than SUN_DEG in it, but for LEAST_S."""
    light, every_s = frame.level.settings.light, slow.every_s
    if day_runs(light):
        degrees = 360.0 / 86400.0 * light.day_rate * 24.0 / light.day_h
        while every_s > LEAST_S and every_s * degrees > SUN_DEG:
            every_s /= 2
    return every_s


def _begin(frame, slow: Slow, coming: Coming) -> None:
    """The maps of the next whole moment, nearer where the sun goes fast."""
    every_s = _every_s(frame, slow)
    due_s = (math.floor(frame.time_s / every_s) + 1) * every_s
    coming.sky = coming.sky or SkyTextures(frame.renderer.ctx)
    ahead = frame.renderer.at_time(frame, due_s, coming.sky)
    coming.due_s = due_s
    coming.makings = slow.make(ahead, AHEAD, STRIPS)
    coming.steps = [(step, making.stat) for making in coming.makings for step in making.steps]


def _go_on(frame, slow: Slow, coming: Coming, gone_s: float) -> None:
    """As many steps as the pictures' rhythm asks for, within bounds."""
    total = len(coming.steps)
    asked = min(math.ceil(total * gone_s / (READY * _every_s(frame, slow))), max(int(MOST_SHARE * total), 1))
    part = coming.steps[coming.done : coming.done + asked]
    _run(frame, part)
    coming.done += len(part)
    if part and coming.whole:
        frame.renderer.ask_light(frame, coming.due_s + _every_s(frame, slow))
    frame.stats["map_strips"] = frame.stats.get("map_strips", 0) + len(part)


def _run(frame, steps: list[tuple[Step, str]]) -> None:
    frame.renderer.ctx.disable(frame.renderer.ctx.BLEND)
    for step, stat in steps:
        step.draw()
        frame.stats[stat] = frame.stats.get(stat, 0) + step.texels
