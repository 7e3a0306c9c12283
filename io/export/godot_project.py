"""A small Godot 4 project that draws the level: its ground, and its sea by the runtime kit. Open the folder, press F5.

It reads its files by itself, so nothing waits for an import, and what it is told of the level stands in the inspector
of its scene. The texts are those of `godot_files`, where `$words` stand for a level's own numbers.
"""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from string import Template

from ...level import Level
from ...level.framing import cameras
from ...level.objects import Camera
from ...level.sun import light_angles
from ...level.water_optics import absorption, backscatter
from . import common, flow, map_ground
from .earlier import Piece
from .engine_records import GodotTerrain
from .godot import STYLE, TEXTURES, range_m, terrain3d_layout, terrain_of, words_of
from .heights import probes, write_heights
from .job import Job
from .kit import files as kit
from .manifest import describe, describe_file
from .records import Decode, FileRecord, Manifest

TEXTS = Path(__file__).parent / "godot_files"
SCENE = "main.tscn"
FILLED = ("project.godot", SCENE, "sea.gdshader")
# Godot's build would pack what it imports a picture to, which a script cannot read as it stands
KEPT = '[remap]\n\nimporter="keep"\n'
READ_AS_FILES = ("cover_weights.png", "cover_weights_2.png")
PROJECT = ("project", "The project: scene, scripts and shaders; brings height, kit and cover along, which it reads.")
HEIGHT = ("height", "The ground over the sea, 16 bits, sample for sample.")
NEEDS = {HEIGHT[0], kit.NAME, "cover_weights", "cover_weights_2"}
MAPS = (PROJECT, HEIGHT, flow.MAP, *common.told())


def export(job: Job) -> Manifest:
    """Write the chosen maps, and with `project` what it needs of them."""
    if PROJECT[0] in job.maps:
        job = replace(job, maps=job.maps | NEEDS)
    grid = job.level.grid
    layout = terrain3d_layout(grid.shape, grid.cell_m, "Godot")
    terrain = terrain_of(layout, "project", *range_m(job.level))

    def ground() -> Piece:
        return write_heights(job, layout, words_of(terrain), lambda _: f"{job.name}_height.r16", HEIGHT[1])

    texts = job.piece(PROJECT[0], lambda: Piece(_write_texts(job, terrain)))
    heights = job.piece(HEIGHT[0], ground, ("height",))
    current = job.piece(flow.MAP[0], lambda: flow.write_flow(job, flow.GODOT_FORMULA))
    pictures = common.write_common(job, STYLE, ("godot", "c"))
    return Manifest(
        target=job.target,
        options=job.options,
        engine=terrain,
        files=texts.files + heights.files + current.files + pictures.files,
        empty=job.empty,
        probes=probes(job, layout),
        flow_probes=current.flow_probes,
        map_probes=pictures.map_probes,
        import_recipe=[
            *(_recipe() if texts.files else []),
            *(line for file in current.files for line in flow.recipe(file)),
            *common.lines([*current.files, *pictures.files], TEXTURES),
        ],
        **describe(
            job.level,
            job.name,
            "north",
            origin="north-west corner of the level at X 0 Z 0; Y 0 is the sea",
            axes="+X east, +Y up, +Z south, right-handed, metres; X = x, Y = height - sea level, Z = size_north - y",
        ),
    )


def _write_texts(job: Job, terrain: GodotTerrain) -> list[FileRecord]:
    words = scene_words(job.level, job.name, terrain)
    records = []
    for source in sorted(TEXTS.glob("*.*")):
        text = source.read_text("utf-8")
        path = job.folder / source.name
        path.write_text(Template(text).substitute(words) if source.name in FILLED else text, "utf-8", newline="\n")
        records.append(_record(path))
    for picture in READ_AS_FILES:
        path = job.folder / f"{job.name}_{picture}.import"
        path.write_text(KEPT, "utf-8", newline="\n")
        records.append(_record(path))
    return records


def _record(path: Path) -> FileRecord:
    return describe_file(
        path, map=PROJECT[0], doc=PROJECT[1], width=0, height=0, bit_depth=8, sample_type="text", row_0=None,
        channels=[], decode=Decode(formula="a text of the project"), max_error=0.0,
    )  # fmt: skip


def scene_words(level: Level, name: str, terrain: GodotTerrain) -> dict[str, str]:
    """What the scene is told of a level, by the words in its text; angles in Godot's turn, north is −Z."""
    east, north = level.grid.extent_m
    azimuth, elevation = light_angles(level.settings.light)
    eye = first_camera(level)
    numbers = {
        "east_m": east, "north_m": north, "cell_m": level.grid.cell_m, "min_m": terrain.min_m, "max_m": terrain.max_m,
        "mean_sea_m": level.mean_sea_m, "cover_cell_m": map_ground.stride_of(level) * level.grid.cell_m,
        "sun_elevation_deg": max(elevation, 1.0), "sun_yaw_deg": 180.0 - azimuth,
        "eye_pitch_deg": eye.pitch_deg, "eye_yaw_deg": -eye.yaw_deg, "eye_fov_deg": eye.fov_deg,
    }  # fmt: skip
    vectors = {
        "absorption": absorption(level.settings.water), "backscatter": backscatter(level.settings.water),
        "eye": (eye.x, eye.z - level.sea_level_m, north - eye.y),
    }  # fmt: skip
    told = {word: _number(value) for word, value in numbers.items()}
    told |= {word: ", ".join(map(_number, values)) for word, values in vectors.items()}
    return {"name": name, **told}


def scene_says(manifest: Manifest) -> tuple[str, ...]:
    """Lines of main.tscn that follow from a manifest alone."""
    terrain, (east, north) = manifest.engine, manifest.world.size_m
    size, span = ((_number(a), _number(b)) for a, b in ((east, north), (terrain.min_m, terrain.max_m)))
    return (
        f"size_m = Vector2({', '.join(size)})",
        f"cell_m = {_number(manifest.source.cell_m)}",
        f"height_range_m = Vector2({', '.join(span)})",
    )


def _number(value: float) -> str:
    """Nine digits: what a float of the engine holds."""
    return f"{float(value):.9g}" if math.isfinite(value) else "0"


def first_camera(level: Level) -> Camera:
    """`play`, or the first that the level has, or one that looks at its shore."""
    own = sorted((one for one in level.objects.values() if isinstance(one, Camera)), key=lambda one: one.id != "play")
    return (own or cameras(level))[0]


def _recipe() -> list[str]:
    return [
        "Godot 4.4 or newer, any renderer: import the folder as a project (project.godot), press F5. Right mouse "
        "button, W A S D and Q E fly, Space holds the sea.",
        "In a project of your own: keep its files together in one folder without project.godot and instance main.tscn. "
        "For a build add *.f32, *.u8, *.json, *.r16, *.png to the filter of files in Project > Export > Resources.",
    ]
