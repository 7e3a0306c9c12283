"""One of sixteen: a live picture marches that part of the clouds' pixels and remembers the others (Z16).

The marched pixels go into a target of their own, a quarter as wide and high. The last sixteen of those are kept as they
were marched, each with its camera, and a pixel takes what was marched nearest to it, found by the clouds' distance, the
camera's way and the wind's: nothing is resampled twice. By texel where nothing moved, so that a still camera has the
bits of the full march after sixteen frames. Strips that come into view are marched whole.
"""

from __future__ import annotations

import math

import numpy as np

from ...level.sky_rect import sky_rect
from ...level.weather import TILE_M, drift_m
from ..cloud_image import BLOCK, ORDER, CloudHistory, Seen
from ..cloud_light import on_clouds
from ..frame import Frame
from ..uniforms import set_uniforms

SCRUB_S = 1.0  # a jump in time by more than that leaves nothing to be remembered
SECTIONS = ("clouds", "cloud_terms", "weather", "storm", "light", "fog")
FAR_M = 6000.0  # how far clouds are taken to be where only the screen's edge is asked for
MOST_STRIP = 0.1  # of the image's side: more than that coming into view at once is left to the marched part
FORGET, MOVED, STILL = range(3)
DEFINES = ({}, {"MOVED": ""}, {"STILL": ""})


def seen_now(frame: Frame) -> Seen:
    """What the image of this frame depends on."""
    level, m = frame.level, frame.matrices
    settings = tuple(getattr(level.settings, name) for name in SECTIONS)
    others = level.objects_revision, level.mean_sea_m, frame.tier.name
    key, rays = (level.layers["weather"], *settings, *others), (-m.view[2], m.ray_x, m.ray_y)
    return Seen(m.position.copy(), rays, frame.time_s, drift_m(level, frame.time_s), on_clouds(frame.sky.light), key)


def advance(frame: Frame, history: CloudHistory, march) -> None:
    """Make the next image; `march(target, pixel)` marches the pixels that `pixel` says (u_cloud_pixel)."""
    now, last, slot = seen_now(frame), history.seen, history.slot
    painted = frame.level.layer_revision("weather")
    flush = last is None or now.key != last.key or abs(now.time_s - last.time_s) > SCRUB_S
    mode = FORGET if flush else STILL if now.same_view(last) else MOVED
    if flush:
        history.forget()
    marched = _march_part(history, march, slot)
    history.slots[slot] = now
    old, history.now = history.image, 1 - history.now
    _resolve(frame, history, old, now, mode)
    if mode == MOVED:
        marched += sum(_whole(history, march, box) for box in _strips(now, last, history.size))
    if not flush and painted != history.painted:
        box = sky_rect(frame.level, frame.matrices, frame.level.changed_since("weather", history.painted), frame.time_s)
        marched += _whole(history, march, box) if box else 0
        mode = MOVED
    history.settled = history.settled + 1 if mode == STILL else 1
    history.frames += 1
    history.seen, history.painted = now, painted
    frame.stats["clouds_marched"] = marched
    frame.stats["clouds_settled"] = min(history.settled, len(ORDER))


def _march_part(history: CloudHistory, march, slot: int) -> int:
    """March one pixel of every block into its slot; returns how many pixels that are."""
    (i, j), (left, bottom), target = ORDER[slot], history.corner(slot), history.parts.framebuffer
    target.viewport = left, bottom, *history.part
    try:
        march(history.parts, (float(i - BLOCK * left), float(j - BLOCK * bottom), float(BLOCK)))
    finally:
        target.viewport = 0, 0, *history.parts.size
    return history.part[0] * history.part[1]


def _whole(history: CloudHistory, march, box: tuple[float, float, float, float]) -> int:
    """March all pixels of a box (left, bottom, right, top in 0 … 1) of the image; returns how many."""
    width, height = history.size
    left, bottom = math.floor(box[0] * width), math.floor(box[1] * height)
    right, top = math.ceil(box[2] * width), math.ceil(box[3] * height)
    if right <= left or top <= bottom:
        return 0
    target = history.image.framebuffer
    target.scissor = left, bottom, right - left, top - bottom
    try:
        march(history.image, (0.0, 0.0, 1.0))
    finally:
        target.scissor = None
    return (right - left) * (top - bottom)


def _resolve(frame: Frame, history: CloudHistory, old, now: Seen, mode: int) -> None:
    """Put marched and remembered pixels together."""
    parts, image = history.parts.textures, history.image
    frame.textures |= {
        "u_parts": parts[0], "u_parts_depth": parts[1], "u_last": old.textures[0], "u_last_depth": old.textures[1],
    }  # fmt: skip
    shader = frame.shader("cloud_resolve.glsl", **DEFINES[mode])
    values = {
        "u_slot": history.slot,
        "u_part": history.part,
        "u_cloud_size": tuple(map(float, image.size)),
        "u_ray_centre": tuple(float(v) for v in now.rays[0]),
    }
    if mode == MOVED:
        values |= _ways_back(history, now)
    set_uniforms(shader.program, values)
    image.framebuffer.use()
    shader.fullscreen()


def _ways_back(history: CloudHistory, now: Seen) -> dict:
    """From places relative to this camera to clip space of each part's, and (the last) of the last image's."""
    table = np.zeros((5, len(ORDER) + 1, 4), np.float32)
    for number, seen in enumerate((*history.slots, history.seen)):
        if seen is not None:
            moved, rows = way_back(now, seen)
            table[0, number] = *moved, 1.0
            table[1:4, number, :3] = rows
            table[4, number] = *(now.light / seen.light), 1.0
    return dict(zip(("u_moved", "u_back_x", "u_back_y", "u_back_z", "u_gone_on"), table, strict=True))


def way_back(now: Seen, last: Seen) -> tuple[np.ndarray, np.ndarray]:
    """What to add to a place relative to this camera, the wind taken off, and rows `(3, 3)` that turn it (float64)."""
    blown = now.drift_m - last.drift_m
    blown -= TILE_M * np.round(blown / TILE_M)
    moved = now.position - last.position
    moved[:2] -= blown
    forward, right, up = last.rays
    return moved, np.stack([right / (right @ right), up / (up @ up), forward])


def _strips(now: Seen, last: Seen, size: tuple[int, int]) -> list[tuple[float, float, float, float]]:
    """Boxes along the edges of the image that the last one did not see, in 0 … 1."""
    moved, rows = way_back(now, last)
    forward, right, up = now.rays
    edge = np.linspace(-1, 1, 9)
    found = []
    for axis, count in enumerate(size):
        along = (np.arange(count) + 0.5) / count * 2 - 1
        x, y = np.meshgrid(along, edge) if axis == 0 else np.meshgrid(edge, along)
        ray = forward + x[..., None] * right + y[..., None] * up
        there = ray / np.linalg.norm(ray, axis=-1, keepdims=True) * FAR_M + moved
        clip = there @ rows.T
        place = clip[..., axis] / np.maximum(clip[..., 2], 1e-3)
        fresh = ((np.abs(place) > 1) | (clip[..., 2] <= 0)).any(axis=1 - axis if axis else 0)
        most = round(MOST_STRIP * count)
        for side in (fresh, fresh[::-1]):
            wide = int(np.argmin(side)) if not side.all() else count
            if 0 < wide <= most:
                low, high = (0.0, wide / count) if side is fresh else (1 - wide / count, 1.0)
                found.append((low, 0.0, high, 1.0) if axis == 0 else (0.0, low, 1.0, high))
    return found
