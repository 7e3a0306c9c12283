"""An export for Unity: the terrain's numbers, words and tiles, the current, the maps."""

from __future__ import annotations

from pathlib import Path

from ...level import BadInput
from . import flow
from .common import check_common
from .engine_records import UnityTerrain
from .records import Manifest
from .unity import OWN, layout_of, terrain_of, tile_name, words_of
from .verify_flow import check_flow
from .verify_ground import check_heights, own_records, said_otherwise
from .verify_map_files import check_maps


def check_unity(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about terrains; `whole` are the listed files whose bytes are the ones written."""
    own, terrain, world = own_records(manifest, OWN), manifest.engine, manifest.world
    if not manifest.files or set(own) - {"height", "flow"} or not isinstance(terrain, UnityTerrain):
        return ["a Unity export has height maps, currents or maps and says how to place them; this manifest does not"]
    source = manifest.source
    try:
        layout = layout_of((source.rows, source.cols), source.cell_m, manifest.options)
    except BadInput as error:
        return [str(error)]
    low, high = world.height_min_m - world.sea_level_m, world.height_max_m - world.sea_level_m
    findings = [*said_otherwise(terrain, terrain_of(layout, low, high))]
    if "height" in own:
        findings += check_heights(
            manifest, own["height"], whole, layout, words_of(terrain), lambda t: tile_name(source.name, layout, t)
        )
    for record in own.get("flow", []):
        findings += check_flow(manifest, record, whole, flow.UNITY_FORMULA)
    return findings + check_maps(manifest, whole, OWN) + check_common(manifest, whole)
