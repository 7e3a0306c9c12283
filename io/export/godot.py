"""Godot's two terrain plug-ins: Terrain3D (float metres, any size) and HTerrain (16 bits, squares of 2ⁿ + 1).

Facts from research, authoring 4 and files 3: axes +X east, +Y up, +Z south, metres; picture column → +X, row → +Z, so
north comes first. Godot 4 reads 16-bit PNG as 8 bits, so deep maps are EXR floats; a height EXR has channel Y. Both
plug-ins read words as `v / 65535 × (max − min) + min` and know neither range nor size from the file.
"""

from __future__ import annotations

import numpy as np

from ...level import BadInput
from . import common, flow, maps
from .earlier import Piece
from .engine_records import GodotTerrain, Options
from .heights import Words, part_notes, probes, write_floats, write_heights
from .job import Job
from .layout import Layout, lay_out, plain_layout
from .manifest import describe, describe_file
from .map_files import MapStyle
from .mesh_places import PLACES
from .records import Channel, Decode, FileRecord, Manifest

STYLE = MapStyle(deep_png=False, south_positive=True, meshes=PLACES["north-west"])
SIDES = tuple(2**n + 1 for n in range(6, 13))  # HTerrain: 65 … 4097
MOST = 16384  # Terrain3D: samples a side of a picture
REGIONS = (64, 128, 256, 512, 1024, 2048)  # and it has 32 regions a side
TEXTURES = (
    "Textures, in the Import dock: Compress > Mode Lossless, Detect 3D > Compress To Disabled, Process > Fix Alpha "
    "Border off, Mipmaps > Generate off; in shaders a sampler without source_color, with repeat_disable"
)
R16_FORMULA = "height_m = v / 65535 * (max_m - min_m) + min_m"
EXR_FORMULA = "height_m = value"
TERRAIN3D_MAPS = (
    ("height", "The ground over the sea in metres, float (.exr) and 16 bits (.r16), sample for sample."),
    flow.MAP,
    *common.told(),
)
HTERRAIN_MAPS = (("height", "The ground, 16 bits, at a size HTerrain takes."), flow.MAP, *common.told())


def decode_m(values: np.ndarray, low_m: float, high_m: float) -> np.ndarray:
    """Metres over the sea, as both plug-ins make them of words."""
    return np.asarray(values, np.float64) / maps.TOP * (high_m - low_m) + low_m


def terrain3d_layout(shape: tuple[int, int], cell_m: float, whose: str = "Terrain3D") -> Layout:
    """The level as it is; BadInput when Terrain3D, as Godot itself, takes no picture of that size."""
    if max(shape) > MOST:
        raise BadInput(
            f"this level has {max(shape)} samples along its longer side and {whose}'s largest height map has {MOST}: "
            "crop or resize it first (`shorewright crop`, `shorewright resize`)"
        )
    return plain_layout(shape, cell_m)


def hterrain_layout(shape: tuple[int, int], cell_m: float, options: Options) -> Layout:
    return lay_out(shape, cell_m, SIDES, options, north_first=True, tiles=False)


def region_size(side: int) -> int:
    """The smallest of Terrain3D's regions, 32 of which hold that many samples."""
    return next(size for size in REGIONS if 32 * size >= side)


def range_m(level) -> tuple[float, float]:
    """Lowest and highest ground over the sea; level ground is given a metre of room."""
    low, high = float(level.height.min()) - level.sea_level_m, float(level.height.max()) - level.sea_level_m
    return low, high if high > low else low + 1.0


def terrain_of(layout: Layout, plugin: str, low_m: float, high_m: float) -> GodotTerrain:
    rows, cols = len(layout.rows_at), len(layout.cols_at)
    region = region_size(max(rows, cols)) if plugin == "terrain3d" else None
    return GodotTerrain(
        plugin=plugin, cols=cols, rows=rows, spacing_m=layout.spacing_m, min_m=low_m, max_m=high_m, region_size=region,
        level_part=layout.part(),
    )  # fmt: skip


def words_of(terrain: GodotTerrain) -> Words:
    low, high = terrain.min_m, terrain.max_m
    return Words(
        low_m=low,
        step_m=(high - low) / maps.TOP,
        formula=R16_FORMULA,
        numbers={"min_m": low, "max_m": high},
        decode=lambda values: decode_m(values, low, high),
    )


def terrain3d(job: Job) -> Manifest:
    """Write the chosen maps for Terrain3D: the height as `.exr` and as `.r16`, either of which it imports."""
    grid = job.level.grid
    layout = terrain3d_layout(grid.shape, grid.cell_m)
    terrain = terrain_of(layout, "terrain3d", *range_m(job.level))
    doc = TERRAIN3D_MAPS[0][1]

    def ground() -> Piece:
        made = write_heights(job, layout, words_of(terrain), lambda _: f"{job.name}_height.r16", doc)
        return Piece([_exr(job, doc), *made.files])

    return _manifest(job, layout, terrain, ground, "godot", _terrain3d_recipe(job.name, terrain))


def hterrain(job: Job) -> Manifest:
    """Write the chosen maps for HTerrain, which refuses any other extension than `.raw`."""
    grid = job.level.grid
    layout = hterrain_layout(grid.shape, grid.cell_m, job.options)
    terrain = terrain_of(layout, "hterrain", *range_m(job.level))

    def ground() -> Piece:
        name = f"{job.name}_height.raw"
        return write_heights(job, layout, words_of(terrain), lambda _: name, HTERRAIN_MAPS[0][1])

    return _manifest(job, layout, terrain, ground, "godot-hterrain", _hterrain_recipe(job.name, terrain))


def _manifest(job: Job, layout: Layout, terrain: GodotTerrain, ground, target: str, recipe: list[str]) -> Manifest:
    heights = job.piece("height", ground, ("height",))
    current = job.piece("flow", lambda: flow.write_flow(job, flow.GODOT_FORMULA))
    pictures = common.write_common(job, STYLE, ("godot", "c"))
    return Manifest(
        target=target,
        options=job.options,
        engine=terrain,
        files=heights.files + current.files + pictures.files,
        empty=job.empty,
        probes=probes(job, layout),
        flow_probes=current.flow_probes,
        map_probes=pictures.map_probes,
        import_recipe=[
            *(recipe if heights.files else []),
            *(line for file in current.files for line in flow.recipe(file)),
            *common.lines([*current.files, *pictures.files], TEXTURES),
        ],
        notes=part_notes(layout, heights.files) + _notes(terrain),
        **describe(
            job.level,
            job.name,
            "north",
            origin="north-west corner of the level at X 0 Z 0; Y 0 is the sea",
            axes="+X east, +Y up, +Z south, right-handed, metres; X = x, Y = height - sea level, Z = size_north - y",
        ),
    )


def _exr(job: Job, doc: str) -> FileRecord:
    height = job.level.height[::-1]
    path = job.folder / f"{job.name}_height.exr"
    off = write_floats(path, height, job.level.sea_level_m)
    return describe_file(
        path,
        map="height",
        doc=doc,
        width=height.shape[1],
        height=height.shape[0],
        bit_depth=32,
        sample_type="float32",
        row_0="north",
        channels=[Channel(name="Y", meaning="height above the sea", unit="m", neutral=0)],
        decode=Decode(formula=EXR_FORMULA),
        max_error=100 * off,
    )


def _notes(terrain: GodotTerrain) -> list[str]:
    """What lies beside the level where its size isn't one of whole regions."""
    size = terrain.region_size
    if size is None or terrain.cols % size == terrain.rows % size == 0:
        return []
    return [
        f"Terrain3D fills its last regions of {size} x {size} beyond the level's {terrain.cols} x {terrain.rows} "
        "samples by itself: what stands there is not of this export."
    ]


def _terrain3d_recipe(stem: str, terrain: GodotTerrain) -> list[str]:
    return [
        "Terrain3D's importer scene (addons/terrain_3d/tools/importer.tscn), its inspector:",
        f"Region Size {terrain.region_size}, Vertex Spacing {terrain.spacing_m:.10g}",
        f"Height File Name: {stem}_height.exr; Import Position 0, 0; Import Scale 1; Height Offset 0",
        f"or {stem}_height.r16: R16 Range {terrain.min_m:.9g}, {terrain.max_m:.9g}; R16 Size {terrain.cols}, "
        f"{terrain.rows}",
        "Run Import, then save it to a data directory. The sea lies at Y 0.",
    ]


def _hterrain_recipe(stem: str, terrain: GodotTerrain) -> list[str]:
    return [
        f"An HTerrain node at 0, 0, 0, Centered off, Map Scale X {terrain.spacing_m:.10g} Y 1 Z "
        f"{terrain.spacing_m:.10g}",
        f"Terrain menu > Import maps: Heightmap {stem}_height.raw, {terrain.cols} x {terrain.rows}, Raw Endianness "
        f"Little Endian, Bit Depth 16, Min Height {terrain.min_m:.9g}, Max Height {terrain.max_m:.9g}",
        "The import cannot be undone. The sea lies at Y 0.",
    ]
