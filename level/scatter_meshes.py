"""Meshes of scattered things, made here: rocks, driftwood, grass (L09); each with levels of detail, finest first.

All stand on z = 0; what is below lies in the ground. A rock's unit is its radius, a log's its length (along x), a
tuft's its height. Triangles run counter-clockwise seen from outside; blades have two sides.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from .scatter_shapes import Mesh, blade, icosphere, join, tube, vertex_normals


@dataclass(frozen=True)
class Family:
    make: object  # (seed, detail) → Mesh
    variants: int
    details: int = 3


def mesh(family: str, variant: int, detail: int) -> Mesh:
    """A variant of a family at a level of detail, 0 the finest."""
    return _made(family, variant, detail)


def variants(family: str) -> int:
    return MESHES[family].variants


@functools.cache
def _made(family: str, variant: int, detail: int) -> Mesh:
    row = MESHES[family]
    return row.make(np.random.default_rng([sum(map(ord, family)), variant]), detail)


# Rocks


def rock(rng: np.random.Generator, detail: int, sharp: float = 34.0, planes: int = 11, bury: float = 0.46) -> Mesh:
    """A ball cut by planes whose edges are worn: r = (Σ (d · n / offset)^p)^(−1/p), the larger p the sharper.

    A few planes cut deep and leave flat faces, the others break the edges between them.
    """
    directions, indices = icosphere(3 - detail)
    normals = rng.normal(size=(planes, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    offsets = np.where(np.arange(planes) % 2, rng.uniform(0.74, 0.92, planes), rng.uniform(0.52, 0.74, planes))
    turns = rng.normal(size=(6, 3)) * np.array([2.0, 2.0, 4.5, 4.5, 9.0, 9.0])[:, None]
    phases, squash = rng.uniform(0, 6.28, 6), np.array([1.0, rng.uniform(0.64, 0.95), rng.uniform(0.55, 0.80)])
    lean = rng.normal(size=2) * 0.2
    cut = np.maximum(directions @ normals.T, 0.0) / offsets
    r = (np.sum(cut**sharp, axis=1) + 0.96**-sharp) ** (-1 / sharp)
    waves = np.sin(directions @ turns.T + phases) * np.array([0.03, 0.03, 0.018, 0.018, 0.008, 0.008])
    vertices = directions * (r * (1 + waves.sum(axis=1)))[:, None] * squash
    vertices[:, 2] += vertices[:, :2] @ lean
    vertices[:, :2] -= (vertices[:, :2].max(axis=0) + vertices[:, :2].min(axis=0)) / 2
    vertices /= np.sqrt((vertices[:, :2] ** 2).sum(axis=1).max())
    low, high = vertices[:, 2].min(), vertices[:, 2].max()
    vertices[:, 2] -= low + bury * (high - low)  # cut by the ground about where it is widest: it doesn't stand on it
    return join([(vertices, vertex_normals(vertices, indices), np.zeros(len(vertices)), indices)])


def pebble(rng: np.random.Generator, detail: int) -> Mesh:
    """Rolled round."""
    return rock(rng, detail + 1, 7.0, 9, 0.36)


# Driftwood

BEDDED = {"log": 0.0105, "branch": 0.006}  # how deep the underside of a trunk lies in the ground, in its length


def _limb(rng: np.random.Generator, start, way, length: float, thick: float, thin: float, detail: int, bend: float,
          lying: bool = False):  # fmt: skip
    """A tapered, bent, knotty tube; a lying one touches z = 0 from end to end."""
    count, sides = ((13, 9), (7, 6), (3, 4))[detail]
    t = np.linspace(0, 1, 13)
    way = np.asarray(way, float) / np.linalg.norm(way)
    wander = np.cumsum(rng.normal(size=(13, 3)) * bend * length / 13 * (1.0, 1.0, 0.5), axis=0)
    wander -= t[:, None] * wander[-1]
    spine = np.asarray(start, float) + way * (t[:, None] * length) + wander
    radius = (thick + (thin - thick) * t**0.8) * (1 + 0.10 * rng.normal(size=13))
    if lying:
        spine[:, 2] = radius
    lobes = 1 + 0.10 * rng.normal(size=(13, 9))
    lobes = (lobes + np.roll(lobes, 1, 0) + np.roll(lobes, -1, 0)) / 3
    pick = np.linspace(0, 12, count).round().astype(int)
    return tube(spine[pick], radius[pick], sides, lobes[pick][:, :sides])


def _bedded(made: Mesh, family: str) -> Mesh:
    """The same with the underside of its trunk in the ground; roots and stumps may go deeper."""
    return Mesh(made.vertices - np.array([0, 0, BEDDED[family]], np.float32), made.normals, made.sway, made.indices)


def log(rng: np.random.Generator, detail: int) -> Mesh:
    """A trunk with the stumps of branches, part of it in the sand; some keep the foot of their roots."""
    thick = rng.uniform(0.042, 0.062)
    parts = [_limb(rng, (-0.5, 0, 0), (1, 0, 0), 1.0, thick, 0.55 * thick, detail, 0.10, lying=True)]
    for _ in range(int(rng.integers(1, 4))):
        at, turn = rng.uniform(-0.2, 0.42), rng.uniform(-0.4, 2.2)
        way = (rng.uniform(0.3, 0.9), np.cos(turn), max(np.sin(turn), 0.15))
        size = rng.uniform(0.05, 0.17)
        if detail < 2:
            parts.append(_limb(rng, (at, 0, 0.75 * thick), way, size, 0.42 * thick, 0.2 * thick, detail, 0.15))
    if rng.random() < 0.6 and detail < 2:
        for turn in np.arange(5) * 1.2566 + rng.uniform(0, 1):
            way = (-0.55, np.cos(turn), np.sin(turn))
            parts.append(_limb(rng, (-0.47, 0, thick), way, rng.uniform(0.07, 0.12), 0.55 * thick,
                               0.16 * thick, min(detail + 1, 2), 0.3))  # fmt: skip
    return _bedded(join(parts), "log")


def branch(rng: np.random.Generator, detail: int) -> Mesh:
    """A bent stick with a fork or two."""
    thick = rng.uniform(0.020, 0.034)
    parts = [_limb(rng, (-0.5, 0, 0), (1, 0, 0), 1.0, thick, 0.35 * thick, detail, 0.28, lying=True)]
    for sign in (1, -1)[: int(rng.integers(1, 3))]:
        at = rng.uniform(-0.25, 0.2)
        way = (1, sign * rng.uniform(0.4, 0.9), rng.uniform(0.05, 0.35))
        if detail < 2:
            parts.append(_limb(rng, (at, 0, 0.5 * thick), way, rng.uniform(0.2, 0.4), 0.55 * thick, 0.18 * thick,
                               min(detail + 1, 2), 0.25))  # fmt: skip
    return _bedded(join(parts), "branch")


# Grass


def tuft(
    rng: np.random.Generator, detail: int, blades: int, wide: float, spread: float, droop: float, width: float
) -> Mesh:
    """Blades from roots within `wide`; with less detail there are fewer, each as wide as those it stands for."""
    turn = np.arange(blades) * 2.399963 + rng.uniform(-0.5, 0.5, blades)  # the golden angle keeps them apart
    out = np.sqrt(rng.uniform(0, 1, blades))
    roots = wide * out[:, None] * np.stack([np.cos(turn), np.sin(turn)], 1)
    azimuth = turn + rng.uniform(-0.8, 0.8, blades)
    lean = spread * (0.25 * out + 0.75 * rng.uniform(0, 1, blades) ** 1.5)
    length = rng.uniform(0.55, 1.1, blades) * (1.05 - 0.25 * out)
    droops = droop * rng.uniform(0.25, 1.3, blades)
    keep, wider, steps = ((blades, 1.0, 4), (blades * 2 // 5, 2.1, 2), (max(blades // 5, 5), 3.6, 1))[detail]
    parts = []
    for i in range(keep):
        bent = lean[i] + (0.4 * droops[i] if steps == 1 else 0.0)
        parts.append(blade((*roots[i], -0.03), azimuth[i], bent, 0.0 if steps == 1 else droops[i], length[i],
                           width * wider, steps))  # fmt: skip
    return join(parts)


def dune_grass(rng: np.random.Generator, detail: int) -> Mesh:
    """Marram: upright, stiff, tips that arch over."""
    return tuft(rng, detail, 38, 0.24, 0.75, 1.25, 0.019)


def tussock(rng: np.random.Generator, detail: int) -> Mesh:
    """Short meadow grass, wide and bushy."""
    return tuft(rng, detail, 24, 0.75, 0.95, 0.9, 0.042)


MESHES: dict[str, Family] = {
    "rock": Family(rock, 5),
    "pebble": Family(pebble, 3, 2),
    "log": Family(log, 4),
    "branch": Family(branch, 3),
    "dune_grass": Family(dune_grass, 4),
    "tussock": Family(tussock, 4),
}
