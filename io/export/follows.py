"""What a file of an export follows from, as one hash: the level's part of it, the request, and the code that makes it.

An export that finds the same hash in its folder keeps that file. The code is hashed file by file and not by its
version, or somebody who changes an exporter in a checkout would be shown the files of yesterday's.
"""

from __future__ import annotations

import hashlib
import json
from functools import lru_cache
from pathlib import Path

import numpy as np

from ...level import Level
from .manifest import layer_digest, source_sha256

ROOMS = ("level", "io")  # all that an exporter calls
CODE = (".py", ".glsl", ".gd", ".gdshader", ".tscn", ".godot")


def follows_sha256(level: Level, asked: list[str], layers: tuple[str, ...], known: dict[str, str]) -> str:
    """The hash of `asked`, the code, and these layers with the grid and the sea's level; () takes the whole level.

    `known` keeps the hashes of layers from one map to the next.
    """
    parts = [code_sha256(), *asked]
    if layers:
        parts.append(repr((level.grid.shape, level.grid.cell_m, level.sea_level_m)))
    for name in layers or ("",):
        if name not in known:
            known[name] = _layer(level, name) if name else source_sha256(level)
        parts.append(known[name])
    return hashlib.sha256(json.dumps(parts).encode()).hexdigest()


def _layer(level: Level, name: str) -> str:
    digest = hashlib.sha256()
    layer_digest(level, name, digest)
    return digest.hexdigest()


def code_files() -> list[Path]:
    """The files that decide what is written: modules, shaders that the kit is made from, scripts that are handed on."""
    home = Path(__file__).parents[2]
    return sorted(path for room in ROOMS for path in (home / room).rglob("*") if path.suffix in CODE)


@lru_cache(1)
def code_sha256() -> str:
    """A hash of those, and of the array library's version."""
    home = Path(__file__).parents[2]
    digest = hashlib.sha256(np.__version__.encode())
    for path in code_files():
        digest.update(path.relative_to(home).as_posix().encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()
