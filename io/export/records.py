"""What a manifest holds, field by field, as pydantic models that both the exporters and the check go through."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field

from ... import __version__
from ...level.grid import MAX_SIDE

SCHEMA = "shorewright.export"
SCHEMA_VERSION = 2


class Record(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Tool(Record):
    name: str = "Shorewright"
    version: str = __version__
    commit: str | None = None


class Source(Record):
    """The level that was exported; `sha256` is over what it holds, saved or not (`source_sha256`)."""

    name: str
    sha256: str
    rows: int = Field(ge=2, le=MAX_SIDE)
    cols: int = Field(ge=2, le=MAX_SIDE)
    cell_m: float = Field(gt=0)
    georeference: dict[str, Any] = {}


class World(Record):
    """Where the level lies; `size_m` is (east, north) from its first to its last sample."""

    size_m: tuple[float, float]
    origin: str
    axes: str
    row_0: Literal["north", "south"]
    sea_level_m: float
    height_min_m: float
    height_max_m: float


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


class Tiles(Record):
    rows: int = 1
    cols: int = 1
    shared_edge: bool = True


class Waves(Record):
    """The moment and the waves the level was at; a height map depends on none of it, wave code does."""

    time_s: float = 0.0
    seed: int
    sea: dict[str, Any]
    shore: dict[str, Any]


class Channel(Record):
    name: str
    meaning: str
    unit: str
    neutral: float | None = None


class Decode(Record):
    formula: str
    numbers: dict[str, float] = {}


class Mesh(Record):
    vertices: int
    triangles: int
    triangle_budget: int
    stride: int
    surface_error_cm: float


class MeshPart(Record):
    """One mesh of a GLB of MESHES, of which nodes may show several: its own axes, before they place it."""

    name: str
    vertices: int = Field(ge=0)
    triangles: int = Field(ge=0)
    nodes: int = Field(ge=1)
    low: tuple[float, float, float]
    high: tuple[float, float, float]
    uv_low: tuple[float, float]
    uv_high: tuple[float, float]
    upward: bool = Field(description="No normal points down: what lies on ground or water.")
    surface_error_cm: float = Field(ge=0, description="Largest distance of the file's meshes from what they stand for.")


class FileRecord(Record):
    """One file: `max_error` is measured on the bytes written, decoded by `decode`, against the level.

    It and `step`, the quantisation's, are in `error_unit`. Files that hold no samples have a width and height of 0.
    """

    name: str
    map: str
    doc: str
    size_bytes: int = Field(ge=0)
    sha256: str = Field(pattern="^[0-9a-f]{64}$")
    width: int = Field(ge=0, le=MAX_SIDE)
    height: int = Field(ge=0, le=MAX_SIDE)
    bit_depth: int
    sample_type: Literal["uint8", "uint16", "float32", "text"]
    endianness: Literal["little"] = "little"
    row_0: Literal["north", "south"] | None
    colour_space: Literal["linear"] = "linear"
    channels: list[Channel]
    decode: Decode
    step: float | None = None
    max_error: float = Field(ge=0)
    error_unit: str = "cm"
    mesh: Mesh | None = None
    parts: list[MeshPart] = []


class Probe(Record):
    """The level's own ground at one sample of the exported height map, for a check without the level."""

    col: int
    row: int
    x_m: float
    y_m: float
    height_m: float


class FlowProbe(Record):
    """The level's own current at one sample of its exported map."""

    col: int
    row: int
    x_m: float
    y_m: float
    east_mps: float
    north_mps: float


class MapProbe(Record):
    """What one sample of a map of MAPS stands for, channel by channel, before it was coded."""

    file: str
    col: int
    row: int
    values: tuple[float, ...]


class Manifest(Record):
    schema_name: Literal["shorewright.export"] = Field(SCHEMA, alias="schema")
    schema_version: int = SCHEMA_VERSION
    tool: Tool
    target: str
    source: Source
    world: World
    engine: UnrealScale | None = None
    tiles: Tiles = Tiles()
    waves: Waves
    files: list[FileRecord]
    probes: list[Probe] = []
    flow_probes: list[FlowProbe] = []
    map_probes: list[MapProbe] = []
    import_recipe: list[str]
    notes: list[str] = []

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True)
