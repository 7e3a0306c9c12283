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
    sea_cell_m: float
    sea_reach: float
    sea_chunk: int
    sea_distance_m: float  # from there on the sea is the horizon plane
    shadow_size: int  # samples a side of the shadow map
    scale: float
    sea_exact: bool  # the drawn surface is found along each pixel's ray: the twin's within 3 cm, not the mesh's
    mips_blended: bool  # detail textures blend between two mip levels, which in software costs a second fetch
    ground_texels: int  # samples a side of the ground's textures; all have one pattern
    ground_cheap: bool  # materials at one scale, on one plane
    ground_layers: int  # of the materials at a pixel the heaviest that many are sampled
    ground_levels: int  # levels of the terrain mesh finer than the level's cells
    openness_size: int  # samples a side of the map of the open sky
    openness_ways: int  # horizons a sample


TIERS: dict[str, Tier] = {
    tier.name: tier
    for tier in (
        Tier("low", 5.0, 8, 1.0, 5.0, 16, 1500.0, 512, 0.5, False, False, 256, True, 2, 0, 512, 8),
        Tier("medium", 8.0, 8, 0.5, 8.0, 16, 2500.0, 1024, 1.0, True, True, 512, False, 2, 3, 1024, 12),
        Tier("high", 14.0, 8, 0.25, 14.0, 16, 4000.0, 2048, 1.0, True, True, 1024, False, 3, 3, 2048, 16),
    )
}


def tier(name: str) -> Tier:
    """The row of a tier; BadInput lists them when there is none of that name."""
    if name not in TIERS:
        raise BadInput(f"no quality is called {name!r}; there are: {', '.join(TIERS)}")
    return TIERS[name]
