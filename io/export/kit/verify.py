"""Check the kit of an export: maps fill their files, sources say the json's numbers, and its functions give the probes.

Nothing of the level is here: what the probes hold is the twin's, and the GLSL, where the export has it, is run again.
"""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np

from ....level import BadInput
from ..records import FileRecord, Manifest
from .files import FORMATS, NAME

SOURCES = (".h", ".hlsl", ".glsl", ".gdshaderinc")
KINDS = {told: kind for kind, told in FORMATS.items()}
ROUNDED = 1e-6  # of a number's size: what float32 and nine digits leave of it


def check_kit(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about the kit's parts; files that are missing or changed were reported before this."""
    records = [record for record in manifest.files if record.map == NAME]
    found = []
    for stem in sorted({record.name.rsplit(".", 1)[0] for record in records}):
        part = {Path(record.name).suffix: record for record in records if record.name.rsplit(".", 1)[0] == stem}
        if ".json" not in part:
            found.append(f"the runtime kit has no numbers ({stem}.json)")
        elif part[".json"].name in whole:
            found += _check_part(manifest, part, whole)
    return found


def _check_part(manifest: Manifest, part: dict[str, FileRecord], whole: dict[str, Path]) -> list[str]:
    name = part[".json"].name
    try:
        told = json.loads(whole[name].read_text("utf-8"))
        texts = {
            suffix: whole[record.name].read_text("utf-8")
            for suffix, record in part.items()
            if suffix in SOURCES and record.name in whole
        }
        findings = [*_sizes(told, part), *_finite(told, name, manifest), *_declared(told, texts, part)]
        return findings or _again(told, texts, part, whole)
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError, RecursionError, IndexError):
        return [f"{name} is no list of numbers that a runtime kit has"]


def _sizes(told: dict, part: dict[str, FileRecord]) -> list[str]:
    """Each file of maps is as long as its maps, and they follow each other without a gap."""
    found, ends = [], {}
    for key, one in told["maps"].items():
        file = one["file"]
        if one["offset"] != ends.get(file, 0):
            found.append(f"{file}: its map {key} does not begin where the one before ends")
        samples = one["width"] * one["height"] * one["channels"]
        ends[file] = one["offset"] + samples * (samples > 0)
    for file, end in ends.items():
        record = part.get(Path(file).suffix)
        need = end * np.dtype(KINDS[_format(told, file)]).itemsize
        if record is None or record.name != file:
            found.append(f"the runtime kit has no {file}, which its maps lie in")
        elif record.size_bytes != need:
            found.append(f"{file} holds {record.size_bytes} bytes, its maps need {need}")
    return found


def _format(told: dict, file: str) -> str:
    return next(one["format"] for one in told["maps"].values() if one["file"] == file)


def _finite(told: dict, name: str, manifest: Manifest) -> list[str]:
    """Every number is one, normals are of unit length, heights such as this level's sea can have."""
    found, probes = [], told["probes"]
    if not all(np.isfinite(np.asarray(value, np.float64)).all() for value in told["uniforms"].values()):
        found.append(f"{name}: a uniform is no finite number")
    told_of = [value for probe in probes for values in probe.values() for value in np.atleast_1d(values)]
    if not probes or not np.isfinite(np.asarray(told_of, np.float64)).all():
        return [*found, f"{name}: its probes are not all finite numbers"]
    if "normal" not in probes[0]:
        return found
    normals = np.array([probe["normal"] for probe in probes], np.float64).reshape(-1, 3)
    if np.abs(np.linalg.norm(normals, axis=1) - 1).max() > 1e-3:
        found.append(f"{name}: its probes have normals that are not of unit length")
    off = np.abs(np.array([probe["position"][2] for probe in probes]) - manifest.world.sea_level_m)
    if off.max() > manifest.world.height_max_m - manifest.world.height_min_m + 100.0:
        found.append(f"{name}: its probes have heights that no sea of this level reaches")
    return found


def _declared(told: dict, texts: dict[str, str], part: dict[str, FileRecord]) -> list[str]:
    """Every source has every uniform and map, those with numbers the json's."""
    found = []
    for suffix, text in texts.items():
        words = set(re.findall(r"[A-Za-z_]\w*", text))
        missing = [name for name in (*told["uniforms"], *told["maps"]) if name not in words]
        if missing:
            found.append(f"{part[suffix].name} knows nothing of {missing[0]}, which {part['.json'].name} gives a value")
        values = _set_values(suffix, text)
        for name, value in told["uniforms"].items():
            if suffix in (".h", ".hlsl") and not missing and not _same(values.get(name, []), value):
                found.append(f"{part[suffix].name}: its {name} is not that of {part['.json'].name}")
    return found


def _set_values(suffix: str, text: str) -> dict[str, list[float]]:
    """The numbers that a C or HLSL file gives to each uniform, one after another."""
    found: dict[str, list[float]] = {}
    if suffix == ".h":
        text = text.partition("_set_up(")[2]
        rows = re.findall(r"^    g->(\w+)(?:\[\d+\])? = ([^;]*);", text, re.MULTILINE)
    else:
        rows = re.findall(r"^static \w+ (u_\w+)(?:\[\d+\])? = ([^;]*);", text, re.MULTILINE)
    for name, value in rows:
        value = re.sub(r"\b[a-z]+\d\b", "", value).replace("true", "1").replace("false", "0")
        found.setdefault(name, []).extend(map(float, re.findall(r"-?\d+\.?\d*(?:e[-+]?\d+)?", value)))
    return found


def _same(written: list[float], value) -> bool:
    """The numbers of a file are the json's, row by row; types wider or narrower than theirs are filled or cut."""
    rows = np.asarray(value, np.float64)
    rows = rows.reshape(-1, rows.shape[-1]) if rows.ndim > 1 else rows.reshape(1, -1)
    if not written or len(written) % len(rows):
        return False
    own = np.array(written).reshape(len(rows), -1)
    wide = min(own.shape[1], rows.shape[1])
    near = np.abs(own[:, :wide] - rows[:, :wide]) <= ROUNDED * np.maximum(np.abs(rows[:, :wide]), 1e-30)
    return bool(near.all() and (own[:, wide:] == 0).all())


def _again(told: dict, texts: dict[str, str], part: dict[str, FileRecord], whole: dict[str, Path]) -> list[str]:
    """The error at the probes of time 0 measured again, with the export's own GLSL, numbers and maps."""
    from .measure import off_by
    from .parse import parse
    from .parts import PARTS
    from .reach import pruned
    from .run import Run

    maps = {}
    for key, one in told["maps"].items():
        if one["file"] not in whole:
            return []
        samples = np.memmap(whole[one["file"]], np.dtype(KINDS[one["format"]]), "r")
        end = one["offset"] + one["width"] * one["height"] * one["channels"]
        maps[key] = samples[one["offset"] : end].reshape(one["height"], one["width"], one["channels"])
    probes, record = [probe for probe in told["probes"] if probe["time_s"] == 0.0], part[".json"]
    if ".glsl" not in texts or not probes:
        return []
    try:
        unit = pruned(parse(texts[".glsl"]), PARTS[told["part"]].wanted)
        run = Run(unit, told["uniforms"], maps, len(probes))
        off = float(np.abs(off_by(run, probes)).max())
    except BadInput as error:
        return [f"{part['.glsl'].name}: {error}"]
    if not math.isfinite(off) or off > 2 * record.max_error + 1e-6:
        return [f"{part['.glsl'].name} is {off:.3g} off its probes, the manifest says at most {record.max_error:g}"]
    return []
