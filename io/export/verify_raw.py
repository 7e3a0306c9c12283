"""Files of a raw export: what they must decode to, beyond being the bytes that were written."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ...level import LAYERS, BadInput
from ...level.layers import WEATHER_GRID
from . import flow, maps, meshes
from .common import NAMES, check_common
from .raw import R16_FORMULA, decode_r16
from .records import FileRecord, Manifest
from .verify_flow import check_flow
from .verify_ground import SLACK_CM, check_floats, check_probes, check_range, check_step


@dataclass(frozen=True)
class Ground:
    """Exact heights `(rows, cols)`, north first, metres, that are read some rows at a time."""

    shape: tuple[int, int]
    walk: Callable[[Iterable[slice]], Iterator[maps.Block]]

    def blocks(self) -> Iterator[maps.Block]:
        return self.walk(maps.row_slices(*self.shape))


def check_raw(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about raw files: each against the probes, the 16 bits and the mesh against the float map."""
    findings: list[str] = []
    ground: Ground | None = None
    own = [record for record in manifest.files if record.map not in NAMES]
    by_suffix = {Path(record.name).suffix: record for record in own}
    unknown = sorted(set(by_suffix) - {".r16", ".exr", ".vti", ".glb", ".tif", ".png"})
    if unknown or len(by_suffix) != len(own):
        findings.append("the manifest lists files that are no part of a raw export")
    for suffix, open_ground in ((".vti", _open_vti), (".exr", _open_exr)):
        if suffix in by_suffix and by_suffix[suffix].name in whole:
            found, exact = _exact(manifest, by_suffix[suffix], whole, open_ground)
            findings += found
            ground = None if found else exact  # one of them in memory at a time
    if ".r16" in by_suffix:
        findings += _raw_words(manifest, by_suffix[".r16"], whole, ground)
    if ".glb" in by_suffix:
        findings += _mesh(manifest, by_suffix[".glb"], whole, ground)
    if ".tif" in by_suffix:
        findings += _sky(by_suffix[".tif"], whole)
    if ".png" in by_suffix:
        findings += check_flow(manifest, by_suffix[".png"], whole, flow.FORMULA)
    return findings + check_common(manifest, whole)


def _sky(record: FileRecord, whole: dict[str, Path]) -> Iterator[str]:
    """Size, channels and range of the painted sky."""
    from ..images import read_image

    if record.name not in whole:
        return
    try:
        samples = read_image(whole[record.name])
    except BadInput as error:
        yield str(error)
        return
    row = LAYERS["weather"]
    if samples.shape != (*WEATHER_GRID.shape, len(row.channels)):
        yield f"{record.name} holds {samples.shape} samples, the painted sky {(*WEATHER_GRID.shape, len(row.channels))}"
    elif not (samples.min() >= row.low and samples.max() <= row.high):
        yield f"{record.name} holds {samples.min()} to {samples.max()}, the painted sky is {row.low} to {row.high}"


def _open_exr(path: Path) -> Ground:
    from ..image_rows import open_rows, read_rows

    with open_rows(path) as image:
        shape = image.shape[:2]
    return Ground(shape, lambda slices: ((rows, samples[..., 0]) for rows, samples in read_rows(path, slices)))


def _open_vti(path: Path) -> Ground:
    image = meshes.read_vti(path)
    cols, rows, _ = image.dimensions
    height = np.asarray(image.point_data["height"]).reshape(rows, cols)[::-1]
    return Ground(height.shape, lambda slices: ((rows, height[rows]) for rows in slices))


def _exact(manifest: Manifest, record: FileRecord, whole: dict[str, Path], open_ground: Callable[[Path], Ground]):
    """(findings, the ground) of a file that should hold the level's samples themselves."""
    source = manifest.source
    try:
        ground = open_ground(whole[record.name])
        if ground.shape != (source.rows, source.cols) or (record.height, record.width) != ground.shape:
            rows, cols = ground.shape
            return [f"{record.name} holds {cols} × {rows} samples, the level has another size"], None
        return [*check_floats(manifest, record, ground.blocks(), 0.0)], ground
    except BadInput as error:
        return [str(error)], None


def _raw_words(manifest: Manifest, record: FileRecord, whole: dict[str, Path], ground: Ground | None) -> Iterator[str]:
    world, numbers = manifest.world, record.decode.numbers
    low, high = world.height_min_m, world.height_max_m
    if record.decode.formula != R16_FORMULA or numbers != {"min_m": low, "max_m": high}:
        yield f"{record.name} is to be decoded by another range than the level's"
        return
    if (record.width, record.height) != (manifest.source.cols, manifest.source.rows):
        yield f"{record.name} is said to be {record.width} × {record.height}, the level has another size"
        return
    yield from check_step(record, 100 * (high - low) / maps.TOP)
    before = [*_words(manifest, record, whole, lambda words: decode_r16(words, low, high))]
    yield from before
    if before or ground is None or record.name not in whole:
        return
    words = maps.open_u16(whole[record.name], record.height, record.width)
    error_cm = 100 * maps.largest_difference(
        maps.row_blocks(words), ground.blocks(), lambda values: decode_r16(values, low, high)
    )
    if abs(error_cm - record.max_error) > SLACK_CM:
        yield f"{record.name} is {error_cm:.6f} cm off the float map; the manifest says {record.max_error:.6f} cm"


def _mesh(manifest: Manifest, record: FileRecord, whole: dict[str, Path], ground: Ground | None) -> Iterator[str]:
    """Counts, extent, upward unit normals, and every vertex against the ground at its place."""
    if record.name not in whole:
        return
    try:
        positions, normals, faces = meshes.read_glb(whole[record.name])
    except BadInput as error:
        yield str(error)
        return
    stated = record.mesh
    if stated is None or (len(positions), len(faces)) != (stated.vertices, stated.triangles):
        yield f"{record.name} has {len(positions)} vertices and {len(faces)} triangles, the manifest says otherwise"
    east, north = manifest.world.size_m
    corners = np.array([[0, -north], [east, 0]])
    found = np.array([positions[:, [0, 2]].min(axis=0), positions[:, [0, 2]].max(axis=0)])
    slack = 1e-6 * max(east, north)
    if not np.abs(found - corners).max() <= slack:
        yield f"{record.name} does not reach from X 0 to {east} and from Z 0 to {-north}"
        return
    if not (np.isfinite(normals).all() and (normals[:, 1] > 0).all()):
        yield f"{record.name} has normals that don't point up"
    if ground is None:
        return
    cell = manifest.source.cell_m
    row = np.clip(np.rint((north + positions[:, 2]) / cell), 0, ground.shape[0] - 1).astype(int)
    col = np.clip(np.rint(positions[:, 0] / cell), 0, ground.shape[1] - 1).astype(int)
    error_cm = 100 * float(np.abs(positions[:, 1] - maps.picked(ground.blocks(), row, col)).max())
    if not error_cm <= record.max_error + SLACK_CM:
        yield f"{record.name} is {error_cm:.4f} cm off the ground; the manifest promises {record.max_error:.4f} cm"


def _words(manifest: Manifest, record: FileRecord, whole: dict[str, Path], height_m: Callable) -> Iterator[str]:
    """Range and probes of a 16-bit height map."""
    if record.name not in whole:
        return
    try:
        words = maps.open_u16(whole[record.name], record.height, record.width)
    except ValueError as error:
        yield str(error)
        return
    allowed_m = (record.max_error + SLACK_CM) / 100
    yield from check_range(manifest, record, height_m(words.min()), height_m(words.max()), allowed_m)
    yield from check_probes(manifest, record, lambda row, col: height_m(words[row, col]), allowed_m)
