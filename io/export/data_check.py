"""Check the data files of an export: by their models, ranges included, among each other, and against the manifest."""

from __future__ import annotations

import json
from pathlib import Path

from pydantic import ValidationError

from ... import __version__
from .data_files import SUFFIX
from .data_models import DataFile, text_of
from .data_rows import DATA, SCHEMA
from .data_schema import DIALECT, MANIFEST, schema_text
from .records import FileRecord, Manifest


def check_data(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about them; files that are missing or changed were reported before this."""
    findings: list[str] = []
    read: dict[str, tuple[FileRecord, DataFile]] = {}
    for record in manifest.files:
        if record.name not in whole or record.map not in (*DATA, SCHEMA):
            continue
        if record.name.endswith(SUFFIX):
            findings += _check_schema(manifest, record, whole[record.name])
        else:
            file, found = _read(record, whole[record.name])
            findings += found
            if file is not None:
                read[record.map] = record, file
    others = {name: file for name, (_, file) in read.items()}
    for name, (record, file) in read.items():
        found = [] if file.schema_file in whole else ["its schema is not beside it"]
        found += [] if file.level == manifest.source.name else [f"it is of another level, {file.level!r}"]
        findings += [f"{record.name}: {told}" for told in found + DATA[name].check(file, others, manifest)]
    return findings


def _read(record: FileRecord, path: Path) -> tuple[DataFile | None, list[str]]:
    text = path.read_bytes()
    try:
        file = DATA[record.map].model.model_validate_json(text)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"])) or "all of it"
        return None, [f"{record.name} does not fit its schema: {place}: {first['msg'][0].lower()}{first['msg'][1:]}"]
    if text_of(file).encode() != text:
        return None, [f"{record.name} lacks values or is written otherwise than an export writes"]
    return file, []


def _check_schema(manifest: Manifest, record: FileRecord, path: Path) -> list[str]:
    """That it is one, and, where this very version wrote it, the one that is published."""
    try:
        dialect = json.loads(path.read_text("utf-8"))["$schema"]
    except (ValueError, TypeError, KeyError, RecursionError):
        dialect = None
    if dialect != DIALECT:
        return [f"{record.name} is no JSON Schema of draft 2020-12"]
    name = MANIFEST if record.map == SCHEMA else record.map
    if manifest.tool.version == __version__ and path.read_text("utf-8") != schema_text(name):
        return [f"{record.name} is not the schema of {name}"]
    return []
