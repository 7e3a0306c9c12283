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
    prop_shadow_size: int  # of the map of scattered things' shadows
    scatter_share: float  # of the grass that is drawn; a tier draws what the one below draws, and more
    scatter_reach: float  # of the distance up to which things are drawn
    scale: float
    sea_exact: bool  # the drawn surface is found along each pixel's ray: the twin's within 3 cm, not the mesh's
    mips_blended: bool  # detail textures blend between two mip levels, which in software costs a second fetch


TIERS: dict[str, Tier] = {
    tier.name: tier
    for tier in (
        Tier("low", 5.0, 8, 1.0, 5.0, 16, 1500.0, 512, 512, 0.5, 0.75, 0.5, False, False),
        Tier("medium", 8.0, 8, 0.5, 8.0, 16, 2500.0, 1024, 1024, 0.8, 1.0, 1.0, True, True),
        Tier("high", 14.0, 8, 0.25, 14.0, 16, 4000.0, 2048, 2048, 1.0, 1.4, 1.0, True, True),
    )
}


def tier(name: str) -> Tier:
    """The row of a tier; BadInput lists them when there is none of that name."""
    if name not in TIERS:
        raise BadInput(f"no quality is called {name!r}; there are: {', '.join(TIERS)}")
    return TIERS[name]
