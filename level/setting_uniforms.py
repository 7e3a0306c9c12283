"""The level's settings as uniforms, under one naming rule.

A setting `water.absorb_red` is `u_water_absorb_red` in every shader that declares it. The sections `sea` and `shore`
are left out: the level's own GLSL has its own names for them (`wave_uniforms`).
"""

from __future__ import annotations

import functools

from .params import describe, get
from .settings import Settings

OWN_SECTIONS = ("sea", "shore", "time")


@functools.cache
def rows() -> dict:
    """Rows of the settings (`params.describe`) by uniform name."""
    kept = (row for row in describe(Settings) if row.name.split(".")[0] not in OWN_SECTIONS)
    return {f"u_{row.name.replace('.', '_')}": row for row in kept if row.kind in ("float", "int", "bool")}


def settings_uniforms(settings: Settings) -> dict[str, float | int | bool]:
    """Settings outside OWN_SECTIONS, by uniform name."""
    return {name: get(settings, row.name) for name, row in rows().items()}
