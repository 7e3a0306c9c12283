"""How things float (D12): a plane through the drawn surface at several points of the hull, as a pure function of time.

    poses(level, t)            # {id: Pose} of all props, one call of the twin for all hulls together
    pose.place, pose.axes      # world place of the mesh's origin, its axes as columns

Fifteen points under a hull take the mean of short waves, so a large hull is steady where a small one dances. At its
mooring a thing goes with the water under bow and stern, as the waves shift it; it never gets nearer to the ground than
its draft and lies down on a beach.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from .drift import drifted
from .force import ForceField
from .level import Level
from .meshes import mesh_of
from .objects import Prop
from .patches import removed
from .pick import ground_at
from .river_water import still_water_m
from .waves import sea_at, surface_at

ACROSS, ALONG = 3, 5  # points under a hull
NO_WATER_M = -1e6  # height of the sea where there is none
SPREAD = 0.8  # share of its box that they span: a hull is narrower below
BEDDED_M = 0.03  # so deep it lies in the ground
STEEPEST = 1.2  # slope at which it stops following


@dataclass(frozen=True)
class Pose:
    """World `place` (3,) of the mesh's origin, `axes` (3, 3) its unit axes as columns, `draft_m` of hull under water.

    `afloat` is the share of the hull that has water under it; 0 also for what does not float.
    """

    place: np.ndarray
    axes: np.ndarray
    draft_m: float = 0.0
    afloat: float = 0.0


def draft_of(level: Level, prop: Prop) -> float:
    """Metres of a floating prop's height that lie under water."""
    box = mesh_of(level, prop).box
    return min(prop.density, 1.0) * prop.scale * float(box[1, 2] - box[0, 2])


def poses(level: Level, t: float, force: ForceField | None = None) -> dict[str, Pose]:
    """Where every prop of a level is at time t, by id; `force` adds what that field lifts."""
    props = sorted((thing for thing in level.objects.values() if isinstance(thing, Prop)), key=lambda thing: thing.id)
    floating = [prop for prop in props if prop.floats]
    found = {prop.id: standing(prop) for prop in props if not prop.floats}
    if floating:
        found |= _afloat(level, t, floating, force)
    return found


def turned(yaw_deg: float, pitch_deg: float, roll_deg: float) -> np.ndarray:
    """Axes (3, 3) of a thing: bow (its y) up by pitch, heeled to the right by roll, turned clockwise from north."""
    yaw, pitch, roll = np.radians([yaw_deg, pitch_deg, roll_deg])
    (cy, sy), (cp, sp), (cr, sr) = ((math.cos(a), math.sin(a)) for a in (yaw, pitch, roll))
    about_z = np.array([(cy, sy, 0), (-sy, cy, 0), (0, 0, 1)])
    about_x = np.array([(1, 0, 0), (0, cp, -sp), (0, sp, cp)])
    about_y = np.array([(cr, 0, sr), (0, 1, 0), (-sr, 0, cr)])
    return about_z @ about_x @ about_y


def standing(prop: Prop) -> Pose:
    """The pose of what does not float."""
    axes = turned(prop.yaw_deg, prop.pitch_deg, prop.roll_deg)
    return Pose(np.array([prop.x, prop.y, prop.z]), axes)


def hull_points(level: Level, prop: Prop) -> np.ndarray:
    """Points of the hull's footprint `(15, 2)` in the mesh's x, y, metres."""
    (west, south, _), (east, north, _) = mesh_of(level, prop).box * prop.scale
    u, v = np.meshgrid(np.linspace(-0.5, 0.5, ACROSS), np.linspace(-0.5, 0.5, ALONG))
    span = SPREAD * np.array([east - west, north - south])
    return np.column_stack([u.ravel(), v.ravel()]) * span + ((west + east) / 2, (south + north) / 2)


def _afloat(level: Level, t: float, props: list[Prop], force: ForceField | None) -> dict[str, Pose]:
    drafts = np.array([draft_of(level, prop) for prop in props])
    moored = np.array([
        drifted(level, prop, t, draft) if prop.drifts else (prop.x, prop.y)
        for prop, draft in zip(props, drafts)
    ])  # fmt: skip
    hulls = np.stack([hull_points(level, prop) for prop in props])
    headings = np.radians([prop.yaw_deg for prop in props])
    world = moored[:, None] + _turned_flat(hulls, headings)
    places = np.moveaxis(world, -1, 0)
    water = still_water_m(level, *places) + level.tide_m
    free = np.clip(water - ground_at(level, *places) - drafts[:, None], 0, None)
    free = np.clip(free / np.maximum(0.5 * drafts[:, None], 0.05), 0, 1).mean(axis=1)  # none is left on the ground
    shift, turn = _carried(level, t, moored, hulls, headings)
    moored, headings = moored + shift * free[:, None], headings + turn * free
    world = moored[:, None] + _turned_flat(hulls, headings)
    ground = ground_at(level, *np.moveaxis(world, -1, 0)) - BEDDED_M
    water = surface_heights(level, t, world, force)
    sinks = np.array([prop.density >= 1 for prop in props])[:, None]
    over = np.where(sinks, ground, np.maximum(water - drafts[:, None], ground))  # of the hull's underside
    afloat = (over > ground + 1e-6).mean(axis=1)
    return {
        prop.id: _on_plane(level, prop, moored[i], headings[i], hulls[i], over[i], drafts[i], float(afloat[i]))
        for i, prop in enumerate(props)
    }


def surface_heights(level: Level, t: float, world: np.ndarray, force: ForceField | None = None) -> np.ndarray:
    """Height of the drawn water at world points `(…, 2)`; far below everything where there is none."""
    if not level.settings.water.on:
        return np.full(world.shape[:-1], NO_WATER_M)
    height = sea_at(level, t, world[..., 0], world[..., 1], force=force).height_m
    return np.where(removed(level, world[..., 0], world[..., 1]), NO_WATER_M, height)


def _carried(level: Level, t: float, moored: np.ndarray, hulls: np.ndarray, headings: np.ndarray):
    """How far waves shift things `(n, 2)` and turn them `(n,)` rad: what the water under bow and stern does."""
    if not level.settings.water.on:
        return np.zeros_like(moored), np.zeros(len(moored))
    ends = np.stack([hulls.mean(axis=1)] * 2, axis=1)
    ends[:, 0, 1], ends[:, 1, 1] = hulls[..., 1].max(axis=1), hulls[..., 1].min(axis=1)
    world = moored[:, None] + _turned_flat(ends, headings)
    surface = surface_at(level, t, world[..., 0], world[..., 1], skip_chop=True)
    shift = np.stack([surface.x, surface.y], -1) - world
    apart = np.maximum(ends[:, 0, 1] - ends[:, 1, 1], 0.1)
    across = np.stack([np.cos(headings), -np.sin(headings)], -1)
    turn = ((shift[:, 0] - shift[:, 1]) * across).sum(axis=-1) / apart
    return shift.mean(axis=1), np.arctan(turn)


def _turned_flat(points: np.ndarray, headings: np.ndarray) -> np.ndarray:
    """Points `(n, k, 2)` turned clockwise by `(n,)` rad."""
    cos, sin = (f(headings)[:, None] for f in (np.cos, np.sin))
    return np.stack([points[..., 0] * cos + points[..., 1] * sin, points[..., 1] * cos - points[..., 0] * sin], -1)


def _on_plane(level, prop: Prop, xy, heading: float, hull, over, draft_m: float, afloat: float) -> Pose:
    """The pose whose underside lies on the plane of least squares through heights `over` at hull points."""
    middle = hull.mean(axis=0)
    off = hull - middle
    # points of a regular grid: the fit's equations are independent
    slope = (off * over[:, None]).sum(axis=0) / np.maximum((off**2).sum(axis=0), 1e-9)
    slope *= min(1.0, STEEPEST / max(float(np.hypot(*slope)), 1e-9))
    level_axes = turned(math.degrees(heading), 0, 0)
    # in the hull's own level axes: up, then the bow in the plane, then starboard = bow × up
    up = np.array([-slope[0], -slope[1], 1.0]) / math.sqrt(1 + float(slope @ slope))
    bow = np.array([0.0, 1.0, slope[1]]) / math.hypot(1.0, slope[1])
    starboard = np.array([bow[1] * up[2] - bow[2] * up[1], bow[2] * up[0], -bow[1] * up[0]])
    axes = level_axes @ np.column_stack([starboard, bow, up]) @ turned(0, prop.pitch_deg, prop.roll_deg)
    bottom = prop.scale * float(mesh_of(level, prop).box[0, 2])
    centre = np.array([*(np.asarray(xy) + level_axes[:2, :2] @ middle), over.mean()])
    return Pose(centre - axes @ np.array([*middle, bottom]), axes, draft_m, afloat)
