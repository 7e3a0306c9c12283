"""Unreal: one square `NAME_height.r16` for Landscape > Import from File, and the values to type into that dialog.

Facts from research, authoring 4: sizes are Epic's recommended ones; `.r16` is headerless little-endian uint16, row 0 =
least Y = north; `z_cm = (v - 32768) / 128 × ScaleZ + ActorZ`; axes +X east, +Y south, +Z up, centimetres; tiles end in
`_x0_y0`.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...level import BadInput
from . import common, flow
from .earlier import Piece
from .engine_records import LevelPart, Options, UnrealScale
from .heights import Words, part_notes, probes, write_heights
from .job import Job
from .layout import Layout, Tile, lay_out
from .manifest import describe
from .map_files import MapStyle, write_maps
from .mesh_places import PLACES
from .records import FileRecord, Manifest, Tiles
from .unreal_weights import weight_rows

MAPS = (
    ("height", "The ground, 16 bits, at the size Unreal recommends."),
    flow.MAP,
    *common.told(),
    *((row.name, row.doc) for row in weight_rows(None).values()),
)
STYLE = MapStyle(south_positive=True, green_down=True, meshes=PLACES["north-west"])
MID = 32768  # the value of z = 0, which is the sea
HIGHEST = 256 - 1 / 128  # metres above, and 256 below, at ScaleZ 100
TEXTURES = (
    "Pictures for materials: sRGB off, Mip Gen Settings NoMipmaps, X- and Y-axis Tiling Method Clamp; Compression "
    "Settings VectorDisplacementmap (RGBA8) for 8 bits, HDR High Precision (RGBA32F) for 16 bits and .exr"
)
FORMULA = "z_cm = (v - 32768) / 128 * ScaleZ + ActorZ"


class LandscapeSize(NamedTuple):
    """A recommended size: `samples` = components × sections × quads + 1 along a side."""

    samples: int
    quads: int
    sections: int
    components: int


SIZES = (
    LandscapeSize(127, 63, 2, 1),
    LandscapeSize(253, 63, 2, 2),
    LandscapeSize(505, 63, 2, 4),
    LandscapeSize(1009, 63, 2, 8),
    LandscapeSize(2017, 63, 2, 16),
    LandscapeSize(4033, 63, 2, 32),
    LandscapeSize(8129, 127, 2, 32),
)
SIDES = tuple(size.samples for size in SIZES)


def landscape_size(samples: int) -> LandscapeSize:
    """The smallest size with at least `samples` a side; BadInput past the largest."""
    for size in SIZES:
        if size.samples >= samples:
            return size
    raise BadInput(f"{samples} samples are more than Unreal's largest landscape has along a side: {SIDES[-1]}")


def smallest_scale_z(low_m: float, high_m: float) -> float:
    """The smallest ScaleZ that holds low … high metres about the sea, rounded up to the six digits one can type.

    Level ground at sea level needs none, so it gets the engine's default of 100.
    """
    scale = 100 * max(-low_m / 256, high_m / HIGHEST)
    return max(math.ceil(scale * 1e6 - 1e-7), 1) / 1e6 if scale > 0 else 100.0


def decode_cm(values: np.ndarray, scale_z: float, actor_z_cm: float = 0.0) -> np.ndarray:
    """What Unreal makes of the words of a height map: `LANDSCAPE_ZSCALE` is 1/128, `MidValue` 32768."""
    return (np.asarray(values, np.float64) - MID) / 128 * scale_z + actor_z_cm


def layout_of(shape: tuple[int, int], cell_m: float, options: Options) -> Layout:
    """The smallest landscape with room for every sample; past the largest, tiles."""
    return lay_out(shape, cell_m, SIDES, options, north_first=True, tiles=True)


def tile_name(stem: str, layout: Layout, tile: Tile) -> str:
    return f"{stem}_height_x{tile.col}_y{tile.row}.r16" if layout.tiled else f"{stem}_height.r16"


def words_of(scale: UnrealScale) -> Words:
    return Words(
        low_m=-MID * scale.scale_z / 12800,
        step_m=scale.scale_z / 12800,
        formula=FORMULA,
        numbers={"ScaleZ": scale.scale_z, "ActorZ": scale.actor_z_cm},
        decode=lambda values: decode_cm(values, scale.scale_z, scale.actor_z_cm) / 100,
        unit="cm",
        neutral=MID,
    )


def export(job: Job) -> Manifest:
    """Write the chosen maps and say everything about them."""
    level = job.level
    height, sea = level.height, level.sea_level_m
    layout = layout_of(level.grid.shape, level.grid.cell_m, job.options)
    scale = scale_of(layout, float(height.min()) - sea, float(height.max()) - sea)

    def ground() -> Piece:
        return write_heights(job, layout, words_of(scale), lambda tile: tile_name(job.name, layout, tile), MAPS[0][1])

    heights = job.piece("height", ground, ("height",))
    current = job.piece("flow", lambda: flow.write_flow(job, flow.UNREAL_FORMULA))
    pictures = common.write_common(job, STYLE, ("hlsl", "c"))
    weights = write_maps(job, STYLE, weight_rows(layout))
    recipe = _recipe([file.name for file in heights.files], scale, layout) if heights.files else []
    recipe = _with_layers(recipe, weights.files)
    recipe += [line for file in current.files for line in flow.recipe(file)]
    recipe += common.lines([*current.files, *pictures.files], TEXTURES)
    return Manifest(
        target="unreal",
        options=job.options,
        engine=scale,
        tiles=Tiles(rows=layout.tile_rows, cols=layout.tile_cols),
        files=heights.files + current.files + pictures.files + weights.files,
        empty=job.empty,
        probes=probes(job, layout),
        flow_probes=current.flow_probes,
        map_probes=pictures.map_probes + weights.map_probes,
        import_recipe=recipe,
        notes=part_notes(layout, heights.files),
        **describe(
            level,
            job.name,
            "north",
            origin="north-west corner of the level at the landscape actor, X 0 Y 0; Z 0 is the sea",
            axes="+X east, +Y south, +Z up, left-handed, centimetres; X = 100 x, Y = 100 (size_north - y), "
            "Z = 100 (height - sea level) for x, y, height of the level in metres",
        ),
    )


def scale_of(layout: Layout, low_m: float, high_m: float) -> UnrealScale:
    """What the dialog wants for every tile; its location is the first one's."""
    size = landscape_size(layout.side)
    scale_xy = 100 * layout.spacing_m
    east, south = layout.extent_m
    part = LevelPart(
        cols=layout.part_cols, rows=layout.part_rows, east_cm=100 * east, south_cm=100 * south, outside=layout.outside
    )
    return UnrealScale(
        resolution=size.samples,
        quads_per_section=size.quads,
        sections_per_component=f"{size.sections}x{size.sections}",
        components=f"{size.components}x{size.components}",
        sample_spacing_m=layout.spacing_m,
        scale_x=scale_xy,
        scale_y=scale_xy,
        scale_z=smallest_scale_z(low_m, high_m),
        dialog_x_cm=scale_xy * (size.samples - 1) / 2,
        dialog_y_cm=scale_xy * (size.samples - 1) / 2,
        level_part=part,
    )


def _with_layers(recipe: list[str], weights: list[FileRecord]) -> list[str]:
    """The ground's steps with the weights': the import knows only layers that the landscape's material has."""
    named = [(file.map.removeprefix("weight_"), file.name) for file in weights]
    if not named:
        return recipe
    return [
        "A material whose Landscape Layer Blend has layers named "
        f"{', '.join(layer for layer, _ in named)}; choose it as Material in the dialog",
        *recipe,
        "Layers: beside each + > Weight-Blended Layer, then its file",
        *(f"Layers > {layer}: {name}" for layer, name in named),
    ]


def _recipe(names: list[str], scale: UnrealScale, layout: Layout) -> list[str]:
    """What to do in the editor, in its own words, values to type included."""
    count = scale.resolution
    lines = [
        "Landscape mode > Manage > New > Import from File",
        f"Heightmap File: {names[0]} ({count} x {count})",
        f"Location: X {scale.dialog_x_cm:.6f} Y {scale.dialog_y_cm:.6f} Z {scale.dialog_z_cm:.6f} "
        "(the dialog wants the centre; the actor then stands at X 0 Y 0 Z 0)",
        f"Scale: X {scale.scale_x:.6f} Y {scale.scale_y:.6f} Z {scale.scale_z:.6f}",
        f"Section Size: {scale.quads_per_section}x{scale.quads_per_section} Quads, "
        f"Sections Per Component: {scale.sections_per_component}, Number of Components: {scale.components}",
    ]
    if layout.tiled:
        on = scale.scale_x * (count - 1)
        lines.append(
            f"{layout.tile_cols} x {layout.tile_rows} tiles, {names[0]} to {names[-1]}, x east and y south, all of "
            f"this size and scale; each shares its edge samples with the next, which stands {on:.6f} further on"
        )
    return [*lines, "The sea lies at Z 0."]
