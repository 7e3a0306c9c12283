"""Exporters: a level as files that an engine reads, each with a manifest that says how far off it was measured to be.

paths = export(level, "unreal", "out/cove_unreal", name="cove")
findings = check("out/cove_unreal")          # [] when every byte decodes to what the manifest says
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np

from ...level import BadInput, Level
from . import common, godot, godot_project, raw, unity, unreal
from .earlier import earlier_export
from .folder import staged
from .job import Cancelled, Exporter, Job, Told, file_stem
from .manifest import SUFFIX, write
from .verify import check

__all__ = ["EXPORTERS", "Cancelled", "Exporter", "check", "export", "file_stem"]

EXPORTERS: dict[str, Exporter] = {
    row.name: replace(row, groups=common.GROUPS)
    for row in (
        Exporter(
            "unreal",
            "Unreal",
            "A square 16-bit height map for Landscape, the sea at Z 0, with the values to type into the import dialog; "
            "current and maps as pictures.",
            unreal.MAPS,
            unreal.export,
            unreal.SIDES,
            tiles=True,
        ),
        Exporter(
            "unity",
            "Unity",
            "A square RAW height map for Terrain, the sea at Y 0, with the values to type; current and maps as "
            "pictures, the current for Crest 4 too.",
            unity.MAPS,
            unity.export,
            unity.SIDES,
            tiles=True,
        ),
        Exporter(
            "godot",
            "Godot, Terrain3D",
            "Height in metres over the sea as float and 16 bits, with the values for Terrain3D's importer; deep maps "
            "as floats.",
            godot.TERRAIN3D_MAPS,
            godot.terrain3d,
        ),
        Exporter(
            "godot-hterrain",
            "Godot, HTerrain",
            "A square RAW height map for HTerrain's import dialog, with the values to type; deep maps as floats.",
            godot.HTERRAIN_MAPS,
            godot.hterrain,
            godot.SIDES,
        ),
        Exporter(
            "godot-project",
            "Godot, a project to open",
            "A small Godot 4 project that draws the level, ground and sea, and needs no plug-in: open it and press F5.",
            godot_project.MAPS,
            godot_project.export,
        ),
        Exporter(
            "raw",
            "Raw files",
            "The level's own samples: height in 16 bits and float, ground as GLB, layers as .vti, painted sky as .tif, "
            "current and maps as pictures.",
            raw.MAPS,
            raw.export,
        ),
    )
}


def export(
    level: Level,
    target: str,
    out_dir: str | Path,
    only: Iterable[str] | str | None = None,
    name: str = "level",
    *,
    resample: bool = False,
    tile: int | None = None,
    progress: Told | None = None,
) -> list[Path]:
    """Write the files of a target into `out_dir` and return their paths, the manifest last.

    `name` (a level folder's name will do) begins every file name; `only` picks maps, or groups of them. `resample`
    makes the longer side a legal size of the target, `tile` cuts the level into squares of that many samples a side.
    The folder appears whole or not at all and then holds exactly what its manifest lists; files that would come out
    the same are kept.
    `progress` is told the share done and what comes next, and stops the export with Cancelled by returning False.
    BadInput: unknown target or map, a level the target cannot hold, a folder with other things in it, a disk that
    refuses.
    """
    if target not in EXPORTERS:
        raise BadInput(f"there is no export target {target!r}; use one of: {', '.join(EXPORTERS)}")
    exporter = EXPORTERS[target]
    chosen = exporter.choose(only, EXPORTERS.values())
    options = exporter.options(resample, tile)
    if not np.isfinite(level.height).all():
        raise BadInput("the height of this level holds values that are no numbers; fill them before exporting")
    stem = file_stem(name)
    out = Path(out_dir)
    with staged(out, stem + SUFFIX, target) as folder:
        earlier = earlier_export(out, stem + SUFFIX, target)
        job = Job(level, stem, target, folder, chosen, options, earlier, progress)
        manifest = exporter.function(job)
        if not manifest.files:
            raise BadInput(f"this level holds nothing of that to export: {', '.join(sorted(chosen))}")
        write(folder / (stem + SUFFIX), manifest)
    return [out / file.name for file in manifest.files] + [out / (stem + SUFFIX)]
