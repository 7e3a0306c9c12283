"""Raw files for engines and tools of one's own: the level's samples untouched, in formats that any of them opens.

`NAME_height.exr` is float32, one channel Y, which Blender, three and Godot all read right (research, files 3) and is
exact; `.r16` is the same ground in 16 bits for importers that know nothing else; both north first, as pictures are.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import common, flow, maps, meshes
from .earlier import Piece
from .heights import probes, write_floats
from .job import Job
from .layout import plain_layout
from .manifest import describe, describe_file
from .map_files import MapStyle
from .records import Channel, Decode, FileRecord, Manifest, Mesh

MAPS = (
    ("height", "The ground in metres, 16 bits (.r16) and float (.exr), sample for sample."),
    ("mesh", "The ground as a GLB mesh, thinned to its triangle budget where the level is larger."),
    ("layers", "The ground and every other written layer as a VTK image (.vti), for analysis."),
    ("weather", "The painted sky with its weights, six channels of float in a TIFF; only where something is painted."),
    flow.MAP,
    *common.told(),
)
DOCS = dict(MAPS)
R16_FORMULA = "height_m = v / 65535 * (max_m - min_m) + min_m"
METRES = "height_m = value"
SKY = "part = value, 0 to 1"
GLB_FORMULA = "x_m = X, y_m = -Z, height_m = Y"


def export(job: Job) -> Manifest:
    """Write the chosen files and say everything about them."""
    level = job.level
    pieces = [
        job.piece("height", lambda: Piece([_r16(job), _exr(job)]), ("height",)),
        job.piece("mesh", lambda: Piece([_glb(job)]), ("height",)),
        job.piece("layers", lambda: Piece([_vti(job)])),
        job.piece("weather", lambda: _weather(job), ("weather",)),
        job.piece("flow", lambda: flow.write_flow(job, flow.FORMULA)),
        common.write_common(job, MapStyle(), common.kit.LANGUAGES),
    ]
    files = [record for piece in pieces for record in piece.files]
    return Manifest(
        target="raw",
        files=files,
        empty=job.empty,
        probes=probes(job, plain_layout(level.grid.shape, level.grid.cell_m)),
        flow_probes=[probe for piece in pieces for probe in piece.flow_probes],
        map_probes=[probe for piece in pieces for probe in piece.map_probes],
        import_recipe=_recipe(job, files),
        **describe(
            level,
            job.name,
            "north",
            origin="south-west sample of the level at x 0, y 0; height 0 is the level's own zero",
            axes="x east, y north, height up, metres; pictures: column = x / cell, row = (size_north - y) / cell",
        ),
    )


def _height_channel() -> list[Channel]:
    return [Channel(name="height", meaning="height of the ground above the level's zero", unit="m")]


def _map_fields(job: Job) -> dict:
    return {"map": "height", "doc": DOCS["height"], "width": job.level.grid.cols, "height": job.level.grid.rows}


def decode_r16(words: np.ndarray, low_m: float, high_m: float) -> np.ndarray:
    """Metres from 16-bit words; 65535 is the top, as Godot's terrain plug-ins have it (Unity divides by 65536)."""
    return np.asarray(words, np.float64) / maps.TOP * (high_m - low_m) + low_m


def _r16(job: Job) -> FileRecord:
    height = job.level.height[::-1]
    low, high = float(height.min()), float(height.max())
    step = (high - low) / maps.TOP
    path = job.folder / f"{job.name}_height.r16"
    maps.write_u16(path, maps.row_blocks(height), low, step or 1.0)
    error_m = maps.largest_difference(
        maps.read_u16(path, *height.shape), maps.row_blocks(height), lambda values: decode_r16(values, low, high)
    )
    return describe_file(
        path,
        **_map_fields(job),
        bit_depth=16,
        sample_type="uint16",
        row_0="north",
        channels=_height_channel(),
        decode=Decode(formula=R16_FORMULA, numbers={"min_m": low, "max_m": high}),
        step=100 * step,
        max_error=100 * error_m,
    )


def _exr(job: Job) -> FileRecord:
    path = job.folder / f"{job.name}_height.exr"
    off = write_floats(path, job.level.height[::-1])
    return describe_file(
        path,
        **_map_fields(job),
        bit_depth=32,
        sample_type="float32",
        row_0="north",
        channels=[Channel(name="Y", meaning="height of the ground above the level's zero", unit="m")],
        decode=Decode(formula=METRES),
        max_error=100 * off,
    )


def _glb(job: Job) -> FileRecord:
    level = job.level
    mesh = meshes.terrain_mesh(level.height, level.grid.cell_m)
    path = job.folder / f"{job.name}_terrain.glb"
    meshes.write_glb(path, mesh, job.name)
    positions, _, faces = meshes.read_glb(path)
    wanted = np.asarray(level.height[np.ix_(mesh.rows_at, mesh.cols_at)], np.float64).ravel()
    return describe_file(
        path,
        map="mesh",
        doc=DOCS["mesh"],
        width=len(mesh.cols_at),
        height=len(mesh.rows_at),
        bit_depth=32,
        sample_type="float32",
        row_0=None,
        channels=[
            Channel(name="POSITION", meaning="X east, Y up, -Z north", unit="m"),
            Channel(name="NORMAL", meaning="normal of the ground", unit=""),
            Channel(name="TANGENT", meaning="to the east, square to the normal; w 1", unit=""),
            Channel(name="TEXCOORD_0", meaning="u east, v from the north edge to the south edge", unit=""),
        ],
        decode=Decode(formula=GLB_FORMULA),
        max_error=100 * float(np.abs(positions[:, 1] - wanted).max()),
        mesh=Mesh(
            vertices=len(positions),
            triangles=len(faces),
            triangle_budget=meshes.TRIANGLE_BUDGET,
            stride=mesh.stride,
            surface_error_cm=100 * meshes.surface_error_m(level.height, mesh),
        ),
    )


def _vti(job: Job) -> FileRecord:
    level = job.level
    path: Path = job.folder / f"{job.name}.vti"
    meshes.write_vti(path, level)
    image = meshes.read_vti(path)
    back = np.asarray(image.point_data["height"]).reshape(level.grid.shape)
    channels = _height_channel()
    for name in meshes.vti_layers(level):
        row = level.layers[name].row
        channels.append(Channel(name=name, meaning=f"{row.doc} ({', '.join(row.channels)})", unit=row.unit, neutral=0))
    return describe_file(
        path,
        map="layers",
        doc=DOCS["layers"],
        width=level.grid.cols,
        height=level.grid.rows,
        bit_depth=32,
        sample_type="float32",
        row_0="south",
        channels=channels,
        decode=Decode(formula=METRES),
        max_error=100 * maps.largest_difference(maps.row_blocks(back), maps.row_blocks(level.height)),
    )


def _weather(job: Job) -> Piece:
    """The painted sky, sample for sample, on its own grid (Z04); nothing where none is painted."""
    from ..images import read_image, write_image

    data = job.level.layers["weather"]
    if data.neutral:
        return Piece()
    samples = np.ascontiguousarray(data.array[::-1])
    path = job.folder / f"{job.name}_weather.tif"
    names = data.row.channels
    write_image(path, samples, channels=[*"RGBA", *(f"C{n}" for n in range(4, len(names)))])
    meanings = {"coverage": "share of the sky under cloud", "precipitation": "rain or snow",
                "type": "0 stratus, 1 cumulus"}  # fmt: skip
    channels = [Channel(name=n, meaning=meanings.get(n, f"how much the paint counts: {n}"), unit="") for n in names]
    record = describe_file(
        path,
        map="weather",
        doc=DOCS["weather"],
        width=data.grid.cols,
        height=data.grid.rows,
        bit_depth=32,
        sample_type="float32",
        row_0="north",
        channels=channels,
        decode=Decode(formula=SKY),
        max_error=100 * float(np.abs(read_image(path) - samples).max()),
    )
    return Piece([record])


def _recipe(job: Job, files: list[FileRecord]) -> list[str]:
    grid = job.level.grid
    lines = {
        ".r16": f"{grid.cols} x {grid.rows} little-endian uint16 without a header, north row first: {R16_FORMULA}",
        ".exr": f"{grid.cols} x {grid.rows} float32, channel Y in metres, north row first",
        ".glb": "metres, Y up, north is -Z, the south-west corner at X 0 Z 0",
        ".vti": f"{grid.cols} x {grid.rows} points, south row first, for ParaView or pyvista.read",
        ".tif": _sky_line(job),
    }
    own = [file for file in files if file.map not in {"flow", *common.NAMES}]
    told = [f"{file.name}: {lines[Path(file.name).suffix]}" for file in own]
    told += [line for file in files if file.map == "flow" for line in flow.recipe(file)]
    told += common.lines(files)
    return [*told, f"One sample every {grid.cell_m:g} m; the sea lies at height {job.level.sea_level_m:g} m."]


def _sky_line(job: Job) -> str:
    grid, weather = job.level.layers["weather"].grid, job.level.settings.weather
    return (
        f"{grid.cols} x {grid.rows} float32, six channels, north row first, {grid.cell_m:g} m a sample, tiling; its "
        f"middle (row {grid.rows // 2 - 1}, column {grid.cols // 2}) stands at x {weather.east_m:g}, "
        f"y {weather.north_m:g} m at time 0"
    )
