"""What every target writes beside its ground and current: maps, meshes, data, the runtime kit."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from . import data_rows, map_rows, mesh_rows
from .data_check import check_data
from .data_files import data_line, write_data
from .earlier import Piece
from .job import Job
from .kit import files as kit
from .kit.verify import check_kit
from .map_files import MapStyle, map_line, write_maps
from .mesh_files import mesh_line, write_meshes
from .records import FileRecord, Manifest
from .verify_map_files import check_maps
from .verify_mesh_files import check_meshes

DATA = (*data_rows.DATA, data_rows.SCHEMA)
NAMES = frozenset([*map_rows.MAPS, *mesh_rows.MESHES, *DATA, kit.NAME])
GROUPS = {"maps": tuple(map_rows.MAPS), "meshes": tuple(mesh_rows.MESHES), "data": DATA}  # `only` takes these too


def told() -> tuple[tuple[str, str], ...]:
    """(name, sentence) of each, for a target's list of what it writes."""
    return (*map_rows.told(), *mesh_rows.told(), *data_rows.told(), kit.MAP)


def write_common(job: Job, style: MapStyle, languages: Iterable[str]) -> Piece:
    """All of it that was chosen, the kit in `languages`."""
    made = write_maps(job, style)
    code = job.piece(kit.NAME, lambda: Piece(kit.write_kit(job, languages)))
    made.files = [*made.files, *write_meshes(job, style.meshes).files, *write_data(job).files, *code.files]
    return made


def lines(files: list[FileRecord], textures: str = "") -> list[str]:
    """How each of such files is read, others none; before them `textures`, how pictures are imported, if any is."""
    tellers = dict.fromkeys(map_rows.MAPS, map_line)
    tellers |= dict.fromkeys(mesh_rows.MESHES, mesh_line) | dict.fromkeys(DATA, data_line) | {kit.NAME: kit.kit_line}
    told = [tellers[file.map](file) for file in files if file.map in tellers]
    return [textures, *told] if textures and any(file.width for file in files) else told


def check_common(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about all of it."""
    checks = (check_maps, check_meshes, check_data, check_kit)
    return [finding for check in checks for finding in check(manifest, whole)]
