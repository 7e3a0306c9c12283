"""Which scattered things a picture or a shadow map needs (L09): gathered from tiles, thinned, culled, sent on change.

Gathering is NumPy over the tiles in reach; what comes out is one array a mesh, kept on the GPU until camera, level or
tier change. Everything an instance needs is camera-relative, worked out in float64.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..level import Level
from ..level.scatter import EMPTY, TILE_M, Tiles, scatter_tiles, sync, tile_ranges, tiles_within
from ..level.scatter_kinds import SCATTER, Kind
from ..level.scatter_meshes import MESHES, mesh
from .quality import Tier

FADE = 0.2  # last part of its distance over which a thing shrinks away
SPAN_M = 6.0  # so far at least a thing reaches past its tile
LEAST_PX = 0.9  # smaller ones are left out
MOST_SMALL_M = 240.0  # what lies close together is drawn no farther off: tiles of it take milliseconds each to make
DETAIL_PX = {
    "rock": (50, 12),
    "grass": (58, 22),
    "driftwood": (140, 40),
}  # up to which a mesh is the next coarser
FLOATS = 12  # an instance: foot xyz, scale; cos and sin of yaw, normal xy; tint, open, phase, size in metres
CONTACT_FLOATS = 10  # foot xyz, radius; cos and sin of yaw, half length, darkness; normal xy


@dataclass(frozen=True)
class Eye:
    """From where: position (3,), planes (n, 4) over relative points or None, radians a pixel (0: no limit of size)."""

    position: np.ndarray
    planes: np.ndarray | None
    pixel: float


Groups = dict[tuple[str, int, int], np.ndarray]  # (kind, variant, detail) → float32 (n, FLOATS)


def reach_m(level: Level, kind: Kind, tier: Tier) -> float:
    """How far off the largest of a kind is drawn."""
    far = level.settings.scatter.distance_m * tier.scatter_reach
    return (min(far, MOST_SMALL_M) if kind.spacing_m < 2.0 else far) * kind.reach


def gather(level: Level, eye: Eye, tier: Tier, reached: dict[str, float] | None = None) -> Groups:
    """What is seen from `eye`, by kind, variant and detail; `reached` takes the place of the kinds' distances."""
    groups: Groups = {}
    for name, kind in SCATTER.items():
        far = reach_m(level, kind, tier) if reached is None else reached.get(name, 0.0)
        # none of the kind is large enough to be seen farther off
        seen_m = kind.size_m[1] * level.settings.scatter.size / (eye.pixel * LEAST_PX) if eye.pixel else far
        found = near(level, name, eye, min(far, seen_m))
        found = found[found["rank"] < tier.scatter_share] if kind.channel == "grass" else found
        if len(found):
            _group(groups, kind, found, eye, far)
    return groups


def near(level: Level, name: str, eye: Eye, far: float) -> np.ndarray:
    """Instances of the tiles within a distance."""
    x, y = eye.position[:2]
    tiles = tiles_within(level, x - far, y - far, x + far, y + far)
    middles = (np.array(tiles, np.float64).reshape(-1, 2) + 0.5) * TILE_M
    away = np.linalg.norm(np.maximum(np.abs(middles - (x, y)) - TILE_M / 2, 0), axis=1)
    tiles = [tile for tile, off in zip(tiles, away, strict=True) if off < far]
    if eye.planes is not None and tiles:
        kind = SCATTER[name]
        span = max(_wide(kind) * kind.size_m[1] * level.settings.scatter.size, SPAN_M)
        tiles = [tile for tile, seen in zip(tiles, _tiles_seen(level, tiles, eye, span), strict=True) if seen]
    return np.concatenate([EMPTY, *scatter_tiles(level, name, tiles).values()])


def _wide(kind: Kind) -> float:
    """How far a thing and its dark foot reach from where it stands, in its size."""
    return max(1.3, kind.contact_m[0])


def _tiles_seen(level: Level, tiles: list[tuple[int, int]], eye: Eye, span: float) -> np.ndarray:
    """Which tiles have a part, from the deepest to the highest ground and what stands on it, inside every plane."""
    corner, heights = np.array(tiles, np.float64) * TILE_M, tile_ranges(level, tiles)
    low = np.column_stack([corner, heights[:, 0]]) - span - eye.position
    high = np.column_stack([corner + TILE_M, heights[:, 1]]) + span - eye.position
    normals = eye.planes[:, None, :3]
    with np.errstate(invalid="ignore"):  # a tile without ground
        farthest = np.maximum(normals * low, normals * high).sum(axis=2)
    return (farthest + eye.planes[:, 3:] >= 0).all(axis=0)


def _group(groups: Groups, kind: Kind, found: np.ndarray, eye: Eye, far: float) -> None:
    place = np.stack([found["x"], found["y"], found["z"]], 1).astype(np.float64) - eye.position
    away = np.sqrt((place**2).sum(axis=1))
    scale = found["scale"].astype(np.float64)
    # each has a distance of its own: large ones stay longest, so that they thin out and don't end at a line
    own = far * np.clip(0.35 + 0.4 * scale / kind.size_m[1] + 0.25 * (1 - found["rank"]), 0, 1)
    if eye.pixel:
        own = np.minimum(own, scale / (eye.pixel * LEAST_PX))
        scale = scale * np.clip((own - away) / (FADE * own), 0, 1)
    seen = away < own if eye.pixel else away < far
    if eye.planes is not None:
        seen &= (place @ eye.planes[:, :3].T + eye.planes[:, 3] >= -_wide(kind) * scale[:, None]).all(axis=1)
    place, away, scale, found = place[seen], away[seen], scale[seen], found[seen]
    rows = np.stack([*place.T, scale, np.cos(found["yaw"]), np.sin(found["yaw"]), found["normal_x"], found["normal_y"],
                     found["tint"], found["open"], found["rank"], found["scale"]], 1).astype(np.float32)  # fmt: skip
    detail = _detail(kind, found["scale"] / np.maximum(away * eye.pixel, 1e-9), eye)
    code = found["variant"].astype(int) * 8 + detail
    for value in np.unique(code):
        groups[kind.name, int(value) // 8, int(value) % 8] = rows[code == value]


def _detail(kind: Kind, pixels: np.ndarray, eye: Eye) -> np.ndarray:
    last = MESHES[kind.mesh].details - 1
    if not eye.pixel:  # a shadow map: a log of four sides would leave a slit of light under a round one
        return np.full(len(pixels), 0 if kind.name == "log" else last)
    edges = DETAIL_PX["rock" if kind.channel == "rocks" else kind.channel]
    return np.minimum(sum((pixels < edge).astype(int) for edge in edges), last)


def contacts(groups: Groups, eye: Eye, tier: Tier) -> np.ndarray:
    """Dark feet of what is near enough to show one, float32 `(n, CONTACT_FLOATS)`."""
    parts = [np.empty((0, CONTACT_FLOATS), np.float32)]
    for (name, _, _), rows in groups.items():
        kind = SCATTER[name]
        radius = kind.contact_m[0] * rows[:, 3]
        long = kind.along_contour
        pixels = radius / np.maximum(np.linalg.norm(rows[:, :3], axis=1) * eye.pixel, 1e-9)
        least_px = 10.0 if kind.channel == "grass" else 2.0
        kept = pixels > least_px * (1.0 if tier.scatter_share == 1.0 else 1.5)
        # coming in gently where it is just large enough
        dark = kind.contact_m[1] * np.clip(pixels / least_px - 1, 0, 1)
        half = 0.44 * rows[:, 3] if long else np.zeros(len(rows))
        parts.append(np.column_stack([rows[:, :3], radius, rows[:, 4:6], half, dark, rows[:, 6:8]])[kept])
    return np.concatenate(parts).astype(np.float32)


class Meshes:
    """Vertex and index buffers of every mesh in use."""

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.held: dict[tuple[str, int, int], tuple] = {}

    def get(self, family: str, variant: int, detail: int) -> tuple:
        """(vertices, indices, triangles) of a mesh."""
        key = family, variant, detail
        if key not in self.held:
            made = mesh(*key)
            packed = np.column_stack([made.vertices, made.normals, made.sway]).astype(np.float32)
            self.held[key] = (self.ctx.buffer(packed.tobytes()), self.ctx.buffer(made.indices.astype("i4").tobytes()),
                              len(made.indices))  # fmt: skip
        return self.held[key]

    def release(self) -> None:
        for vertices, indices, _ in self.held.values():
            vertices.release()
            indices.release()
        self.held.clear()


class Batch:
    """Groups on the GPU, one buffer each; `key` says what they were gathered for."""

    def __init__(self, ctx, meshes: Meshes) -> None:
        self.ctx = ctx
        self.meshes = meshes
        self.key: tuple | None = None
        self.source: Tiles | None = None
        self.counts: dict[tuple[str, int, int], int] = {}
        self.buffers: dict[tuple[str, int, int], object] = {}
        self.arrays: dict[tuple, object] = {}

    def fresh(self, level: Level, *key) -> bool:
        """Whether what is held was gathered for this level as it is, and this key."""
        tiles = sync(level)
        return self.source is tiles and self.key == (tiles.changes, *key)

    def fill(self, level: Level, groups: Groups, *key) -> int:
        """Send groups; returns the bytes."""
        self.source, self.counts = sync(level), {}
        for name, rows in groups.items():
            if name not in self.buffers:
                self.buffers[name] = self.ctx.buffer(reserve=max(rows.nbytes, 4 * FLOATS), dynamic=True)
            buffer = self.buffers[name]
            if rows.nbytes > buffer.size:
                buffer.orphan(2 * rows.nbytes)
            buffer.write(np.ascontiguousarray(rows).tobytes())
            self.counts[name] = len(rows)
        self.key = self.source.changes, *key
        return sum(rows.nbytes for rows in groups.values())

    def draw(self, shaders) -> tuple[int, int]:
        """Draw all with `shaders(kind)`, a Shader or None to leave a kind out; returns triangles and instances."""
        triangles = instances = 0
        for group, count in self.counts.items():
            shader = shaders(SCATTER[group[0]]) if count else None
            if shader is None:
                continue
            vertices, indices, size = self.meshes.get(SCATTER[group[0]].mesh, *group[1:])
            key = (group, id(shader), shader.generation)
            if key not in self.arrays:
                content = [
                    (vertices, *used(shader, "3f4 3f4 1f4", ("in_position", "in_normal", "in_sway"))),
                    (self.buffers[group], *used(shader, "4f4 4f4 4f4/i", ("in_place", "in_turn", "in_look"))),
                ]
                self.arrays[key] = self.ctx.vertex_array(shader.program, content, indices, index_element_size=4)
            self.arrays[key].render(instances=count)
            triangles, instances = triangles + size * count, instances + count
        return triangles, instances

    def release(self) -> None:
        for thing in (*self.arrays.values(), *self.buffers.values()):
            thing.release()
        self.arrays.clear()
        self.buffers.clear()


def used(shader, layout: str, names: tuple[str, ...]) -> tuple[str, ...]:
    """A buffer's layout with those attributes passed over that the compiler removed."""
    formats, _, rate = layout.partition("/")
    kept, shown = [], []
    for form, name in zip(formats.split(), names, strict=True):
        if name in shader.program:
            kept.append(form)
            shown.append(name)
        else:
            kept.append(f"{4 * int(form[0])}x")
    return " ".join(kept) + ("/" + rate if rate else ""), *shown
