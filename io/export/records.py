"""What a manifest holds, field by field, as pydantic models that both the exporters and the check go through."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import ConfigDict, Field

from ... import __version__
from ...level.grid import MAX_SIDE
from .engine_records import Engine, Options, Record, Resampling

SCHEMA = "shorewright.export"
SCHEMA_VERSION = 2


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
    georeference: dict[str, Any] = Field(default_factory=dict)


class World(Record):
    """Where the level lies; `size_m` is (east, north) from its first to its last sample."""

    size_m: tuple[float, float]
    origin: str
    axes: str
    row_0: Literal["north", "south"]
    sea_level_m: float
    height_min_m: float
    height_max_m: float


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
    """One channel of a file; a map of MAPS has what its whole numbers reach to and how far off they were measured."""

    name: str
    meaning: str
    unit: str
    neutral: float | None = None
    low: float | None = None
    high: float | None = None
    max_error: float | None = Field(None, ge=0)


class Decode(Record):
    formula: str
    numbers: dict[str, float] = Field(default_factory=dict)


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
    surface_error_cm: float = Field(
        ge=0, description="Largest distance from what it stands for; of tiles that of all at their level of detail."
    )


class FileRecord(Record):
    """One file: `max_error` is measured on the bytes written, decoded by `decode`, against the level.

    It and `step`, the quantisation's, are in `error_unit`. Files that hold no samples have a width and height of 0. For
    a resampled ground the error is that of the quantisation; `resampling` states the other. `follows_sha256` tells an
    export whether this file would come out the same.
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
    resampling: Resampling | None = None
    follows_sha256: str = ""
    parts: tuple[MeshPart, ...] = ()


class Probe(Record):
    """The level's own ground at one sample of the exported height map, over all its tiles: for a check without the
    level.
    """

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
    options: Options = Options()
    engine: Engine | None = None
    tiles: Tiles = Tiles()
    waves: Waves
    files: list[FileRecord]
    empty: dict[str, str] = Field({}, description="Maps that the level has nothing of, and what that follows from.")
    probes: list[Probe] = Field(default_factory=list)
    flow_probes: list[FlowProbe] = Field(default_factory=list)
    map_probes: list[MapProbe] = Field(default_factory=list)
    import_recipe: list[str]
    notes: list[str] = Field(default_factory=list)

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True)
