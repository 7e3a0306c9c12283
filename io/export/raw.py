"""Raw files for engines and tools of one's own: the level's samples untouched, in formats that any of them opens.

`NAME_height.exr` is float32, one channel Y, which Blender, three and Godot all read right (research, files 3) and is
exact; `.r16` is the same ground in 16 bits for importers that know nothing else; both north first, as pictures are.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from . import flow, map_rows, maps, meshes
from .job import Job
from .kit import files as kit
from .manifest import describe, describe_file
from .map_files import MapStyle, map_line, write_maps
from .records import Channel, Decode, FileRecord, Manifest, Mesh, Probe

MAPS = (
    ("height", "The ground in metres, 16 bits (.r16) and float (.exr), sample for sample."),
    ("mesh", "The ground as a GLB mesh, thinned to its triangle budget where the level is larger."),
    ("layers", "The ground and every other written layer as a VTK image (.vti), for analysis."),
    ("weather", "The painted sky with its weights, six channels of float in a TIFF; only where something is painted."),
    flow.MAP,
    *map_rows.told(),
    kit.MAP,
)
DOCS = dict(MAPS)
R16_FORMULA = "height_m = v / 65535 * (max_m - min_m) + min_m"
METRES = "height_m = value"
SKY = "part = value, 0 to 1"
GLB_FORMULA = "x_m = X, y_m = -Z, height_m = Y"


def export(job: Job) -> Manifest:
    """Write the chosen files and say everything about them."""
    level = job.level
    files: list[FileRecord] = []
    if "height" in job.maps:
        files += [_r16(job), _exr(job)]
    if "mesh" in job.maps:
        files.append(_glb(job))
    if "layers" in job.maps:
        files.append(_vti(job))
    if "weather" in job.maps and not level.layers["weather"].neutral:
        files.append(_weather(job))
    current = flow.write_flow(job, flow.FORMULA) if "flow" in job.maps else None
    if current:
        files.append(current[0])
    pictures, map_probes = write_maps(job, MapStyle())
    files += [*pictures, *kit.write_kit(job, kit.LANGUAGES)]
    return Manifest(
        target="raw",
        files=files,
        probes=_probes(job),
        flow_probes=current[1] if current else [],
        map_probes=map_probes,
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
    words = maps.open_u16(path, *height.shape)
    error_m = maps.largest_difference(
        maps.row_blocks(words), maps.row_blocks(height), lambda values: decode_r16(values, low, high)
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
    from ..images import read_image, write_image

    height = job.level.height[::-1]
    path = job.folder / f"{job.name}_height.exr"
    write_image(path, np.ascontiguousarray(height)[..., None])
    back = read_image(path)
    return describe_file(
        path,
        **_map_fields(job),
        bit_depth=32,
        sample_type="float32",
        row_0="north",
        channels=[Channel(name="Y", meaning="height of the ground above the level's zero", unit="m")],
        decode=Decode(formula=METRES),
        max_error=100 * maps.largest_difference(maps.row_blocks(back[..., 0]), maps.row_blocks(height)),
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


def _weather(job: Job) -> FileRecord:
    """The painted sky, sample for sample, on its own grid (Z04)."""
    from ..images import read_image, write_image

    data = job.level.layers["weather"]
    samples = np.ascontiguousarray(data.array[::-1])
    path = job.folder / f"{job.name}_weather.tif"
    names = data.row.channels
    write_image(path, samples, channels=[*"RGBA", *(f"C{n}" for n in range(4, len(names)))])
    meanings = {"coverage": "share of the sky under cloud", "precipitation": "rain or snow",
                "type": "0 stratus, 1 cumulus"}  # fmt: skip
    channels = [Channel(name=n, meaning=meanings.get(n, f"how much the paint counts: {n}"), unit="") for n in names]
    return describe_file(
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


def _probes(job: Job) -> list[Probe]:
    """The level's ground at a 5 × 5 of its samples, counted from the north as the pictures are."""
    grid, height = job.level.grid, job.level.height
    return [
        Probe(
            col=int(col),
            row=int(row),
            x_m=float(col * grid.cell_m),
            y_m=float((grid.rows - 1 - row) * grid.cell_m),
            height_m=float(height[grid.rows - 1 - row, col]),
        )
        for row in np.unique(np.round(np.linspace(0, grid.rows - 1, 5)).astype(int))
        for col in np.unique(np.round(np.linspace(0, grid.cols - 1, 5)).astype(int))
    ]


def _recipe(job: Job, files: list[FileRecord]) -> list[str]:
    grid = job.level.grid
    lines = {
        ".r16": f"{grid.cols} x {grid.rows} little-endian uint16 without a header, north row first: {R16_FORMULA}",
        ".exr": f"{grid.cols} x {grid.rows} float32, channel Y in metres, north row first",
        ".glb": "metres, Y up, north is -Z, the south-west corner at X 0 Z 0",
        ".vti": f"{grid.cols} x {grid.rows} points, south row first, for ParaView or pyvista.read",
        ".tif": _sky_line(job),
    }
    own = [file for file in files if file.map not in {"flow", kit.NAME, *map_rows.MAPS}]
    told = [f"{file.name}: {lines[Path(file.name).suffix]}" for file in own]
    told += [line for file in files if file.map == "flow" for line in flow.recipe(file)]
    told += [map_line(file) for file in files if file.map in map_rows.MAPS]
    told += [kit.kit_line(file) for file in files if file.map == kit.NAME]
    return [*told, f"One sample every {grid.cell_m:g} m; the sea lies at height {job.level.sea_level_m:g} m."]


def _sky_line(job: Job) -> str:
    grid, weather = job.level.layers["weather"].grid, job.level.settings.weather
    return (
        f"{grid.cols} x {grid.rows} float32, six channels, north row first, {grid.cell_m:g} m a sample, tiling; its "
        f"middle (row {grid.rows // 2 - 1}, column {grid.cols // 2}) stands at x {weather.east_m:g}, "
        f"y {weather.north_m:g} m at time 0"
    )
