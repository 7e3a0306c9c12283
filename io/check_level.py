"""`check`: is what lies on disk what was saved? A level folder here, an export by the exporters' own decoder."""

from __future__ import annotations

from pathlib import Path

from ..level import BadInput, Grid
from ..level.objects import Prop
from ..level.wave_lists import left_out
from . import level_json
from .level_sectors import check_sector, decode, file_hash
from .mesh_files import file_of, unpacked
from .package_read import HASHES, read_hashes
from .transaction import RECORD, STAGE, pending


def check(path: Path | str) -> list[str]:
    """Findings about a level or an export, one sentence each; [] when all is well. BadInput when it is neither."""
    path = Path(path)
    if (path / level_json.NAME).exists() or (path / STAGE / RECORD).exists():
        return check_level(path)
    from .export import check as check_export

    return check_export(path)


def check_level(path: Path) -> list[str]:
    """Every file of a level against its description and its hash; nothing is changed."""
    try:
        if pending(path) is not None:
            return [f"{path} has a save that was interrupted: opening it for editing finishes it"]
        if not (path / level_json.NAME).resolve().is_relative_to(path.resolve()):
            return [f"{path / level_json.NAME} is a link that leads out of the level"]
        manifest = level_json.parse(path / level_json.NAME, (path / level_json.NAME).read_bytes())
    except BadInput as error:
        return [str(error)]
    except OSError as error:
        return [f"{path / level_json.NAME} cannot be read: {error.strerror}"]
    grid = Grid(manifest.grid.rows, manifest.grid.cols, manifest.grid.cell_m)
    hashes = read_hashes(path / HASHES)
    findings = [] if hashes else [f"{path / HASHES} is missing or unreadable, so no file can be compared with its hash"]
    for name in manifest.layers:
        findings += _check_file(path, grid, name, hashes)
    known = set(manifest.layers)
    for file in sorted((path / "layers").glob("*.exr")):
        if file.stem not in known:
            findings.append(f"{file} belongs to no layer that level.json lists")
    for name in sorted({thing.mesh for thing in manifest.objects if isinstance(thing, Prop) and thing.mesh}):
        findings += _check_mesh(path, name)
    return findings + [f"{path / level_json.NAME}: {told}" for told in left_out(manifest.objects)]


def _check_mesh(path: Path, name: str) -> list[str]:
    file = path / file_of(name)
    try:
        if not file.resolve().is_relative_to(path.resolve()):
            return [f"{file} is a link that leads out of the level"]
        if not name.endswith(unpacked(file.read_bytes()).digest()[:8]):
            return [f"{file} is not what was last saved: its hash differs"]
    except (OSError, BadInput) as error:
        return [f"{file} cannot be used: {getattr(error, 'strerror', None) or error}"]
    return []


def _check_file(path: Path, grid: Grid, name: str, hashes: dict[str, str]) -> list[str]:
    file = path / "layers" / f"{name}.exr"
    try:
        if not file.resolve().is_relative_to(path.resolve()):
            return [f"{file} is a link that leads out of the level"]
        check_sector(file, grid, name)
        decode(file, grid, name)
    except BadInput as error:
        return [str(error)]
    if hashes and hashes.get(name) != file_hash(file):
        return [f"{file} is not what was last saved: its hash differs"]
    return []
