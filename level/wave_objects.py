"""Wave objects: three fronts of their own in a circle, straight or curved, placed like lights (Hitman talk, H08, H09).

A front's phase is `2π q / length − φ t` along a bent coordinate q: straight distance along its way, blended with the
distance from a centre behind it (curvature > 0, fronts bulge ahead) or before it (< 0, they close in). The gradient is
exact. Weight blends displacements, never phases. The twin is shaders/wave_objects.glsl.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from .dual import Dual, step
from .earth import GRAVITY
from .gerstner import Fronts
from .level import Level
from .objects import SwellRegion, WaveObject
from .river_water import River
from .settings import Sea
from .wave_lists import MOST_OBJECTS, MOST_ON_PATCH, counted
from .weather_keys import base_settings

HIGH, LOW = range(2)  # the passes, in the order in which they are added (H06)
SHARES = (0.7, 0.17, 0.13)  # of the amplitude; the first front goes exactly where the object looks
SPREAD_DEG = (0.0, 5.0, -5.0)
LENGTHS = (1.0, 0.79, 1.23)
CENTRE = 1.2  # the centre of a wholly curved front is that many radii off: outside the circle, where q has no kink
LEAST_FALLOFF = 0.05
RING_HOLE = 0.25  # of the radius, within which rings rise
STEEPEST = 0.6  # of the sum of k · lateral; at 1 crests fold over (Finch), and others may stand on the same water
FULL_DEPTH = 3.0  # in that many amplitudes of water over `sea.deep_start_m` an object's waves stand whole


@lru_cache(maxsize=256)
def object_fronts(thing: WaveObject, seed: int) -> Fronts:
    """The three fronts of an object in a level of that seed: like a group's (H05), but close to each other."""
    rng = np.random.Generator(np.random.PCG64([seed + 1, thing.seed]))
    wobble = rng.uniform(-1, 1, (3, 3)) * np.array([0.0, 1.0, 1.0])  # the lead is what the artist asked for
    heading = np.radians(thing.yaw_deg + np.array(SPREAD_DEG) + 1.5 * wobble[0])
    length = thing.length_m * np.array(LENGTHS) * (1 + 0.06 * wobble[1])
    share = np.array(SHARES) * (1 + 0.2 * wobble[2])
    amplitude = thing.amplitude_m * share / share.sum()
    k = 2 * np.pi / length
    lateral = 2 * thing.lateral * amplitude
    lateral *= min(1.0, STEEPEST / max(float(np.sum(k * lateral)), 1e-9))
    if thing.inverted:  # H32: points are drawn together in the troughs
        lateral = -lateral
    begin = np.array([0.0, 0.618034, 0.236068])
    omega = thing.speed * np.sqrt(GRAVITY * k)
    return Fronts(np.sin(heading), np.cos(heading), length, omega, amplitude, lateral, begin)


def phase_cycles(fronts: Fronts, t) -> np.ndarray:
    """How far each front has gone at time t (arrays too, the fronts on the first axis), 0 … 1."""
    gone = np.mod(np.multiply.outer(fronts.omega, t) / (2 * np.pi), 1.0)
    return np.mod(fronts.begin.reshape(-1, *[1] * np.ndim(t)) + gone, 1.0)


def wave_pass(sea: Sea, length_m: float) -> int:
    """HIGH or LOW: the group whose wavelength is nearer by ratio (H06)."""
    chop, swell = (abs(np.log(length_m / own)) for own in (sea.chop_length_m, sea.swell_length_m))
    return HIGH if chop < swell else LOW


def in_passes(level: Level) -> tuple[list[WaveObject], list[WaveObject]]:
    """The objects that count, by pass; weather that changes the sea moves none to the other."""
    sea, passes = base_settings(level).sea, ([], [])
    for thing in counted(level)[0]:
        passes[wave_pass(sea, thing.length_m)].append(thing)
    return passes


def inner_m(thing: WaveObject | SwellRegion) -> float:
    """Up to here from its middle it has all its weight."""
    return thing.radius_m * (1 - max(thing.falloff, LEAST_FALLOFF))


def circle_weight(
    thing: WaveObject | SwellRegion, x, y, whole_m: float | None = None, end_m: float | None = None
) -> Dual:
    """1 within, falling smoothly to 0 at the circle's edge, at undeformed points."""
    px, py = x - thing.x, y - thing.y
    away = np.hypot(px, py)
    reach = np.maximum(away, 1e-6)
    whole_m, end_m = inner_m(thing) if whole_m is None else whole_m, thing.radius_m if end_m is None else end_m
    off = Dual(away, px / reach, py / reach)
    weight = 1.0 - step(whole_m, end_m, off)
    if getattr(thing, "ring", False):  # where rings begin there is a kink: the water stays flat
        weight = weight * step(0.0, RING_HOLE * thing.radius_m, off)
    return weight


def bend_of(thing: WaveObject) -> tuple[float, float]:
    """How far its fronts are bent, and the distance of their centre from its middle, m."""
    return (1.0, 0.0) if thing.ring else (thing.curvature, CENTRE * thing.radius_m)


def front_coordinate(thing: WaveObject, east: float, north: float, x: Dual, y: Dual) -> tuple[Dual, Dual, Dual]:
    """Metres along a front's way from the object's place, bent by its curvature, and its gradient (east, north)."""
    bend, centre_m = bend_of(thing)
    centre_m = np.copysign(centre_m, bend)
    px, py = x - thing.x, y - thing.y
    cx, cy = px + centre_m * east, py + centre_m * north
    away = np.maximum(np.hypot(cx.v, cy.v), 1e-3)
    r = Dual(away, (cx.v * cx.dx + cy.v * cy.dx) / away, (cx.v * cx.dy + cy.v * cy.dy) / away)
    over = Dual(1 / away, -r.dx / away**2, -r.dy / away**2)
    straight = 1 - abs(bend)
    q = (px * east + py * north) * straight + (r - abs(centre_m)) * bend
    return q, cx * over * bend + straight * east, cy * over * bend + straight * north


def object_shift(thing: WaveObject, seed: int, t: float, x: Dual, y: Dual) -> tuple[Dual, Dual, Dual]:
    """What an object of full weight adds to world x, y and height at base points x, y."""
    fronts = object_fronts(thing, seed)
    phase = phase_cycles(fronts, t)
    dx, dy, dz = Dual(0.0), Dual(0.0), Dual(0.0)
    for i in range(3):
        q, way_x, way_y = front_coordinate(thing, fronts.east[i], fronts.north[i], x, y)
        cycles = q.v / fronts.length_m[i] - phase[i]
        theta = 2 * np.pi * (cycles - np.floor(cycles))
        sin, cos, k = np.sin(theta), np.cos(theta), 2 * np.pi / fronts.length_m[i]
        lateral = Dual(cos, -sin * k * q.dx, -sin * k * q.dy) * fronts.lateral_m[i]
        rise = Dual(sin, cos * k * q.dx, cos * k * q.dy) * fronts.amplitude_m[i]
        dx, dy, dz = dx + lateral * way_x, dy + lateral * way_y, dz + rise
    return dx, dy, dz


def full_depth_m(sea: Sea, thing: WaveObject) -> float:
    """Depth from which an object's waves stand whole: coastal ones come in nearer than those of the open sea (D11)."""
    return sea.deep_start_m + max(FULL_DEPTH * thing.amplitude_m, 0.2)


def objects_water(sea: Sea, bed: dict[str, Dual], river: River) -> dict[str, Dual]:
    """The bed as objects know it: on water of its own they stand wherever it is deep (H32)."""
    return {
        "smoothed": bed["smoothed"] + river.still + river.own * sea.deep_start_m,
        "sea": bed["sea"] + river.own - bed["sea"] * river.own,
    }


def objects_shift(level: Level, which: int, t: float, x: Dual, y: Dual, before_x, before_y, bed: dict[str, Dual]):
    """What all objects of a pass add to world x, y and height, weighted; `bed` at the undeformed points."""
    total, sea = (Dual(0.0), Dual(0.0), Dual(0.0)), level.settings.sea
    for thing in in_passes(level)[which]:
        weight = circle_weight(thing, before_x, before_y)
        if np.any(weight.v > 0):
            depth = step(sea.deep_start_m, full_depth_m(sea, thing), bed["smoothed"])
            weight = weight * depth * bed["sea"] * float(sea.on)
            moved = object_shift(thing, level.settings.level.seed, t, x, y)
            total = tuple(old + new * weight for old, new in zip(total, moved, strict=True))
    return total


def most_height_m(level: Level) -> float:
    """No more than this do objects add to the sea's height anywhere: the largest sum of four."""
    heights = sorted((thing.amplitude_m for thing in counted(level)[0]), reverse=True)
    return float(sum(heights[:MOST_ON_PATCH]))


def object_uniforms(level: Level, t: float) -> dict:
    """What shaders/wave_objects.glsl asks for, {} without objects: those of the high pass first."""
    passes = in_passes(level)
    things = [*passes[HIGH], *passes[LOW]]
    if not things:
        return {}
    place, bend = np.zeros((MOST_OBJECTS, 4), np.float32), np.zeros((MOST_OBJECTS, 3), np.float32)
    way, size = np.zeros((3 * MOST_OBJECTS, 4), np.float32), np.zeros((3 * MOST_OBJECTS, 2), np.float32)
    for n, thing in enumerate(things):
        fronts, rows = object_fronts(thing, level.settings.level.seed), slice(3 * n, 3 * n + 3)
        place[n] = thing.x, thing.y, inner_m(thing), thing.radius_m
        bend[n] = *bend_of(thing), full_depth_m(level.settings.sea, thing)
        way[rows] = np.stack([fronts.east, fronts.north, 1 / fronts.length_m, phase_cycles(fronts, t)], -1)
        size[rows] = np.stack([fronts.amplitude_m, fronts.lateral_m], -1)
    return {
        "u_wave_ends": (len(passes[HIGH]), len(things)), "u_wave_place": place, "u_wave_bend": bend, "u_wave_way": way,
        "u_wave_size": size,
    }  # fmt: skip
