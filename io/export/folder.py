"""The folder an export lands in: written under a temporary name beside or inside it, then moved there.

A folder is only ever written to when everything in it came from an earlier export of the same level to the same target,
as its manifest says; anything else in it means that the person chose the wrong folder.
"""

from __future__ import annotations

import contextlib
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ...level import BadInput
from .manifest import SUFFIX, file_sha256, inside, load
from .records import SCHEMA

# what file browsers, Godot (its cache, its builds' settings) and version control leave in a folder: theirs, it stays
THEIRS = frozenset({".DS_Store", "Thumbs.db", "desktop.ini", ".godot", "export_presets.cfg"})
THEIRS |= {".gitignore", ".gitattributes", ".editorconfig"}
# what Godot and Unity lay beside each file of a project
BESIDE = (".import", ".uid", ".meta")
# Texts of these maps are there to be edited, so what somebody wrote into them is kept; anything else that differs from
# its manifest is damage, and is repaired. Godot itself saves project.godot anew when it opens the folder.
EDITABLE = frozenset({"project"})
RESAVED = frozenset({"project.godot"})
PART = ".shorewright-part-"
LOCK = ".lock"


@contextmanager
def staged(out: Path, manifest_name: str, target: str) -> Iterator[Path]:
    """A new empty folder whose files become those of `out` when the block ends well, and vanish when it doesn't.

    A new `out` appears by one rename. One that exists may be a mount point or somebody's working directory, so it
    stays and its files are moved. BadInput when `out` holds other things or edited texts, or the disk refuses.
    """
    from filelock import FileLock

    out = out.resolve()
    level = next((home for home in (out, *out.parents) if home.suffix == ".shore"), None)
    if level:
        raise BadInput(f"{out} lies in the level {level.name}: name a folder beside it")
    owned(out, manifest_name, target)
    fresh = not out.exists()
    home = out.parent if fresh else out
    part = home / f"{PART}{os.getpid()}-{secrets.token_hex(4)}"
    lock = FileLock(home / (part.name + LOCK), timeout=0)
    try:
        home.mkdir(parents=True, exist_ok=True)
        sweep(home)
        lock.acquire()
        part.mkdir()
        yield part
        before = owned(out, manifest_name, target)  # a long export: somebody may have put something there since
        if out.exists():
            _replace(part, out, before, manifest_name)
        else:
            part.rename(out)
    except OSError as error:
        raise BadInput(f"cannot write the export to {out}: {error.strerror or error}") from None
    except BadInput as error:  # of a picture: nobody knows the folder that it was to come from
        raise BadInput(str(error).replace(str(part), str(out))) from None
    finally:
        shutil.rmtree(part, ignore_errors=True)
        _let_go(lock)


def sweep(home: Path) -> None:
    """Take away what killed exports left in a folder; a running one holds the lock of its own part."""
    from filelock import FileLock, Timeout

    for name in {entry.name.removesuffix(LOCK) for entry in home.glob(f"{PART}*")}:
        lock = FileLock(home / (name + LOCK), timeout=0)
        with contextlib.suppress(Timeout, OSError):
            lock.acquire()
            shutil.rmtree(home / name, ignore_errors=True)
            _let_go(lock)


def _let_go(lock) -> None:
    with contextlib.suppress(OSError):
        os.unlink(lock.lock_file)  # while it is held; filelock refuses a file without a name
    lock.release()


def owned(out: Path, manifest_name: str, target: str) -> list[str]:
    """Names in `out` that an earlier export of this kind wrote; BadInput when there is anything else, or edited."""
    if not out.exists():
        return []
    if not out.is_dir():
        raise BadInput(f"{out} is a file; name a folder for the export")
    try:
        found = {entry.name for entry in out.iterdir() if not entry.name.startswith(PART)} - THEIRS
        found = {name for name in found if not name.endswith(BESIDE)}
        listed = _listed(out / manifest_name, target) if found else {}
        edited = sorted(name for name in found & listed.keys() if _edited(out / name, listed[name]))
    except OSError as error:
        raise BadInput(f"cannot look into {out}: {error.strerror or error}") from None
    foreign = sorted(found - listed.keys())
    if foreign:
        raise BadInput(_other_export(out, set(foreign), manifest_name) or _strangers(out, foreign))
    if edited:
        verb, it = ("was", "it") if len(edited) == 1 else ("were", "them")
        raise BadInput(f"{', '.join(edited)} {verb} changed since the export: move {it} away or name another folder")
    return sorted(found)


def _listed(manifest: Path, target: str) -> dict[str, dict]:
    """What the manifest of an earlier export of this level to this target lists, by name, and itself; else nothing."""
    if not manifest.is_file():
        return {}
    data, _ = load(manifest)
    if not isinstance(data, dict) or data.get("target") != target or not isinstance(data.get("files"), list):
        return {}
    files = {file.get("name"): file for file in data["files"] if isinstance(file, dict)}
    return {name: file for name, file in files.items() if isinstance(name, str) and inside(name)} | {manifest.name: {}}


def _other_export(out: Path, foreign: set[str], manifest_name: str) -> str | None:
    """The sentence on an export of another level or to another target, when it wrote all that is foreign here."""
    for name in sorted(name for name in foreign | {manifest_name} if name.endswith(SUFFIX)):
        data, _ = load(out / name)
        target = data.get("target") if isinstance(data, dict) and data.get("schema") == SCHEMA else None
        if isinstance(target, str) and inside(target) and foreign <= _listed(out / name, target).keys():
            thing = "target" if name == manifest_name else "level"
            return (
                f"{out} holds the {target} export of {name.removesuffix(SUFFIX)}: give each {thing} a folder of its own"
            )
    return None


def _strangers(out: Path, foreign: list[str]) -> str:
    shown = ", ".join(foreign[:3]) + (f" and {len(foreign) - 3} more" if len(foreign) > 3 else "")
    return f"{out} holds things this export did not write ({shown}); name a new or empty folder"


def _edited(path: Path, told: dict) -> bool:
    """True for a text meant for editing that isn't as it was exported."""
    if told.get("map") not in EDITABLE or path.name in RESAVED:
        return False
    return path.is_file() and file_sha256(path) != told.get("sha256")


def _replace(part: Path, out: Path, before: list[str], manifest_name: str) -> None:
    """Move the files `before` aside and those of `part` in; whatever stops that, all is put back.

    The old manifest leaves last and the new one comes first: killed at any moment, the manifest in the folder lists
    all that is there, so `check` tells what is missing and the next export may replace it.
    """
    aside = part / ".before"
    aside.mkdir()
    leaving = sorted(before, key=lambda name: name == manifest_name)
    coming = sorted((path.name for path in part.iterdir() if path != aside), key=lambda name: name != manifest_name)
    moves = [(out / name, aside / name) for name in leaving] + [(part / name, out / name) for name in coming]
    done: list[tuple[Path, Path]] = []
    try:
        for here, there in moves:
            here.rename(there)
            done.append((here, there))
    except BaseException:
        for here, there in reversed(done):
            there.rename(here)
        raise
