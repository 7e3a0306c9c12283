"""Data files of an export: written, read back, compared with the level; its schema beside each, named in `$schema`."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from ...level import BadInput
from .data_axes import Frame
from .data_models import text_of
from .data_rows import DATA, SCHEMA, SCHEMA_DOC, DataRow
from .data_schema import MANIFEST, schema_text
from .earlier import Piece
from .job import Job
from .manifest import describe_file
from .records import Decode, FileRecord

SUFFIX = ".schema.json"
SCHEMA_FORMULA = "JSON Schema, draft 2020-12"


def write_data(job: Job) -> Piece:
    """All chosen rows that the level has anything of."""
    files = [file for row in DATA.values() for file in job.piece(row.name, partial(_piece, job, row)).files]
    own = job.piece(SCHEMA, lambda: Piece([_schema(job, MANIFEST, SCHEMA, SCHEMA_DOC)]))
    return Piece([*files, *own.files])


def _piece(job: Job, row: DataRow) -> Piece:
    frame = Frame.of(job.level, job.target)
    made = row.make(job.level, frame)
    if made is None:
        return Piece()
    beside = f"{job.name}_{row.name}{SUFFIX}"
    file = row.model.model_validate({"$schema": beside, "level": job.name, **made})
    path = job.folder / f"{job.name}_{row.name}.json"
    path.write_text(text_of(file), "utf-8", newline="\n")
    back = row.model.model_validate_json(path.read_bytes())
    off_cm = row.off(job.level, back)
    if back != file or not off_cm < float("inf"):
        raise BadInput(f"{path.name} came back from the disk as something else than the level")
    record = describe_file(
        path, **_text(row.name, row.doc), decode=Decode(formula=row.formula, numbers=row.numbers(job.level, back)),
        max_error=off_cm,
    )  # fmt: skip
    return Piece([record, _schema(job, row.name, row.name, row.doc)])


def _schema(job: Job, name: str, map_name: str, doc: str) -> FileRecord:
    path: Path = job.folder / f"{job.name}_{name}{SUFFIX}"
    path.write_text(schema_text(name), "utf-8", newline="\n")
    return describe_file(path, **_text(map_name, doc), decode=Decode(formula=SCHEMA_FORMULA), max_error=0.0)


def _text(map_name: str, doc: str) -> dict:
    return {
        "map": map_name, "doc": doc, "width": 0, "height": 0, "bit_depth": 8, "sample_type": "text", "row_0": None,
        "channels": [],
    }  # fmt: skip


def data_line(record: FileRecord) -> str:
    """What a data file is, in one line."""
    return f"{record.name}: {SCHEMA_FORMULA if record.name.endswith(SUFFIX) else record.doc}"
