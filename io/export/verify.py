"""Check an export: names, sizes, hashes, ranges, and every height decoded with the engine's formula.

Findings are sentences; an empty list means fine (a level folder goes to `io.check_level`). Nothing a manifest says is
believed before it was measured, and no file outside the folder is ever opened.
"""

from __future__ import annotations

from pathlib import Path

from pydantic import ValidationError

from ...level import BadInput
from .manifest import SUFFIX, file_sha256, inside, load, signature
from .records import SCHEMA, SCHEMA_VERSION, FileRecord, Manifest
from .verify_godot import check_godot
from .verify_raw import check_raw
from .verify_unity import check_unity
from .verify_unreal import check_unreal

TARGETS = {
    "unreal": check_unreal,
    "raw": check_raw,
    "unity": check_unity,
    "godot": check_godot,
    "godot-hterrain": check_godot,
    "godot-project": check_godot,
}
HEIGHT_MAPS = (".r16", ".raw")


def check(path: str | Path) -> list[str]:
    """What is wrong with an export or a level, one sentence each; [] when all is well. BadInput: neither is there."""
    path = Path(path)
    if not path.exists():
        raise BadInput(f"{path} does not exist")
    if path.is_file():
        if not (path.name.endswith(SUFFIX) or path.name == "level.json"):
            raise BadInput(f"{path} is neither an export nor a level: name its folder")
        path = path.parent
    if path.suffix == ".shore" or (path / "level.json").exists():
        from ..check_level import check_level

        return check_level(path)
    return check_export(path)


def check_export(folder: Path) -> list[str]:
    """Every manifest in a folder and the files it lists; BadInput where there is none."""
    manifests = sorted(entry for entry in folder.iterdir() if entry.name.endswith(SUFFIX))
    if not manifests:
        raise BadInput(f"{folder} is no level and has no manifest (NAME{SUFFIX}), so what is in it cannot be checked")
    findings = [] if len(manifests) == 1 else [f"{folder} has {len(manifests)} manifests; an export has one"]
    for path in manifests:
        findings += _check_manifest(folder, path)
    return findings


def _check_manifest(folder: Path, path: Path) -> list[str]:
    data, reason = load(path)
    if reason:
        return [reason]
    if not isinstance(data, dict) or data.get("schema") != SCHEMA:
        return [f"{path.name} is no Shorewright manifest: its schema is not {SCHEMA}"]
    version = data.get("schema_version")
    if version != SCHEMA_VERSION:
        return [f"{path.name} has version {version!r}, this program knows {SCHEMA_VERSION}: update it, or export again"]
    findings = []
    if data.get("manifest_sha256") != signature(data):
        findings.append(f"{path.name} was edited after the export: its own hash does not fit")
    try:
        manifest = Manifest.model_validate({key: value for key, value in data.items() if key != "manifest_sha256"})
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(map(str, first["loc"]))
        return [*findings, f"{path.name} cannot be used: {place}: {first['msg'][0].lower()}{first['msg'][1:]}"]
    whole: dict[str, Path] = {}
    for record in manifest.files:
        found = _check_file(folder, record)
        findings += found
        if not found:
            whole[record.name] = folder / record.name
    findings += _strangers(folder, manifest)
    if manifest.target not in TARGETS:
        return [*findings, f"{path.name} names a target this program does not know: {manifest.target!r}"]
    return findings + TARGETS[manifest.target](manifest, whole)


def _check_file(folder: Path, record: FileRecord) -> list[str]:
    """Name, presence, size and hash of one file; the first fault found, as the rest follows from it."""
    name = record.name
    if not inside(name):
        return [f"the manifest names a file outside the folder: {name!r}"]
    path = folder / name
    if path.is_symlink() and path.resolve().parent != folder.resolve():
        return [f"{name} is a link that leads out of the folder"]
    if not path.is_file():
        return [f"{name} is missing"]
    size = path.stat().st_size
    if size != record.size_bytes:
        return [f"{name} holds {size} bytes, the manifest says {record.size_bytes}"]
    try:
        digest = file_sha256(path)
    except OSError as error:
        return [f"{name} cannot be read: {error.strerror or error}"]
    return [] if digest == record.sha256 else [f"{name} was changed after the export: its sha256 does not fit"]


def _strangers(folder: Path, manifest: Manifest) -> list[str]:
    """Files that an importer would take up though the manifest knows nothing of them."""
    listed = {record.name for record in manifest.files}
    findings = []
    for entry in sorted(folder.iterdir()):
        if entry.name not in listed and entry.suffix.lower() in HEIGHT_MAPS:
            findings.append(f"{entry.name} is a height map that the manifest does not list")
        sidecar = entry.suffix.lower() == ".json" and f"{entry.stem}.r16" in listed
        if sidecar:
            findings.append(f"{entry.name} bears the name of the .r16: Unreal reads size and bit depth from it")
    return findings
