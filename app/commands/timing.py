"""`timing`: when fronts pass a level, as maps, lines, lists and a picture (T06)."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Parameter

from ...level.errors import BadInput
from .common import LevelPath, finite, numbers, put, put_notes

MANIFEST = "timing.json"
SWELL = "PERIOD_S,HEADING_DEG of one swell in place of the level's own, such as 9,20; a heading of 0 goes north."


def timing(
    level: LevelPath,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="A folder, new, empty or of an earlier timing.")],
    time: Annotated[float, Parameter(allow_leading_hyphen=True, help="Seconds on the level's clock.")] = 0.0,
    source: Annotated[
        Literal["depth", "travel_time", "blend"] | None, Parameter(help="In place of the level's timing.source.")
    ] = None,
    swell: Annotated[str | None, Parameter(allow_leading_hyphen=True, help=SWELL)] = None,
    every: Annotated[float, Parameter(help="Seconds between two isochrones.")] = 2.0,
    step: Annotated[float, Parameter(help="Seconds between the ghosts in the picture.")] = 1.0,
) -> int:
    """Write when fronts pass a level: arrival, speed, crests, isochrones, hot spots, events, a picture.

    Prints the folder.
    """
    from ...io import read_level
    from ...level.one_swell import take_swell
    from ...level.timing import timing_map

    time, every = finite(time, "--time", 0, 1e9), finite(every, "--every", 0.05, 1e4)
    step = finite(step, "--step", 0.01, 1e3)
    pair = numbers(swell, 2, "--swell", "a swell: give PERIOD_S,HEADING_DEG such as 9,20") if swell else None
    notes: list[str] = []
    found = read_level(level, notes)
    if source or pair:
        found.set("timing.source", source or "travel_time")
    if pair and not found.settings.timing.travels:
        raise BadInput(
            "--swell needs --source travel_time: by depth, waves keep shore.interval_s and come from no side"
        )
    if pair:
        take_swell(found, *pair)
    if not timing_map(found, time).passage.stands.any():
        why = "there is no sea, its waves are off, or the swell would come from land"
        raise BadInput(f"no wave stands anywhere in {level.name}: {why}")
    put_notes([*notes, *_write(found, level.resolve().stem, output, time, every, step)])
    put(str(output))
    return 0


def _write(level, name: str, output: Path, time_s: float, every_s: float, step_s: float) -> list[str]:
    """All files, whole or not at all; returns what is worth telling."""
    from ...io.export.folder import staged
    from ...io.images import encode
    from ...io.timing_files import write_hot_spots, write_json, write_lines, write_map
    from ...level.crests import crest_lines, isochrones
    from ...level.hot_spots import hot_spots
    from ...level.timing import period_s, whole_maps
    from ..timing_picture import Sheet, timing_picture

    source, period = level.settings.timing.source, period_s(level, time_s)
    facts = {"time_s": time_s, "source": source, "period_s": round(period, 6)}
    spots, events, side = hot_spots(level, time_s), _events(level, time_s), 1025
    with staged(output, MANIFEST, "timing") as folder:
        for key, values in whole_maps(level, time_s).items():
            write_map(folder / (f"{key}.exr" if key == "front_speed" else f"arrival_{key}.exr"), values)
        write_lines(folder / "crests.geojson", level, crest_lines(level, time_s, side), "wave", {"time_s": time_s})
        write_lines(folder / "isochrones.geojson", level, isochrones(level, time_s, every_s, side), "arrival_s", {})
        write_hot_spots(folder / "hot_spots.json", spots, facts)
        write_json(folder / "events.json", {**facts, **events})
        title = f"{name}: {source.replace('_', ' ')}, a crest every {period:.1f} s"
        encode(folder / "timing.png", timing_picture(Sheet(level, time_s, title, spots, step_s, every_s)))
        files = [{"name": path.name} for path in sorted(folder.iterdir())]
        row_0 = "north; a sample a height vertex, NaN where no wave stands"
        about = {"target": "timing", "level": name, **facts, "row_0": row_0}
        write_json(folder / MANIFEST, {**about, "files": files})
    return [events["note"]] if "note" in events else []


SPAN_S = 60.0  # that events are listed for


def _events(level, time_s: float) -> dict:
    """Crests at the level's probes within the next minute."""
    from ...level.next_crest import next_crest

    probes = [(name, thing) for name, thing in sorted(level.objects.items()) if thing.kind == "probe"]
    if not probes:
        return {"events": [], "note": "the level has no probes, so events.json lists no crests"}
    events = []
    for name, thing in probes:
        at = time_s
        while (crest := next_crest(level, at, thing.x, thing.y)) and (at := at + crest.in_s + 1e-6) <= time_s + SPAN_S:
            later = None if crest.breaks_after_s is None else round(at + crest.breaks_after_s, 3)
            row = {"probe": name, "time_s": round(at, 3), "breaks_s": later, "height_m": round(crest.height_m, 3)}
            events.append(row | ({"object": crest.of} if crest.of else {"type": crest.type}))
    return {"events": sorted(events, key=lambda event: (event["time_s"], event["probe"]))}
