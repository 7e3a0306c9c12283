"""Unity: RAW16 height maps without a header, south row first, and the numbers for the terrain that reads them.

Facts from research, authoring 4 and files 3: sides of 2ⁿ + 1 from 33 to 4097, the byte order of Windows, first row at
z = 0, so *Flip Vertically* stays off; `y = v / 65536 × height` (Unity's importer; its Terrain Tools divide by 65535);
tiles end in `_x_z`. Axes +X east, +Y up, +Z north, left-handed, metres. Normals have green up; textures north first.
"""

from __future__ import annotations

import math

import numpy as np

from ...level import Level
from . import common, flow
from .earlier import Piece
from .engine_records import Options, UnityTerrain
from .heights import Words, part_notes, probes, write_heights
from .job import Job
from .layout import Layout, Tile, lay_out
from .manifest import describe
from .map_files import MapStyle, map_line, write_maps
from .map_makers import MapRow, Samples
from .map_makers import flow as whole_flow
from .mesh_places import PLACES
from .records import Channel, FileRecord, Manifest, Tiles

SIDES = tuple(2**n + 1 for n in range(5, 13))  # 33 … 4097
DIVISOR = 65536
GPU_STEPS = 32766  # Unity's shaders keep a terrain's heights in this many steps
LEAST_HEIGHT_M = 1.0
FORMULA = "y_m = v / 65536 * terrain_height_m + position_y_m"
TEXTURES = (
    "Textures, in their import settings: sRGB off, Alpha Is Transparency off, Non-Power of 2 None, Generate Mipmaps "
    "off, Wrap Mode Clamp, Max Size no smaller than the picture, Compression None; for 16 bits and .exr a Format as "
    "deep (R 16 bit, RGB 48 bit, RGBA Float)"
)
STYLE = MapStyle(meshes=PLACES["x-negated"])


def crest(level: Level) -> Samples | None:
    """The current as Crest 4's *Add Flow Map* reads it: (rg − 0.5) × strength. Floats, for no whole number is 0.5."""
    made = whole_flow(level)
    if made is None:
        return None
    strength = 2 * made.numbers["range_mps"]
    return Samples(made.values / np.float32(strength) + np.float32(0.5), made.cell_m, numbers={"strength": strength})


OWN: dict[str, MapRow] = {
    "flow_crest": MapRow(
        "flow_crest",
        "The whole current for Crest 4's Add Flow Map: velocity = (value - 0.5) * strength, exactly 0.5 where still.",
        (
            Channel(name="east", meaning="current to the east over strength, and a half", unit="", neutral=0.5),
            Channel(name="north", meaning="current to the north over strength, and a half", unit="", neutral=0.5),
        ),
        crest,
        "float",
    )
}
MAPS = (
    ("height", "The ground, 16 bits, at a size Unity's terrain takes; tiles where it is larger than 4097."),
    flow.MAP,
    *common.told(),
    *((row.name, row.doc) for row in OWN.values()),
)


def layout_of(shape: tuple[int, int], cell_m: float, options: Options) -> Layout:
    """The smallest terrain with room for every sample, its first row in the south; past the largest, tiles."""
    return lay_out(shape, cell_m, SIDES, options, north_first=False, tiles=True)


def tile_name(stem: str, layout: Layout, tile: Tile) -> str:
    return f"{stem}_height_{tile.col}_{tile.row}.raw" if layout.tiled else f"{stem}_height.raw"


def decode_m(values: np.ndarray, terrain: UnityTerrain) -> np.ndarray:
    """Metres over the sea, as Unity's RAW importer makes them of words."""
    return np.asarray(values, np.float64) / DIVISOR * terrain.terrain_height_m + terrain.position_y_m


def terrain_of(layout: Layout, low_m: float, high_m: float) -> UnityTerrain:
    """The least terrain over low … high metres about the sea, in whole centimetres, which one can type.

    The largest word is 65535 and the divisor 65536, so the terrain is a step higher than the ground.
    """
    position_m = math.floor(100 * low_m + 1e-6) / 100
    height_m = max(math.ceil(100 * (high_m - position_m) * DIVISOR / (DIVISOR - 1) - 1e-6) / 100, LEAST_HEIGHT_M)
    if high_m > position_m + height_m * (DIVISOR - 1) / DIVISOR or low_m < position_m:
        position_m, height_m = round(position_m - 0.01, 2), round(height_m + 0.02, 2)
    on_m = (layout.side - 1) * layout.spacing_m
    return UnityTerrain(
        heightmap_resolution=layout.side,
        sample_spacing_m=layout.spacing_m,
        terrain_width_m=on_m,
        terrain_length_m=on_m,
        terrain_height_m=height_m,
        position_y_m=position_m,
        sea_level_share=(0.0 - position_m) / height_m,
        gpu_step_cm=100 * height_m / GPU_STEPS,
        level_part=layout.part(),
    )


def words_of(terrain: UnityTerrain) -> Words:
    return Words(
        low_m=terrain.position_y_m,
        step_m=terrain.terrain_height_m / DIVISOR,
        formula=FORMULA,
        numbers={"terrain_height_m": terrain.terrain_height_m, "position_y_m": terrain.position_y_m},
        decode=lambda values: decode_m(values, terrain),
    )


def export(job: Job) -> Manifest:
    """Write the chosen maps and say everything about them."""
    level = job.level
    height, sea = level.height, level.sea_level_m
    layout = layout_of(level.grid.shape, level.grid.cell_m, job.options)
    terrain = terrain_of(layout, float(height.min()) - sea, float(height.max()) - sea)

    def ground() -> Piece:
        return write_heights(job, layout, words_of(terrain), lambda tile: tile_name(job.name, layout, tile), MAPS[0][1])

    heights = job.piece("height", ground, ("height",))
    current = job.piece("flow", lambda: flow.write_flow(job, flow.UNITY_FORMULA))
    pictures, own = common.write_common(job, STYLE, ("hlsl", "c")), write_maps(job, STYLE, OWN)
    files = heights.files + current.files + pictures.files + own.files
    return Manifest(
        target="unity",
        options=job.options,
        engine=terrain,
        tiles=Tiles(rows=layout.tile_rows, cols=layout.tile_cols),
        files=files,
        empty=job.empty,
        probes=probes(job, layout),
        flow_probes=current.flow_probes,
        map_probes=pictures.map_probes + own.map_probes,
        import_recipe=[
            *(_recipe([file.name for file in heights.files], terrain, layout) if heights.files else []),
            *(line for file in current.files for line in flow.recipe(file)),
            *common.lines([*current.files, *pictures.files, *own.files], TEXTURES),
            *(map_line(file) for file in own.files),
            *(_crest_line(file) for file in own.files),
        ],
        notes=part_notes(layout, heights.files) + _notes(terrain, files),
        **describe(
            level,
            job.name,
            "south",
            origin="south-west corner of the level at X 0 Z 0; Y 0 is the sea",
            axes="+X east, +Y up, +Z north, left-handed, metres; X = x, Y = height - sea level, Z = y",
        ),
    )


def _recipe(names: list[str], terrain: UnityTerrain, layout: Layout) -> list[str]:
    """What to do in the editor, values to type included."""
    n, wide = terrain.heightmap_resolution, f"{terrain.terrain_width_m:.10g}"
    lines = [
        f"GameObject > 3D Object > Terrain; its Transform: Position X 0 Y {terrain.position_y_m:.2f} Z 0",
        f"Terrain Settings > Texture Resolutions > Heightmap Resolution {n} x {n}, before the import",
        f"Terrain Settings > Import Raw: {names[0]}, Depth Bit 16, Resolution {n} x {n}, Byte Order Windows, "
        f"Flip Vertically off, Terrain Size X {wide} Y {terrain.terrain_height_m:.2f} Z {wide}",
    ]
    if layout.tiled:
        lines.append(
            f"{layout.tile_cols} x {layout.tile_rows} terrains of this size, {names[0]} to {names[-1]} by _x_z: "
            f"tile x, z stands at X {wide} x, Z {wide} z, all at the same Y; neighbours share their edge samples"
        )
    return [*lines, f"The sea lies at Y 0, which is {terrain.sea_level_share:.6f} of the terrain's height."]


def _crest_line(record: FileRecord) -> str:
    """Where the quad of Crest 4's flow input lies: texels reach half a cell beyond the samples."""
    numbers = record.decode.numbers
    cell_m = numbers["cell_m"]
    middle, wide = ([n * cell_m for n in of] for of in (
        ((record.width - 1) / 2, (record.height - 1) / 2), (record.width, record.height)
    ))  # fmt: skip
    return (
        f"Crest 4: a quad facing up at X {middle[0]:.10g} Z {middle[1]:.10g}, {wide[0]:.10g} x {wide[1]:.10g} m, with "
        f"Register Flow Input and the material Add Flow Map: Flow Map {record.name}, Strength {numbers['strength']:g}, "
        "no flips"
    )


def _notes(terrain: UnityTerrain, files: list[FileRecord]) -> list[str]:
    """What Unity makes of these files that their bytes don't tell."""
    maps = {file.map: file for file in files}
    notes = []
    if "height" in maps:
        notes += [
            f"{FORMULA}: Unity's RAW import divides by 65536. Terrain Tools' own height map import divides by 65535 "
            "and puts the top one step higher.",
            f"Unity's shaders keep heights in {GPU_STEPS} steps: what is drawn stands up to "
            f"{terrain.gpu_step_cm / 2:.3g} cm off the file.",
        ]
    if "flow16" in maps or "flow" in maps:
        notes.append(
            "Still water is 32768 of 65535 or 128 of 255 in the pictures of the current, which a shader has to take "
            "off; (rg - 0.5) * strength would drift by strength / 131070 or strength / 510. flow_crest has 0.5."
        )
        notes.append(
            "HDRP's current map holds a direction and a share, not a speed, and cannot stand still: none of these "
            "pictures is one."
        )
    return notes
