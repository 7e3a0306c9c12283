"""The manifest every export carries: what each file is, how to decode it, and how far off it was measured to be.

Each field answers a complaint that people have about terrain exports (research, authoring 4): flipped rows, unnamed
ranges, 65535 or 65536, sea level not at zero. It holds no date and no path, so the same level gives the same bytes.
The name is `NAME.shorewright.json`, never that of a `.r16`: Unreal takes `<same basename>.json` for its own sidecar.
"""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any

import numpy as np

from ...level import LAYERS, Level
from .records import FileRecord, Manifest, Source, Tool, Waves, World

SUFFIX = ".shorewright.json"
MAX_MANIFEST_BYTES = 8_000_000


def describe(level: Level, name: str, row_0: str, origin: str, axes: str) -> dict[str, Any]:
    """The parts of a manifest that follow from the level alone, as keyword arguments of `Manifest`."""
    rows, cols = level.grid.shape
    settings = level.settings
    return {
        "tool": Tool(commit=commit()),
        "source": Source(
            name=name,
            sha256=source_sha256(level),
            rows=rows,
            cols=cols,
            cell_m=level.grid.cell_m,
            georeference=level.georeference,
        ),
        "world": World(
            size_m=level.grid.extent_m,
            origin=origin,
            axes=axes,
            row_0=row_0,
            sea_level_m=level.sea_level_m,
            height_min_m=float(level.height.min()),
            height_max_m=float(level.height.max()),
        ),
        "waves": Waves(
            seed=settings.level.seed,
            sea=settings.sea.model_dump(mode="json"),
            shore=settings.shore.model_dump(mode="json"),
        ),
    }


def describe_file(path: Path, **fields: Any) -> FileRecord:
    """The record of a written file, hashed from the disk."""
    return FileRecord(name=path.name, size_bytes=path.stat().st_size, sha256=file_sha256(path), **fields)


def file_sha256(path: Path) -> str:
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def source_sha256(level: Level) -> str:
    """A hash of all a level holds: grid, settings, objects, and every tile of every layer that isn't all neutral."""
    digest = hashlib.sha256()
    texts = [repr((level.grid.shape, level.grid.cell_m)), json.dumps(level.georeference, sort_keys=True, default=str)]
    texts.append(level.settings.model_dump_json())
    texts += [level.objects[key].model_dump_json() for key in sorted(level.objects)]
    digest.update("\n".join(texts).encode())
    for name in LAYERS:
        layer_digest(level, name, digest)
    return digest.hexdigest()


def layer_digest(level: Level, name: str, digest) -> None:
    """Feed a hash with the tiles of a layer that aren't all neutral."""
    data = level.layers[name]
    for tile in data.grid.tiles(data.grid.rect):
        if name != "height" and not data.written[tile]:
            continue
        values = data.read(data.grid.tile_rect(tile)) + np.float32(0)  # -0 and 0 are one height
        if name == "height" or values.any():
            digest.update(f"{name} {tile[0]} {tile[1]}".encode())
            digest.update(np.ascontiguousarray(values, "<f4").data)


def commit() -> str | None:
    """The commit of the checkout this runs from; None when it was installed from a package."""
    git = Path(__file__).parents[2] / ".git"
    try:
        if git.is_file():  # a second work tree keeps its HEAD elsewhere
            git = (git.parent / git.read_text("utf-8").removeprefix("gitdir:").strip()).resolve()
        head = (git / "HEAD").read_text("utf-8").strip()
        if not head.startswith("ref:"):
            return head or None
        ref = head.removeprefix("ref:").strip()
        common = git / "commondir"
        shared = (git / common.read_text("utf-8").strip()).resolve() if common.is_file() else git
        if (shared / ref).is_file():
            return (shared / ref).read_text("utf-8").strip() or None
        packed = (shared / "packed-refs").read_text("utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return None
    return next((line.split()[0] for line in packed if line.endswith(f" {ref}")), None)


# Reading and writing


def signature(data: dict[str, Any]) -> str:
    """A hash of everything in a manifest but the hash itself, whatever its layout: it tells an edit from an export."""
    rest = {key: value for key, value in data.items() if key != "manifest_sha256"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def write(path: Path, manifest: Manifest) -> None:
    """The manifest as indented JSON with its own hash at the end."""
    data = manifest.model_dump(mode="json", by_alias=True)
    data["manifest_sha256"] = signature(data)
    text = json.dumps(data, indent=2, ensure_ascii=False, allow_nan=False)
    path.write_text(text + "\n", "utf-8", newline="\n")


def load(path: Path) -> tuple[Any, str | None]:
    """The JSON in a manifest, or None and a sentence why it cannot be read."""
    try:
        if path.stat().st_size > MAX_MANIFEST_BYTES:
            return None, f"{path.name} is larger than any manifest"
        return json.loads(path.read_text("utf-8"), parse_constant=_refuse), None
    except OSError as error:
        return None, f"{path.name} cannot be read: {error.strerror or error}"
    except (ValueError, RecursionError) as error:
        return None, f"{path.name} is not readable JSON: {error}"


def _refuse(word: str) -> None:
    raise ValueError(f"{word} is no number JSON knows")


def inside(name: str) -> bool:
    """True for a plain file name: nothing that could lead out of the folder on any system."""
    return bool(name) and name not in (".", "..") and not any(c in name for c in '/\\:*?"<>|\0') and name.isprintable()
