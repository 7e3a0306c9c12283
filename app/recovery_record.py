"""One record of a recovery log: what tiles, settings, objects or grid are **after** a finished step (T08).

After-states can be applied twice without harm, so a log written across a save stays good. A record is a header in JSON,
then packed samples; a checksum tells a whole record from one that a kill cut short.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import BinaryIO

import numpy as np

from ..io.mesh_files import packed, unpacked
from ..level import Grid, Journal, Level, Settings
from ..level.atoms import Thing, Value, Whole, whole_state
from ..level.grid import NOWHERE
from ..level.journal import Step
from ..level.meshes import Mesh, names_in_use
from ..level.objects import OBJECT, Prop, Shot
from ..level.shots import SHAPE, skies_in_use, sky_of
from ..level.tiles import Tiles, pack, unpack

MAGIC = b"SWR1"
FRAME = struct.Struct("<4sIII")  # magic, header bytes, payload bytes, checksum of both
Tile = tuple[int, int]


@dataclass
class Ground:
    """A whole grid and base, for steps that replace them."""

    grid: Grid
    base: np.ndarray
    georeference: dict


@dataclass
class Change:
    """What a step left behind; tiles are copies `(rows, cols[, channels])`, None where never written."""

    label: str
    tiles: dict[str, dict[Tile, np.ndarray | None]] = field(default_factory=dict)
    settings: Settings | None = None
    objects: dict[str, object | None] = field(default_factory=dict)
    ground: Ground | None = None
    meshes: dict[str, Mesh] = field(default_factory=dict)  # that its props show, where the log hasn't got them yet
    skies: dict[str, np.ndarray] = field(default_factory=dict)  # likewise of its shots
    labels: list[str] = field(default_factory=list)  # of the steps that were folded into this one

    def outdone_by(self, later: Change) -> bool:
        """Whether a later change says all that this one says, as in the drag of a slider or an object."""
        bare = not (self.tiles or self.ground or later.tiles or later.ground)
        settings = later.settings is not None or self.settings is None
        return bare and settings and self.objects.keys() == later.objects.keys()


def change_of(level: Level, step: Step, known: Iterable[str] = ()) -> Change:
    """The after-state of what a step swapped, copied for a worker to pack; without `known` meshes and skies."""
    change = Change(step.label)
    for atom in step.atoms:
        if isinstance(atom, Tiles):
            here = change.tiles.setdefault(atom.layer, {})
            here.update({tile: level.layers[atom.layer].tile(tile) for tile in atom.held})
        elif isinstance(atom, Value):
            change.settings = level.settings
        elif isinstance(atom, Thing):
            change.objects[atom.name] = level.objects.get(atom.name)
        elif isinstance(atom, Whole):
            change.ground = Ground(level.grid, level.layers["height"].base, dict(level.georeference))
            change.tiles = all_tiles(level)
    shown = {thing.mesh for thing in change.objects.values() if isinstance(thing, Prop)} - set(known)
    change.meshes = {name: level.meshes[name] for name in shown & level.meshes.keys()}
    shown = {thing.map for thing in change.objects.values() if isinstance(thing, Shot)} - set(known)
    change.skies = {name: level.skies[name] for name in shown & level.skies.keys()}
    return change


def everything(level: Level, label: str) -> Change:
    """A whole level, for one that no folder holds yet."""
    ground = Ground(level.grid, level.layers["height"].base, dict(level.georeference))
    meshes = {name: level.meshes[name] for name in names_in_use(level) & level.meshes.keys()}
    skies = {name: level.skies[name] for name in skies_in_use(level) & level.skies.keys()}
    return Change(label, all_tiles(level), level.settings, dict(level.objects), ground, meshes, skies)


def all_tiles(level: Level) -> dict[str, dict[Tile, np.ndarray | None]]:
    return {
        name: {tile: data.tile(tile) for tile in map(tuple, np.argwhere(data.written).tolist())}
        for name, data in level.layers.items()
        if not data.neutral
    }


def fold(changes: Iterable[Change]) -> Change:
    """Many changes as one: the newest state of everything; a new ground forgets the tiles before it."""
    whole = Change("")
    for change in changes:
        whole.labels += change.labels or [change.label]
        if change.ground:
            whole.ground, whole.tiles = change.ground, {}
        for layer, tiles in change.tiles.items():
            whole.tiles.setdefault(layer, {}).update(tiles)
        whole.settings = change.settings or whole.settings
        whole.objects.update(change.objects)
        whole.meshes.update(change.meshes)
        whole.skies.update(change.skies)
    count = len(whole.labels)
    whole.label = f"Recover {count} step{'s' if count != 1 else ''}"
    return whole


def apply(level: Level, journal: Journal, change: Change) -> None:
    """Put a change into a level as one step that can be undone."""
    with journal.step(change.label) as step:
        if change.ground:
            step.atoms.append(Whole(whole_state(level)))
            level.reset(change.ground.grid, change.ground.base)
            level.georeference = dict(change.ground.georeference)
        for layer, tiles in change.tiles.items():
            rect = NOWHERE
            for tile in tiles:
                rect = rect.union(level.layers[layer].grid.tile_rect(tile))
            held = {tile: None if values is None else pack(values) for tile, values in tiles.items()}
            _swap(step, Tiles(layer, held, rect), level, keep=change.ground is None)
        for name, mesh in change.meshes.items():
            level.put_mesh(name, mesh)
        for name, sky in change.skies.items():
            level.put_sky(name, sky)
        for name, thing in change.objects.items():
            _swap(step, Thing(name, thing), level)
        if change.settings:
            _swap(step, Value(change.settings), level)


def _swap(step: Step, atom, level: Level, keep: bool = True) -> None:
    atom.swap(level)
    if keep:  # tiles under a new ground go and come with it
        step.atoms.append(atom)


# Bytes


def encode(change: Change) -> bytes:
    """A record, packed without loss."""
    blobs: list[bytes] = []

    def blob(values: np.ndarray | None) -> int:
        if values is None:
            return -1
        blobs.append(pack(values))
        return len(blobs[-1])

    header: dict = {"kind": "step", "label": change.label, "labels": change.labels}
    if change.ground:
        grid = change.ground.grid
        header["ground"] = {
            "grid": [grid.rows, grid.cols, grid.cell_m],
            "georeference": change.ground.georeference,
            "bytes": blob(change.ground.base),
        }
    header["tiles"] = {
        layer: [
            [*tile, list(values.shape) if values is not None else [], blob(values)] for tile, values in tiles.items()
        ]
        for layer, tiles in change.tiles.items()
    }
    if change.settings:
        header["settings"] = change.settings.model_dump(mode="json")
    header["objects"] = {
        name: thing if thing is None else thing.model_dump(mode="json") for name, thing in change.objects.items()
    }
    if change.meshes:
        header["meshes"] = {name: _add(blobs, packed(mesh)) for name, mesh in change.meshes.items()}
    if change.skies:
        header["skies"] = {name: blob(sky) for name, sky in change.skies.items()}
    return framed(header, b"".join(blobs))


def _add(blobs: list[bytes], data: bytes) -> int:
    blobs.append(data)
    return len(data)


def framed(header: dict, payload: bytes = b"") -> bytes:
    text = json.dumps(header).encode()
    check = zlib.crc32(payload, zlib.crc32(text))
    return FRAME.pack(MAGIC, len(text), len(payload), check) + text + payload


def read(file: BinaryIO) -> tuple[dict, bytes] | None:
    """The next (header, payload) of a log; None at its end or where a record was cut short."""
    start = file.read(FRAME.size)
    if len(start) < FRAME.size:
        return None
    magic, header_bytes, payload_bytes, check = FRAME.unpack(start)
    text, payload = file.read(header_bytes), file.read(payload_bytes)
    if magic != MAGIC or len(text) < header_bytes or len(payload) < payload_bytes:
        return None
    if zlib.crc32(payload, zlib.crc32(text)) != check:
        return None
    return json.loads(text), payload


def decode(header: dict, payload: bytes) -> Change:
    """The change in a record whose header says kind = step."""
    at = 0

    def take(size: int, shape) -> np.ndarray | None:
        nonlocal at
        if size < 0:
            return None
        at += size
        return unpack(payload[at - size : at], tuple(shape))

    change = Change(header["label"], labels=header.get("labels", []))
    if "ground" in header:
        ground = header["ground"]
        grid = Grid(*ground["grid"])
        change.ground = Ground(grid, take(ground["bytes"], grid.shape), ground["georeference"])
    for layer, rows in header["tiles"].items():
        change.tiles[layer] = {(row, col): take(size, shape) for row, col, shape, size in rows}
    if "settings" in header:
        change.settings = Settings.model_validate(header["settings"])
    for name, thing in header["objects"].items():
        change.objects[name] = None if thing is None else OBJECT.validate_python(thing)
    for name, size in header.get("meshes", {}).items():
        change.meshes[name] = unpacked(payload[at : at + size])
        at += size
    for name, size in header.get("skies", {}).items():
        change.skies[name] = sky_of(take(size, SHAPE))
    return change
