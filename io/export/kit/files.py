"""The kit's files in an export: NAME_sea.json and .f32, and the functions in the languages that are asked for."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..job import Job
from ..manifest import describe_file
from ..records import Decode, FileRecord
from .parse import parse
from .reach import pruned
from .source import one_text
from .tree import Unit
from .write_c import CWriter
from .write_data import c_data, hlsl_data, hlsl_time
from .write_godot import GodotWriter
from .write_hlsl import HlslWriter

if TYPE_CHECKING:
    from .data import SeaData

NAME = "kit"
DOC = "The sea for a game: its functions as source in the engine's language, its numbers (.json) and its maps (.f32)."
MAP = (NAME, DOC)
WANTED = ("sea_at", "flow_at", "flow_places")


@dataclass(frozen=True)
class Language:
    """`write(text, unit, data)` gives the whole file."""

    suffix: str
    doc: str
    write: Callable[[str, Unit, SeaData], str]


def _c(text: str, unit: Unit, data: SeaData) -> str:
    body = CWriter(unit).text()
    return f"#ifndef SHOREWRIGHT_SEA_H\n#define SHOREWRIGHT_SEA_H\n\n{body}{c_data(unit, data)}\n#endif\n"


def _hlsl(text: str, unit: Unit, data: SeaData) -> str:
    numbers = hlsl_data(unit, data)
    body = HlslWriter(unit).text()
    return f"#ifndef SHOREWRIGHT_SEA\n#define SHOREWRIGHT_SEA\n\n{numbers}\n{body}{hlsl_time(data)}\n#endif\n"


LANGUAGES = {
    "glsl": Language(".glsl", "GLSL 4.10", lambda text, unit, data: text),
    "hlsl": Language(".hlsl", "HLSL for Unity's and Unreal's includes", _hlsl),
    "godot": Language(".gdshaderinc", "Godot 4 shader include", lambda text, unit, data: GodotWriter(unit).text()),
    "c": Language(".h", "C99, for floating bodies, minds and servers", _c),
}


def head(name: str, language: Language) -> str:
    """The first lines of every file of source."""
    return (
        f"// The sea of {name} in {language.doc}. sea_surface(before): the surface that an undeformed point is\n"
        "// carried to; sea_at(world): that over a place. Metres, x east, y north. Made from the editor's own shader.\n"
    )


def sources(level, name: str, languages: Iterable[str]) -> tuple[dict[str, str], SeaData]:
    """The text of each language, by language, and the numbers."""
    from .data import level_defines, sea_data  # loads SciPy

    text = one_text(level_defines(level))
    unit = pruned(parse(text), WANTED)
    data = sea_data(level, unit)
    return {
        word: head(name, LANGUAGES[word]) + LANGUAGES[word].write(text, pruned(parse(text), WANTED), data)
        for word in languages
    }, data


def write_kit(job: Job, languages: Iterable[str]) -> list[FileRecord]:
    """Write the kit in some of LANGUAGES with numbers and maps, describe the files; none without `kit` in the job."""
    if NAME not in job.maps:
        return []
    made, data = sources(job.level, job.name, languages)
    records = []
    for word, text in made.items():
        path = job.folder / f"{job.name}_sea{LANGUAGES[word].suffix}"
        path.write_text(text, "utf-8", newline="\n")
        records.append(_record(path, "text", 8, f"source in {LANGUAGES[word].doc}"))
    blob = job.folder / f"{job.name}_sea.f32"
    blob.write_bytes(b"".join(values.tobytes() for values in data.maps.values()))
    records.append(_record(blob, "float32", 32, "maps one after another, as the .json lists them, south row first"))
    path = job.folder / f"{job.name}_sea.json"
    path.write_text(json.dumps(numbers(data), indent=1, allow_nan=False) + "\n", "utf-8", newline="\n")
    return [*records, _record(path, "text", 8, "value = as written")]


def numbers(data: SeaData) -> dict:
    """What NAME_sea.json holds."""
    from .data import probes

    at, maps = 0, {}
    for name, values in data.maps.items():
        rows, cols, channels = values.shape
        maps[name] = {"offset": at, "width": cols, "height": rows, "channels": channels}
        at += values.size
    return {
        "uniforms": {name: np.asarray(value).tolist() for name, value in data.values.items()},
        "phase_formula": "uniform[row][part] = fract(start + rate_hz * t) in double; row -1: the uniform is no array; "
        "with turns > 0 it is floor(start + rate_hz * t) mod turns",
        "phases": [vars(phase) for phase in data.phases],
        "clock_formula": "waves = t * clock_hz; u_shore_clock = fract(waves); u_shore_cycle = floor(waves) mod 4096",
        "clock_hz": data.clock_hz,
        "loop_s": data.loop_s,
        "held_as_at_time_0": data.held,
        "maps": maps,
        "probes": probes(data),
    }


def _record(path, sample_type: str, bits: int, formula: str) -> FileRecord:
    return describe_file(
        path, map=NAME, doc=DOC, width=0, height=0, bit_depth=bits, sample_type=sample_type, row_0=None, channels=[],
        decode=Decode(formula=formula), max_error=0.0, error_unit="m",
    )  # fmt: skip


def kit_line(record: FileRecord) -> str:
    """What a file of the kit is, in one line."""
    return f"{record.name}: {record.decode.formula}; docs/kit.md says how it is included"
