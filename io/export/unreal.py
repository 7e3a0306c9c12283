"""Unreal: one square `NAME_height.r16` for Landscape > Import from File, and the values to type into that dialog.

Facts from research, authoring 4: sizes are Epic's recommended ones; `.r16` is headerless little-endian uint16, row 0 =
least Y = north; `z_cm = (v - 32768) / 128 × ScaleZ + ActorZ`; axes +X east, +Y south, +Z up, centimetres.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ...level import BadInput
from . import flow, map_rows, maps
from .job import Job
from .manifest import describe, describe_file
from .map_files import MapStyle, map_line, write_maps
from .records import Channel, Decode, FileRecord, LevelPart, Manifest, Probe, UnrealScale

MAPS = (("height", "The ground, 16 bits, at the size Unreal recommends."), flow.MAP, *map_rows.told())
MID = 32768  # the value of z = 0, which is the sea
HIGHEST = 256 - 1 / 128  # metres above, and 256 below, at ScaleZ 100
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


def landscape_size(samples: int) -> LandscapeSize:
    """The smallest size with at least `samples` a side; BadInput past the largest."""
    for size in SIZES:
        if size.samples >= samples:
            return size
    raise BadInput(
        f"this level has {samples} samples along its longer side and Unreal's largest landscape has "
        f"{SIZES[-1].samples}: crop or resize it first (`shorewright crop`, `shorewright resize`)"
    )


def smallest_scale_z(low_m: float, high_m: float) -> float:
    """The smallest ScaleZ that holds low … high metres about the sea, rounded up to the six digits one can type.

    Level ground at sea level needs none, so it gets the engine's default of 100.
    """
    scale = 100 * max(-low_m / 256, high_m / HIGHEST)
    return max(math.ceil(scale * 1e6 - 1e-7), 1) / 1e6 if scale > 0 else 100.0


def decode_cm(values: np.ndarray, scale_z: float, actor_z_cm: float = 0.0) -> np.ndarray:
    """What Unreal makes of the words of a height map: `LANDSCAPE_ZSCALE` is 1/128, `MidValue` 32768."""
    return (np.asarray(values, np.float64) - MID) / 128 * scale_z + actor_z_cm


class Square(NamedTuple):
    """Where a square of `size` samples reads the level: fractional `rows_at` from the north, `cols_at` from the west.

    Samples go over one to one, so that nothing is lost and ScaleX = ScaleY = 100 × cell; a level smaller than the
    square lies in its north-west corner, and south and east of it the edge goes on. Stretching the level over the
    square would put the landscape's samples between the level's and blunt every peak; ScaleX ≠ ScaleY would turn
    brushes into ellipses. Seabed that goes on surprises nobody, and the manifest says where it starts.
    """

    size: LandscapeSize
    rows_at: np.ndarray
    cols_at: np.ndarray
    spacing_m: float
    part: LevelPart


def square_over(rows: int, cols: int, cell_m: float) -> Square:
    """The smallest square that loses no resolution: room for every sample of the longer side, at the same spacing."""
    size = landscape_size(max(rows, cols))
    along = np.arange(size.samples, dtype=np.float64)
    whole = rows == cols == size.samples
    part = LevelPart(
        cols=cols,
        rows=rows,
        east_cm=100 * (cols - 1) * cell_m,
        south_cm=100 * (rows - 1) * cell_m,
        outside="the whole square is the level" if whole else "continues the edge of the level",
    )
    return Square(size, (rows - 1) - np.minimum(along, rows - 1), np.minimum(along, cols - 1), cell_m, part)


def export(job: Job) -> Manifest:
    """Write the chosen maps and say everything about them; BadInput for a level larger than Unreal takes."""
    level = job.level
    height, sea = level.height, level.sea_level_m
    square = square_over(*level.grid.shape, level.grid.cell_m)
    scale = _scale(square, float(height.min()) - sea, float(height.max()) - sea)
    files, recipe = [], []
    if "height" in job.maps:
        files.append(_height(job, square, scale))
        recipe += _recipe(files[0].name, scale)
    current = flow.write_flow(job, flow.UNREAL_FORMULA) if "flow" in job.maps else None
    if current:
        files.append(current[0])
        recipe += flow.recipe(current[0])
    pictures, map_probes = write_maps(job, MapStyle(south_positive=True, green_down=True))
    files += pictures
    recipe += [map_line(file) for file in pictures]
    return Manifest(
        target="unreal",
        engine=scale,
        files=files,
        probes=_probes(job, square),
        flow_probes=current[1] if current else [],
        map_probes=map_probes,
        import_recipe=recipe,
        notes=_notes(scale),
        **describe(
            level,
            job.name,
            "north",
            origin="north-west corner of the level at the landscape actor, X 0 Y 0; Z 0 is the sea",
            axes="+X east, +Y south, +Z up, left-handed, centimetres; X = 100 x, Y = 100 (size_north - y), "
            "Z = 100 (height - sea level) for x, y, height of the level in metres",
        ),
    )


def _scale(square: Square, low_m: float, high_m: float) -> UnrealScale:
    size = square.size
    scale_xy = 100 * square.spacing_m
    return UnrealScale(
        resolution=size.samples,
        quads_per_section=size.quads,
        sections_per_component=f"{size.sections}x{size.sections}",
        components=f"{size.components}x{size.components}",
        sample_spacing_m=square.spacing_m,
        scale_x=scale_xy,
        scale_y=scale_xy,
        scale_z=smallest_scale_z(low_m, high_m),
        dialog_x_cm=scale_xy * (size.samples - 1) / 2,
        dialog_y_cm=scale_xy * (size.samples - 1) / 2,
        level_part=square.part,
    )


def _height(job: Job, square: Square, scale: UnrealScale) -> FileRecord:
    """Write the height map."""
    step_m, sea = scale.scale_z / 12800, job.level.sea_level_m
    path = job.folder / f"{job.name}_height.r16"
    ground = ((rows, z - sea) for rows, z in maps.bilinear(job.level.height, square.rows_at, square.cols_at))
    maps.write_u16(path, ground, -MID * step_m, step_m)
    return _record(job, path, square, scale)


def _record(job: Job, path, square: Square, scale: UnrealScale) -> FileRecord:
    level, count = job.level, square.size.samples
    words = maps.open_u16(path, count, count)
    sea = level.sea_level_m

    def decode(values):
        return decode_cm(values, scale.scale_z, scale.actor_z_cm) / 100 + sea

    truth = maps.bilinear(level.height, square.rows_at, square.cols_at)
    error_m = maps.largest_difference(maps.row_blocks(words), truth, decode)
    return describe_file(
        path,
        map="height",
        doc=MAPS[0][1],
        width=count,
        height=count,
        bit_depth=16,
        sample_type="uint16",
        row_0="north",
        channels=[Channel(name="height", meaning="height above the sea", unit="cm", neutral=MID)],
        decode=Decode(formula=FORMULA, numbers={"ScaleZ": scale.scale_z, "ActorZ": scale.actor_z_cm}),
        step=scale.scale_z / 128,
        max_error=100 * error_m,
    )


def _probes(job: Job, square: Square) -> list[Probe]:
    """The level's ground at a 5 × 5 of the exported samples."""
    level, last = job.level, square.size.samples - 1
    at = np.unique(np.round(np.linspace(0, last, 5)).astype(int))
    values = np.concatenate([z for _, z in maps.bilinear(level.height, square.rows_at[at], square.cols_at[at])])
    north = level.grid.extent_m[1]
    return [
        Probe(
            col=int(col),
            row=int(row),
            x_m=float(col * square.spacing_m),
            y_m=float(north - row * square.spacing_m),
            height_m=float(values[i, j]),
        )
        for i, row in enumerate(at)
        for j, col in enumerate(at)
    ]


def _recipe(name: str, scale: UnrealScale) -> list[str]:
    """What to do in the editor, in its own words, values to type included."""
    count = scale.resolution
    return [
        "Landscape mode > Manage > New > Import from File",
        f"Heightmap File: {name} ({count} x {count})",
        f"Location: X {scale.dialog_x_cm:.6f} Y {scale.dialog_y_cm:.6f} Z {scale.dialog_z_cm:.6f} "
        "(the dialog wants the centre; the actor then stands at X 0 Y 0 Z 0)",
        f"Scale: X {scale.scale_x:.6f} Y {scale.scale_y:.6f} Z {scale.scale_z:.6f}",
        f"Section Size: {scale.quads_per_section}x{scale.quads_per_section} Quads, "
        f"Sections Per Component: {scale.sections_per_component}, Number of Components: {scale.components}",
        "The sea lies at Z 0.",
    ]


def _notes(scale: UnrealScale) -> list[str]:
    """What an artist should know about a level smaller than its landscape."""
    notes, part, count = [], scale.level_part, scale.resolution
    if (part.rows, part.cols) != (count, count):
        notes.append(
            f"The level is the north-west {part.cols} x {part.rows} samples ({part.east_cm:g} cm east, "
            f"{part.south_cm:g} cm south), sample for sample; beyond it the level's edge goes on."
        )
    return notes
