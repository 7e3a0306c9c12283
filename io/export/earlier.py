"""Files of an earlier export in the same folder, for maps that would come out the same again."""

from __future__ import annotations

import contextlib
import os
import shutil
from dataclasses import dataclass, field
from pathlib import Path

from pydantic import ValidationError

from .manifest import file_sha256, inside, load, signature
from .records import SCHEMA_VERSION, FileRecord, FlowProbe, Manifest, MapProbe


@dataclass
class Piece:
    """What one map adds to an export: its files and the places to check them by."""

    files: list[FileRecord] = field(default_factory=list)
    flow_probes: list[FlowProbe] = field(default_factory=list)
    map_probes: list[MapProbe] = field(default_factory=list)


@dataclass(frozen=True)
class Earlier:
    """An export as its manifest tells it, in `folder`."""

    folder: Path
    manifest: Manifest

    def take(self, map_name: str, key: str, into: Path) -> Piece | None:
        """The files of a map, linked into `into`; None when they follow from something else or aren't whole."""
        if self.manifest.empty.get(map_name) == key:
            return Piece()
        records = [r for r in self.manifest.files if r.map == map_name]
        if not records or any(record.follows_sha256 != key for record in records):
            return None
        if not all(self._whole(record) for record in records):
            return None
        for record in records:
            _link(self.folder / record.name, into / record.name)
        names = {record.name for record in records}
        return Piece(
            records,
            self.manifest.flow_probes if map_name == "flow" else [],
            [probe for probe in self.manifest.map_probes if probe.file in names],
        )

    def _whole(self, record: FileRecord) -> bool:
        path = self.folder / record.name
        try:
            return (
                inside(record.name)
                and not path.is_symlink()
                and path.stat().st_size == record.size_bytes
                and file_sha256(path) == record.sha256
            )
        except OSError:
            return False


def earlier_export(folder: Path, manifest_name: str, target: str) -> Earlier | None:
    """The export in a folder, None when there is none of this target, or one that somebody edited."""
    path = folder / manifest_name
    if not path.is_file():
        return None
    data, _ = load(path)
    if not isinstance(data, dict) or data.get("target") != target or data.get("schema_version") != SCHEMA_VERSION:
        return None
    if data.get("manifest_sha256") != signature(data):
        return None
    try:
        return Earlier(folder, Manifest.model_validate({k: v for k, v in data.items() if k != "manifest_sha256"}))
    except ValidationError:
        return None


def _link(source: Path, target: Path) -> None:
    """The same bytes under another name; copied where the disk has no links."""
    with contextlib.suppress(OSError):
        os.link(source, target)
        return
    shutil.copyfile(source, target)
