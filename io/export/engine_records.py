"""What each engine is given beside its files: the numbers to type there, one record an engine."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field


class Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class LevelPart(Record):
    """Which part of a square landscape is the level; the rest continues its southern or eastern edge."""

    cols: int
    rows: int
    east_cm: float
    south_cm: float
    outside: str


class UnrealScale(Record):
    """What Unreal's landscape is given; `dialog_*` is the centre, where its import dialog wants the location."""

    resolution: int
    quads_per_section: int
    sections_per_component: str
    components: str
    sample_spacing_m: float
    scale_x: float
    scale_y: float
    scale_z: float
    actor_x_cm: float = 0.0
    actor_y_cm: float = 0.0
    actor_z_cm: float = 0.0
    dialog_x_cm: float
    dialog_y_cm: float
    dialog_z_cm: float = 0.0
    sea_level_v: int = 32768
    sea_level_z_cm: float = 0.0
    level_part: LevelPart


class Part(Record):
    """Which part of an engine's square is the level, in its samples from a corner; the rest continues the level's edge.

    `deep_m` is the way from that corner to the south (corner north-west) or the north (south-west).
    """

    cols: int
    rows: int
    east_m: float
    deep_m: float
    corner: Literal["north-west", "south-west"]
    outside: str


class UnityTerrain(Record):
    """What a Unity terrain is given; every tile has the same numbers, tile x, z stands `terrain_width_m` further on.

    A terrain cannot go below its object, so that stands at the seabed and the sea is a share of the height.
    """

    engine: Literal["unity"] = "unity"
    heightmap_resolution: int
    sample_spacing_m: float
    terrain_width_m: float
    terrain_length_m: float
    terrain_height_m: float
    position_x_m: float = 0.0
    position_y_m: float
    position_z_m: float = 0.0
    sea_level_y_m: float = 0.0
    sea_level_share: float
    byte_order: Literal["Windows"] = "Windows"
    flip_vertically: Literal[False] = False
    gpu_step_cm: float
    level_part: Part


class GodotTerrain(Record):
    """What a terrain plug-in of Godot is given; heights are over the sea, which lies at Y 0.

    `project` is our own, without one. `region_size` is Terrain3D's. `spacing_m` is its vertex_spacing, or the X and Z
    of HTerrain's map_scale.
    """

    engine: Literal["godot"] = "godot"
    plugin: Literal["terrain3d", "hterrain", "project"]
    cols: int
    rows: int
    spacing_m: float
    min_m: float
    max_m: float
    region_size: int | None = None
    position_x_m: float = 0.0
    position_y_m: float = 0.0
    position_z_m: float = 0.0
    sea_level_y_m: float = 0.0
    level_part: Part


Engine = UnrealScale | UnityTerrain | GodotTerrain


class Options(Record):
    """What was asked for beside the target: the longer side resampled to a legal size; the side of a tile."""

    resample: bool = False
    tile: int | None = Field(None, ge=2)


class Resampling(Record):
    """How far the resampled ground, bilinear between its samples, is off the level at the level's own samples."""

    from_cols: int
    from_rows: int
    from_cell_m: float
    max_error_cm: float = Field(ge=0)
    rms_error_cm: float = Field(ge=0)
