"""An export for Unreal: scale, sizes, words and tiles of the landscape, the current, the maps."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from ...level import BadInput
from . import flow
from .common import check_common
from .engine_records import UnrealScale
from .records import Manifest
from .unreal import MID, layout_of, scale_of, tile_name, words_of
from .unreal_weights import weight_rows
from .verify_flow import check_flow
from .verify_ground import check_heights, near, own_records
from .verify_map_files import check_maps


def check_unreal(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about a landscape; `whole` are the listed files whose bytes are the ones written."""
    weights = weight_rows(None)
    own, scale = own_records(manifest, weights), manifest.engine
    if not manifest.files or set(own) - {"height", "flow"} or not isinstance(scale, UnrealScale):
        return ["an Unreal export has one height map or current and says how to scale it; this manifest does not"]
    source = manifest.source
    try:
        layout = layout_of((source.rows, source.cols), source.cell_m, manifest.options)
    except BadInput as error:
        return [str(error)]
    findings = [*_scale(manifest, scale, layout)]
    if "height" in own:
        stem = source.name
        findings += check_heights(
            manifest, own["height"], whole, layout, words_of(scale), lambda tile: tile_name(stem, layout, tile)
        )
    for record in own.get("flow", []):
        findings += check_flow(manifest, record, whole, flow.UNREAL_FORMULA)
    return findings + check_maps(manifest, whole, weights) + check_common(manifest, whole)


def _scale(manifest: Manifest, scale: UnrealScale, layout) -> Iterator[str]:
    """The landscape's size and scale, worked out again from the level's size and range."""
    world = manifest.world
    low, high = world.height_min_m - world.sea_level_m, world.height_max_m - world.sea_level_m
    wanted = scale_of(layout, low, high)
    if scale.resolution != wanted.resolution:
        yield (
            f"a landscape of {scale.resolution} samples a side is not the smallest that holds this level: "
            f"{wanted.resolution}"
        )
    if not (near(scale.scale_x, wanted.scale_x) and near(scale.scale_y, wanted.scale_y)):
        yield (f"ScaleX {scale.scale_x} and ScaleY {scale.scale_y} should be {wanted.scale_x}: 100 × world_m / (N - 1)")
    if abs(scale.scale_z - wanted.scale_z) > 2e-6:
        yield f"ScaleZ {scale.scale_z} is not the smallest that holds {low} to {high} m: {wanted.scale_z}"
    if (scale.actor_z_cm, scale.sea_level_v, scale.sea_level_z_cm) != (0.0, MID, 0.0):
        yield f"the sea has to lie at Z 0 = value {MID}"
    if scale.level_part != wanted.level_part:
        yield "the part of the landscape that is the level is stated wrongly"
