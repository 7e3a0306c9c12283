"""A clinker rowing boat and a channel buoy, made by code: meshes that float in the sample levels (D12).

Bow along +y, z up from the lowest point, metres. Solid parts are built from quads; joining and normals are the level's.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shorewright.level import Level
from shorewright.level.meshes import Mesh, content_name, made_of
from shorewright.level.objects import Prop

WHITE, RED, DARK = (0.60, 0.58, 0.52), (0.26, 0.04, 0.025), (0.05, 0.046, 0.042)
BLUE, OAK, PINE = (0.035, 0.095, 0.14), (0.15, 0.088, 0.046), (0.27, 0.185, 0.11)
STRAKES, STATIONS, LAP_M, THICK_M = 7, 25, 0.016, 0.022
STEP_M = 1 / 4096  # places are whole multiples of it: the same mesh on every machine
HALF_M, BOTTOM = 2.1, 3  # half the boat's length; strakes painted as its bottom


class Solid:
    """Closed bodies with a colour a face."""

    def __init__(self) -> None:
        self.corners: list[np.ndarray] = []
        self.colours: list[np.ndarray] = []

    def rings(self, rings, colour) -> None:
        """A body through rings of points `(rows, k, 3)`, its ends closed by fans, turned so that its outside shows.

        Colours are one, or one for each quad between two rings, `(rows − 1 or 1, k or 1, 3)`.
        """
        p = np.asarray(rings, float)
        paint = np.broadcast_to(np.asarray(colour, float), (len(p) - 1, p.shape[1], 3))
        nxt = np.roll(p, -1, 1)
        a, b, c, d = p[:-1], p[1:], nxt[1:], nxt[:-1]
        corners = [np.stack(quad, 2).reshape(-1, 3, 3) for quad in ((a, b, c), (a, c, d))]
        colours = [paint.reshape(-1, 3)] * 2
        for end, way in ((0, 1), (-1, -1)):
            middle = np.broadcast_to(p[end].mean(axis=0), p[end].shape)
            corners.append(np.stack([middle, p[end], nxt[end]][::way], 1))
            colours.append(paint[end])
        corners = np.concatenate(corners)
        inside_out = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) < 0
        self.corners.append(corners[:, ::-1] if inside_out else corners)
        self.colours.append(np.repeat(np.concatenate(colours)[:, None], 3, axis=1))

    def box(self, low, high, colour) -> None:
        """An upright box."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        ring = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
        self.rings([[(x, y, z) for x, y in ring] for z in (z0, z1)], colour)

    def bar(self, start, end, radii: tuple[float, float], colour, sides: int = 8) -> None:
        """A round bar between two points."""
        start, end = np.asarray(start, float), np.asarray(end, float)
        way = (end - start) / np.linalg.norm(end - start)
        side = np.cross(way, (0.0, 0.0, 1.0) if abs(way[2]) < 0.9 else (1.0, 0.0, 0.0))
        side /= np.linalg.norm(side)
        turn = np.arange(sides) * 2 * np.pi / sides
        round_it = np.outer(np.cos(turn), side) + np.outer(np.sin(turn), np.cross(way, side))
        self.rings([at + radius * round_it for at, radius in zip((start, end), radii)], colour)

    def mesh(self) -> Mesh:
        """What was added, as one mesh."""
        corners = np.round(np.concatenate(self.corners) / STEP_M) * STEP_M
        return made_of(corners, np.concatenate(self.colours))


# The boat


def beam(t):
    """Half the breadth at the sheer, 0 stern … 1 bow."""
    return np.interp(t, *np.array([(0, 0.50), (0.15, 0.63), (0.3, 0.715), (0.45, 0.745), (0.6, 0.71), (0.74, 0.58),
                                   (0.86, 0.37), (0.94, 0.18), (1, 0.03)]).T)  # fmt: skip


def sheer(t):
    """Height of the upper edge."""
    return 0.53 + 0.20 * np.clip((t - 0.4) / 0.6, 0, 1) ** 2 + 0.09 * np.clip((0.4 - t) / 0.4, 0, 1) ** 2


def keel(t):
    """Height of the bottom's middle: it rises to both ends."""
    return 0.05 + 0.16 * np.clip((t - 0.82) / 0.18, 0, 1) ** 2 + 0.10 * np.clip((0.3 - t) / 0.3, 0, 1) ** 2


def section(t, u, inward: float = 0.0):
    """Points `(…, 3)` of the starboard side: t along the boat, u from keel 0 to sheer 1, moved in by metres."""
    t, u = np.broadcast_arrays(np.asarray(t, float), np.asarray(u, float))
    fine = np.clip((t - 0.55) / 0.45, 0, 1)  # the bow is a V, the middle round
    x = beam(t) * np.sin(u * np.pi / 2) ** (0.72 + 0.45 * fine)
    rise = (1 - np.cos(u * np.pi / 2)) ** (0.95 - 0.25 * fine)
    z = keel(t) + (sheer(t) - keel(t)) * rise
    x_in = np.maximum(x - inward * np.sin(u * np.pi / 2) ** 0.5, np.minimum(x, 0.004))
    z = z + inward * np.cos(u * np.pi / 2)
    raked = 0.30 * t**8 * (rise - 1) - 0.10 * (1 - t) ** 8 * rise
    return np.stack([x_in, HALF_M * (2 * t - 1) + raked, z], -1)


def mirrored(points):
    return np.asarray(points) * (-1, 1, 1)


def inside_at(t: float, z: float) -> float:
    """Half the inner breadth at a height."""
    side = section(t, np.linspace(0, 1, 60), THICK_M)
    return float(np.interp(z, side[:, 2], side[:, 0]))


def hull(solid: Solid) -> None:
    """Planks that overlap outside, smooth inside; each side a closed shell."""
    t = np.linspace(0, 1, STATIONS) ** 0.9
    edges = np.linspace(0, 1, STRAKES + 1) ** 0.9
    outer, inner, paint = [], [], []
    for low, high in pairwise(edges):
        outer += [section(t, low, -LAP_M if low > 0 else 0.0), section(t, high)]
        inner += [section(t, low, THICK_M), section(t, high, THICK_M)]
        paint += [WHITE, DARK]  # a plank, the edge of the next one
    rings = np.stack(outer + inner[::-1], 1)
    colours = np.broadcast_to(np.array(OAK), (STATIONS - 1, rings.shape[1], 3)).copy()
    colours[:, : len(paint) - 1] = paint[:-1]
    colours[:, len(paint) - 2] = BLUE
    colours[:, : 2 * BOTTOM - 1] = RED
    for side in (rings, mirrored(rings)):
        solid.rings(side, colours)


def rails(solid: Solid) -> None:
    """Gunwales, keel, stem and transom."""
    t = np.linspace(0, 0.985, STATIONS)
    top = section(t, np.ones_like(t))
    square = [(-0.035, -0.045), (0.022, -0.045), (0.022, 0.012), (-0.035, 0.012)]
    for side in (1, -1):
        rings = np.stack([top + np.array([x, 0, z]) for x, z in square], 1)
        rings[..., 0] = np.maximum(rings[..., 0], 0.0)
        solid.rings(rings if side > 0 else mirrored(rings), OAK)
    t = np.linspace(0, 1, STATIONS)
    under = section(t, np.zeros_like(t))
    low = under[:, 2] - 0.05
    half = 0.018
    solid.rings(np.stack([np.stack([np.full_like(t, x), under[:, 1], z], -1) for x, z in
                          ((half, low), (half, under[:, 2] + 0.03), (-half, under[:, 2] + 0.03), (-half, low))], 1),
                RED)  # fmt: skip
    u = np.linspace(0, 1, 12)
    stem = section(np.ones_like(u), u)
    stem = np.concatenate([stem, stem[-1:] + np.array([0, 0.02, 0.07])])
    rings = [np.stack([np.full(len(stem), x), stem[:, 1] + y, stem[:, 2] - 0.01], -1) for x, y in
             ((0.032, -0.05), (0.02, 0.045), (-0.02, 0.045), (-0.032, -0.05))]  # fmt: skip
    solid.rings(np.stack(rings, 1), OAK)
    u = np.linspace(0, 1, 16)
    side = section(np.zeros_like(u), u, 0.004)
    board = np.concatenate([mirrored(side)[::-1], side[1:]])
    solid.rings(board + np.array([[[0, 0.005, 0]], [[0, 0.045, 0]]]), OAK)


def fittings(solid: Solid) -> None:
    """Frames, floor, thwarts, oars."""
    u = np.linspace(0.03, 0.97, 14)
    for at in np.linspace(0.1, 0.9, 9):
        ring = [section(at + off / (2 * HALF_M), u, THICK_M + deep - 0.004)
                for off, deep in ((-0.02, 0), (-0.02, 0.022), (0.02, 0.022), (0.02, 0))]  # fmt: skip
        ring = np.stack(ring, 1)
        for side in (1, -1):
            solid.rings(ring if side > 0 else mirrored(ring), np.array(OAK) * 1.1)
    t = np.linspace(0.1, 0.84, 17)
    floor_m = 0.235
    half = np.array([inside_at(value, floor_m) for value in t]) - 0.004
    y = HALF_M * (2 * t - 1)
    across = np.outer(half, np.linspace(-1, 1, 9))
    top = np.stack([across, np.repeat(y[:, None], 9, 1), np.full_like(across, floor_m)], -1)
    shades = np.concatenate([np.array(PINE) * (0.62 + 0.16 * (np.arange(8) % 2))[:, None], np.tile(OAK, (10, 1))])
    solid.rings(np.concatenate([top, (top - (0, 0, 0.02))[:, ::-1]], axis=1), shades[None])
    for at, wide in ((0.13, 0.34), (0.42, 0.24), (0.66, 0.22)):
        z = 0.40 + 0.06 * (at > 0.6)
        x = min(inside_at(at + off, z - 0.03) for off in (-0.03, 0.0, 0.03)) + 0.01
        y = HALF_M * (2 * at - 1)
        solid.box((-x, y - wide / 2, z - 0.03), (x, y + wide / 2, z), PINE)
    for side in (1, -1):
        solid.bar((side * 0.20, -1.35, 0.445), (side * 0.13, 1.05, 0.515), (0.024, 0.019), PINE)
        x, y = side * 0.225, -1.42
        solid.box((x - 0.075, y - 0.32, 0.436), (x + 0.075, y + 0.12, 0.452), WHITE)


def rowing_boat() -> Mesh:
    """4.2 m long, 1.5 m broad; it floats well at a density of 0.2."""
    solid = Solid()
    hull(solid)
    rails(solid)
    fittings(solid)
    return solid.mesh()


# The buoy


def turned(solid: Solid, profile, colours, sides: int = 28) -> None:
    """A body of revolution about z through (radius, height) points, a colour a step."""
    turn = np.arange(sides) * 2 * np.pi / sides
    rings = [[(r * np.cos(a), r * np.sin(a), z) for a in turn] for r, z in profile]
    solid.rings(rings, np.array(colours, float)[:, None])


def channel_buoy() -> Mesh:
    """A red lateral buoy 3.6 m tall with a tower and a can on top; it floats upright at a density of 0.36."""
    solid, weed, dull = Solid(), (0.035, 0.04, 0.02), np.array(RED) * 0.75
    profile = [(0.10, 0.0), (0.16, 0.05), (0.16, 0.50), (0.72, 0.78), (0.80, 0.86), (0.80, 1.22), (0.80, 1.36),
               (0.80, 1.56), (0.74, 1.64), (0.42, 1.70)]  # fmt: skip
    turned(solid, profile, [DARK, DARK, weed, weed, weed, dull, RED, RED, dull])
    for k in range(4):
        a = np.pi / 4 + k * np.pi / 2
        out = np.array([np.cos(a), np.sin(a), 0.0])
        solid.bar(0.52 * out + (0, 0, 1.62), 0.17 * out + (0, 0, 3.0), (0.03, 0.026), RED, 6)
        nxt = np.array([np.cos(a + np.pi / 2), np.sin(a + np.pi / 2), 0.0])
        for z in (2.05, 2.5):
            r = 0.52 - 0.35 * (z - 1.62) / 1.38
            solid.bar(r * out + (0, 0, z), r * nxt + (0, 0, z), (0.018, 0.018), RED, 5)
    turned(solid, [(0.27, 2.98), (0.27, 3.02), (0.27, 3.38), (0.27, 3.42)], [RED, RED, RED], 20)
    turned(solid, [(0.07, 3.41), (0.07, 3.52), (0.04, 3.60)], [WHITE, WHITE], 10)
    # an eye for the crane on each side
    for x in (-0.66, 0.66):
        solid.box((x - 0.03, -0.05, 1.60), (x + 0.03, 0.05, 1.74), DARK)
    return solid.mesh()


# Where they are in the cove: id, mesh, x, y, heading, share under water, heel
PLACES = (
    ("boat-moored", rowing_boat, 556, 393, 205, 0.23, 0.0),
    ("boat-beach", rowing_boat, 681.5, 399.5, 32, 0.23, 9.0),
    ("buoy", channel_buoy, 722, 292, 0, 0.36, 0.0),
)


def place(level: Level) -> None:
    """Give the cove its boats: one at a mooring before `play`, one on the sand beside `beach`, a buoy off the rocks."""
    names = {}
    for make in (rowing_boat, channel_buoy):
        mesh = make()
        names[make] = content_name(make.__name__, mesh)
        level.put_mesh(names[make], mesh)
    for name, make, x, y, yaw_deg, density, roll_deg in PLACES:
        prop = Prop(
            id=name, mesh=names[make], x=x, y=y, yaw_deg=yaw_deg, roll_deg=roll_deg, floats=True, density=density
        )
        level.put_object(name, prop)
