"""Exports for Godot's terrain plug-ins: their numbers, floats and words, the current, the maps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...level import BadInput
from . import flow
from .common import check_common
from .engine_records import GodotTerrain
from .godot import EXR_FORMULA, hterrain_layout, terrain3d_layout, terrain_of, words_of
from .godot_project import SCENE, scene_says
from .layout import Layout
from .maps import row_slices
from .records import FileRecord, Manifest
from .verify_flow import check_flow
from .verify_ground import check_floats, check_heights, own_records, said_otherwise

PLUGINS = {"godot": ("terrain3d", ".r16"), "godot-hterrain": ("hterrain", ".raw"), "godot-project": ("project", ".r16")}


def check_godot(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about any of them; `whole` are the listed files whose bytes are the ones written."""
    own, terrain, source, world = own_records(manifest), manifest.engine, manifest.source, manifest.world
    if not manifest.files or set(own) - {"height", "flow", "project"} or not isinstance(terrain, GodotTerrain):
        return ["a Godot export has height maps, currents or maps and says how to read them; this manifest does not"]
    plugin, suffix = PLUGINS[manifest.target]
    shape = source.rows, source.cols
    try:
        if plugin == "hterrain":
            layout = hterrain_layout(shape, source.cell_m, manifest.options)
        else:
            layout = terrain3d_layout(shape, source.cell_m)
    except BadInput as error:
        return [str(error)]
    low, high = world.height_min_m - world.sea_level_m, world.height_max_m - world.sea_level_m
    findings = [*said_otherwise(terrain, terrain_of(layout, plugin, low, high if high > low else low + 1.0))]
    heights = own.get("height", [])
    if heights:
        words = [record for record in heights if not record.name.endswith(".exr")]
        name = f"{source.name}_height{suffix}"
        findings += check_heights(manifest, words, whole, layout, words_of(terrain), lambda _: name)
        floats = [record for record in heights if record not in words]
        if [record.name for record in floats] != ([f"{source.name}_height.exr"] if plugin == "terrain3d" else []):
            findings.append("Terrain3D gets its height as .exr and as .r16, HTerrain as .raw; here it is otherwise")
        for record in floats:
            findings += _floats(manifest, record, whole, layout)
    for record in own.get("flow", []):
        findings += check_flow(manifest, record, whole, flow.GODOT_FORMULA)
    findings += _scene(manifest, own.get("project", []), whole)
    return findings + check_common(manifest, whole)


def _scene(manifest: Manifest, records: list[FileRecord], whole: dict[str, Path]) -> Iterator[str]:
    """What the project's scene is told of the level."""
    for record in records:
        if record.name == SCENE and record.name in whole:
            lines = whole[record.name].read_text("utf-8").splitlines()
            missing = [line for line in scene_says(manifest) if line not in lines]
            if missing:
                yield f"{record.name} tells its level another size or range; it should say {missing[0]!r}"


def _floats(manifest: Manifest, record: FileRecord, whole: dict[str, Path], layout: Layout) -> Iterator[str]:
    """The EXR: its size, range and probes."""
    from ..image_rows import open_rows

    if record.decode.formula != EXR_FORMULA or record.row_0 != "north":
        yield f"{record.name} is to be read otherwise than Terrain3D reads it"
    if record.name not in whole:
        return
    wanted = len(layout.rows_at), len(layout.cols_at), 1
    try:
        with open_rows(whole[record.name]) as image:
            if image.shape != wanted or (record.height, record.width) != wanted[:2] or image.dtype != np.float32:
                yield f"{record.name} holds {image.shape} samples of {image.dtype}; {wanted} floats were said"
                return
            blocks = ((rows, image.read(rows)[..., 0]) for rows in row_slices(*wanted[:2]))
            yield from check_floats(manifest, record, blocks, manifest.world.sea_level_m)
    except BadInput as error:
        yield str(error)
