"""What NAME_sea.json and NAME_sky.json hold: every uniform with its unit and meaning, what moves it, maps, probes."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np

from .changes import TIDE_FORMULA
from .data import CYCLES
from .files import FILES, FORMATS, Source
from .parts import PARTS
from .phases import FORMULA
from .uniform_docs import meaning
from .write_data import places


def numbers(source: Source) -> dict:
    """The json of a part, ready to be written."""
    data, part = source.data, PARTS[source.part]
    return {
        "part": source.part,
        "uniforms": {name: np.asarray(value).tolist() for name, value in data.values.items()},
        "meaning": {
            name: dict(zip(("unit", "doc"), meaning(name), strict=True)) for name in (*data.values, *data.maps)
        },
        "phase_formula": FORMULA,
        "phases": [phase.told() for phase in data.phases],
        **_clock(source),
        **_tide(source),
        **_track(source),
        "held_as_at_time_0": data.held,
        "maps": _maps(source),
        "probes": part.probes(data),
    }


def _clock(source: Source) -> dict:
    data = source.data
    if not data.clock_hz:
        return {}
    formula = f"waves = t * clock_hz; u_shore_clock = fract(waves); u_shore_cycle = floor(waves) mod {CYCLES}"
    loop = "seconds after which all begins again, 0: never; t is taken modulo it before anything else"
    return {"clock_formula": formula, "clock_hz": data.clock_hz, "loop_formula": loop, "loop_s": data.loop_s}


def _tide(source: Source) -> dict:
    tide = source.data.tide
    return {"tide_formula": TIDE_FORMULA, "tide": asdict(tide)} if tide else {}


def _track(source: Source) -> dict:
    track = source.data.track
    if not track.values:
        return {}
    formula = "straight lines between times_s, before the first and after the last as there; phases act on top of it"
    values = {name: values.tolist() for name, values in track.values.items()}
    return {"track_formula": formula, "track": {"times_s": track.times_s, "uniforms": values, "max_error": track.error}}


def _maps(source: Source) -> dict:
    """Where each map lies in its file, in samples, and how a texture of it is read."""
    maps, at = source.data.maps, places(source.data.maps)
    found = {}
    for name, values in maps.items():
        rows, cols, channels = values.shape
        found[name] = {
            "file": source.stem + FILES[values.dtype.str], "format": FORMATS[values.dtype.str], "offset": at[name],
            "width": cols, "height": rows, "channels": channels, "filter": "nearest", "wrap": "none", "mips": "none",
            "colour_space": "linear", "row_0": "south",
        }  # fmt: skip
    return found
