"""The kit's files in an export: of each part NAME_PART.json, .f32, .u8, its functions in the languages asked for."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ....level import BadInput
from ....level.beat import beat
from ..job import Job
from ..manifest import describe_file
from ..records import Decode, FileRecord
from .tree import Unit
from .write_c import CWriter
from .write_data import c_data, hlsl_data
from .write_godot import GodotWriter
from .write_hlsl import HlslWriter
from .write_time import hlsl_time

if TYPE_CHECKING:
    from .data import KitData

NAME = "kit"
DOC = (
    "Sea and sky for a game: their functions as source in the engine's language, their numbers (.json) and maps "
    "(.f32, .u8)."
)
MAP = (NAME, DOC)
FILES = {"<f4": ".f32", "|u1": ".u8"}  # by NumPy's name of the samples
FORMATS = {"<f4": "float32", "|u1": "unorm8"}


@dataclass(frozen=True)
class Source:
    """A part as the level has it; `stem` is that of its files."""

    part: str
    stem: str
    text: str
    unit: Unit
    data: KitData


@dataclass(frozen=True)
class Language:
    """`write(source)` gives the whole file but its first lines."""

    suffix: str
    doc: str
    write: Callable[[Source], str]


def _c(source: Source) -> str:
    guard = guard_of(source.stem, "H")
    numbers = c_data(source.unit, source.data, source.part)
    return f"#ifndef {guard}\n#define {guard}\n\n{CWriter(source.unit, source.part).text(numbers)}\n#endif\n"


def _hlsl(source: Source) -> str:
    guard = guard_of(source.stem, "HLSL")
    numbers, body = hlsl_data(source.unit, source.data), HlslWriter(source.unit).text()
    end = hlsl_time(source.unit, source.data, source.part)
    return f"#ifndef {guard}\n#define {guard}\n\n{numbers}\n{body}{end}\n#endif\n"


LANGUAGES = {
    "glsl": Language(".glsl", "GLSL 4.10", lambda source: source.text),
    "hlsl": Language(".hlsl", "HLSL for Unity's and Unreal's includes", _hlsl),
    "godot": Language(".gdshaderinc", "Godot 4 shader include", lambda source: GodotWriter(source.unit).text()),
    "c": Language(".h", "C99, for floating bodies, AI and servers", _c),
}


def guard_of(stem: str, ending: str) -> str:
    """The macro that keeps a file from being read twice; a hash where letters alone don't tell the stem."""
    word = "".join(c.upper() if c.isascii() and c.isalnum() else "_" for c in stem)
    apart = "" if word.lower() == stem else f"_{hashlib.sha256(stem.encode()).hexdigest()[:8].upper()}"
    return f"SHOREWRIGHT_{word}{apart}_{ending}"


def head(source: Source, name: str, language: Language) -> str:
    """The first lines of every file of source."""
    from .parts import PARTS

    part = PARTS[source.part]
    return f"// The {part.name} of {name} in {language.doc}. {part.doc} Made from the editor's own shader.\n"


def sources(level, name: str, part: str = "sea") -> Source:
    """A part of the kit as a level has it."""
    from .parts import part_of  # loads SciPy

    return Source(part, f"{name}_{part}", *part_of(level, part))


def text_of(source: Source, name: str, word: str) -> str:
    """The file of a part in one of LANGUAGES."""
    from .parts import PARTS
    from .reach import pruned

    fresh = Source(source.part, source.stem, source.text, pruned(source.unit, PARTS[source.part].wanted), source.data)
    return head(source, name, LANGUAGES[word]) + LANGUAGES[word].write(fresh)


def write_kit(job: Job, languages: Iterable[str]) -> list[FileRecord]:
    """Write the kit in some of LANGUAGES with numbers and maps, describe the files; none without `kit` in the job."""
    from .parts import PARTS

    if NAME not in job.maps:
        return []
    wanted = [name for name, part in PARTS.items() if part.has(job.level)]
    return [record for name in wanted for record in _write_part(job, name, languages)]


def _write_part(job: Job, name: str, languages: Iterable[str]) -> list[FileRecord]:
    from .measure import measured
    from .numbers import numbers

    source = sources(job.level, job.name, name)
    told = numbers(source)
    error, unit = measured(source, told["probes"])
    text = _finite_json(told, error, f"the {name} of {job.name}")
    records = []
    for word in languages:
        beat()
        path = job.folder / f"{source.stem}{LANGUAGES[word].suffix}"
        path.write_text(text_of(source, job.name, word), "utf-8", newline="\n")
        records.append(_record(path, "text", 8, f"source in {LANGUAGES[word].doc}", error, unit))
    for kind, suffix in FILES.items():
        maps = [values for values in source.data.maps.values() if values.dtype.str == kind]
        if not maps:
            continue
        blob = job.folder / f"{source.stem}{suffix}"
        blob.write_bytes(b"".join(values.tobytes() for values in maps))
        back = np.frombuffer(blob.read_bytes(), kind)
        off = float(np.max([np.abs(a - b.ravel()).max() for a, b in zip(_cut(back, maps), maps, strict=True)]))
        formula = "maps one after another, as the .json lists them, south row first" + (
            "; v / 255" if suffix == ".u8" else ""
        )
        bits = maps[0].dtype.itemsize * 8
        records.append(_record(blob, "float32" if bits == 32 else "uint8", bits, formula, off, "as stored"))
    path = job.folder / f"{source.stem}.json"
    path.write_text(text, "utf-8", newline="\n")
    return [*records, _record(path, "text", 8, "value = as written", error, unit)]


def _finite_json(told: dict, error: float, what: str) -> str:
    """A part's json; BadInput when one of its numbers or the measured error is none."""
    try:
        json.dumps(error, allow_nan=False)
        return json.dumps(told, indent=1, allow_nan=False) + "\n"
    except ValueError:
        raise BadInput(f"{what} gives values that are no finite numbers, so its kit cannot be written") from None


def _cut(back: np.ndarray, maps: list[np.ndarray]) -> list[np.ndarray]:
    ends = np.cumsum([values.size for values in maps])
    return np.split(back.astype(np.float32), ends[:-1])


def _record(path, sample_type: str, bits: int, formula: str, error: float, unit: str) -> FileRecord:
    return describe_file(
        path, map=NAME, doc=DOC, width=0, height=0, bit_depth=bits, sample_type=sample_type, row_0=None, channels=[],
        decode=Decode(formula=formula), max_error=error, error_unit=unit,
    )  # fmt: skip


def kit_line(record: FileRecord) -> str:
    """What a file of the kit is, in one line."""
    return f"{record.name}: {record.decode.formula}; docs/kit.md says how it is included"
