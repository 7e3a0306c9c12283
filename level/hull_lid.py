"""What keeps the sea out of open hulls (D12): a flat lid inside the hull, over its water line, under its rim.

The drawn sea knows no boats: it would run through a hull where a wave is higher than the floor. Seen from above,
whoever looks through the lid looks into the hull, so the sea need not be drawn behind it.
"""

from __future__ import annotations

import functools

import numpy as np

from .meshes import Mesh

LEVELS = (0.1, 0.2, 0.3, 0.4, 0.5)  # heights tried, in the freeboard
WHOLE = 0.9  # share of the largest section that the highest one taken has to have: not the tower of a buoy
INSIDE = 0.985  # of the section, so that the lid ends within the planks


@functools.lru_cache(maxsize=64)
def lid(mesh: Mesh, line_m: float) -> Mesh | None:
    """The lid of a mesh whose water line is `line_m` over its origin; None where nothing stands over the water."""
    top = float(mesh.box[1, 2])
    sections = [section(mesh, line_m + part * (top - line_m)) for part in LEVELS] if top > line_m else []
    sections = [found for found in sections if found is not None]
    if not sections:
        return None
    areas = [area(outline) for outline in sections]
    outline = [found for found, size in zip(sections, areas, strict=True) if size >= WHOLE * max(areas)][-1]
    middle = outline.mean(axis=0)
    corners = (middle + INSIDE * (outline - middle) * (1, 1, 0)).astype(np.float32)
    count = len(corners)
    fan = np.column_stack([np.zeros(count - 2), np.arange(1, count - 1), np.arange(2, count)]).astype(np.int32)
    up = np.tile(np.float32([0, 0, 1]), (count, 1))
    return Mesh(corners, up, np.zeros_like(corners), fan)


def section(mesh: Mesh, height_m: float) -> np.ndarray | None:
    """Convex outline `(k, 3)`, anticlockwise from above, of where a level plane cuts a mesh; None where it does not."""
    from scipy.spatial import ConvexHull, QhullError

    ends = mesh.vertices[mesh.triangles].astype(np.float64)
    points = []
    for a, b in ((0, 1), (1, 2), (2, 0)):
        low, high = ends[:, a, 2] - height_m, ends[:, b, 2] - height_m
        cut = low * high < 0
        share = (low[cut] / (low[cut] - high[cut]))[:, None]
        points.append(ends[cut, a, :2] + share * (ends[cut, b, :2] - ends[cut, a, :2]))
    points = np.concatenate(points)
    try:
        outline = points[ConvexHull(points).vertices]
    except (QhullError, ValueError):
        return None
    return np.column_stack([outline, np.full(len(outline), height_m)])


def area(outline: np.ndarray) -> float:
    """Of an outline seen from above, m²."""
    x, y = outline[:, 0], outline[:, 1]
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))
