"""TIERS: what low, medium and high mean, one row each."""

from __future__ import annotations

from dataclasses import dataclass

from ..level import BadInput

APRON_M = 900.0  # beyond the level the land goes on this far, sinking (lib/height.glsl)
APRON_DEPTH_M = 60.0  # to where hardly any light comes back from


@dataclass(frozen=True)
class Tier:
    """`reach` is the distance, in chunks, up to which a mesh keeps its finest cells; see mesh.py.

    `scale` is the share of the picture's sides that is drawn: the rest comes from a filter (shaders/upscale.glsl). It
    counts where nobody else chooses the pixels; the window's governor does, and so it draws with `scale=1`.
    """

    name: str
    terrain_reach: float
    terrain_chunk: int  # cells a side of a terrain chunk
    sea_cell_m: float  # 10 m over a power of two: chunks of ten cells fit the hectares (H01)
    sea_reach: float  # where sea.near_m is as it comes
    sea_distance_m: float  # without view circles the mesh goes so far; from there on the sea is the horizon plane
    shadow_size: int  # samples a side of the shadow map
    prop_shadow_size: int  # of the map of scattered things' shadows
    scatter_share: float  # of the grass that is drawn; a tier draws what the one below draws, and more
    scatter_reach: float  # of the distance up to which things are drawn
    scale: float
    reflections: bool  # the sea mirrors the land that is seen, not one colour of land (H17)
    sea_exact: bool  # the drawn surface is found along each pixel's ray: the twin's within 3 cm, not the mesh's
    mips_blended: bool  # detail textures blend between two mip levels, which in software costs a second fetch
    ground_texels: int  # samples a side of the ground's textures; all have one pattern
    ground_cheap: bool  # materials at one scale, on one plane
    ground_layers: int  # of the materials at a pixel the heaviest that many are sampled
    ground_levels: int  # levels of the terrain mesh finer than the level's cells
    openness_size: int  # samples a side of the map of the open sky
    openness_ways: int  # horizons a sample
    cloud_steps: tuple[float, float]  # of the march through the clouds, overhead and at the horizon (Z14)
    shaft_steps: int  # of the march through curtains of rain (Z18)
    cloud_dome: int  # samples a side of the clouds as the sea mirrors them
    cloud_shadow: tuple[int, int]  # samples a side of the clouds' shadow, steps through them (Z19)


def _columns(**rows: tuple) -> tuple[dict, ...]:
    """A table of (low, medium, high) by field as one dictionary a tier."""
    return tuple({name: values[i] for name, values in rows.items()} for i in range(3))


_LAND = _columns(
    terrain_reach=(5.0, 8.0, 14.0),
    terrain_chunk=(8, 8, 8),
    ground_levels=(0, 3, 3),
    scatter_share=(0.5, 0.8, 1.0),
    scatter_reach=(0.75, 1.0, 1.4),
)
_SEA = _columns(
    sea_cell_m=(1.25, 0.625, 0.3125),
    sea_reach=(5.6, 10.0, 18.0),
    sea_distance_m=(1500.0, 2500.0, 4000.0),
    reflections=(False, True, True),
    sea_exact=(False, True, True),
)
_LIGHT = _columns(
    shadow_size=(512, 1024, 2048),
    prop_shadow_size=(512, 1024, 2048),
    openness_size=(512, 1024, 2048),
    openness_ways=(8, 12, 16),
)
_CLOUDS = _columns(
    shaft_steps=(12, 32, 48),
    cloud_steps=((40.0, 64.0), (64.0, 128.0), (96.0, 192.0)),
    cloud_dome=(64, 96, 128),
    cloud_shadow=((160, 10), (256, 14), (384, 20)),
)
_GROUND = _columns(
    mips_blended=(False, True, True),
    ground_texels=(256, 512, 1024),
    ground_cheap=(True, False, False),
    ground_layers=(2, 2, 3),
)

TIERS: dict[str, Tier] = {
    tier.name: tier
    for tier in (
        Tier("low", **_LAND[0], **_SEA[0], **_LIGHT[0], **_GROUND[0], **_CLOUDS[0], scale=0.5),
        Tier("medium", **_LAND[1], **_SEA[1], **_LIGHT[1], **_GROUND[1], **_CLOUDS[1], scale=1.0),
        Tier("high", **_LAND[2], **_SEA[2], **_LIGHT[2], **_GROUND[2], **_CLOUDS[2], scale=1.0),
    )
}


def tier(name: str) -> Tier:
    """The row of a tier; BadInput lists them when there is none of that name."""
    if name not in TIERS:
        raise BadInput(f"no quality is called {name!r}; there are: {', '.join(TIERS)}")
    return TIERS[name]
