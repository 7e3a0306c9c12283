"""Textures of what follows from a level, when a pass or a view asks: maps, bytes, tables, skies, the force field."""

from __future__ import annotations

import numpy as np

from ..level import Level
from ..level.arrival_map import ArrivalMap
from ..level.beach_raster import beach_raster
from ..level.flow import current
from ..level.flow_bytes import flow_bytes
from ..level.layers import WEATHER_GRID
from ..level.patches import patch_kinds
from ..level.shore_field import shore_field
from ..level.tables import tables
from ..level.walk import highest_sea_m
from ..level.water_table import table_in_use
from .held_textures import HeldTextures


class DerivedTextures(HeldTextures):
    """Each is sent again only when what it is made of is another one."""

    def arrival(self, made: ArrivalMap):
        """When swells arrive (T06), RGBA32F: times below, heights above; under a tide twice."""
        seen = self.seen.get("arrival", ())
        if len(seen) != len(made.sources) or any(a is not b for a, b in zip(seen, made.sources)):
            self._whole("u_arrival", made.texture, "f4")
            self.seen["arrival"] = made.sources
        return self.textures["u_arrival"]

    def walkable(self, level: Level):
        """Up to which sea the player can go, R32F, one texel a sample; after a stroke only round what it changed."""
        key = level.layers["height"], level.settings.walk
        known, revision = self.seen.get("walkable", (None, 0))
        fresh = self._refit("u_walkable", level.grid.shape, "f4") or known != key
        for rect in [level.grid.rect] if fresh else level.changed_since("height", revision):
            rect = level.grid.clip(rect.pad(1))  # slope looks at the neighbours
            self._send("u_walkable", highest_sea_m(level, rect), rect, "f4")
        self.seen["walkable"] = key, level.revision
        return self.textures["u_walkable"]

    def patch_kinds(self, level: Level):
        """Kinds of sea by hectare (H27), R8, and the column and row of the first."""
        key = level.revision, level.settings
        if self.seen.get("patch_kinds", (None,))[0] != key:
            made = patch_kinds(level)
            self._whole("u_patch_kinds", made.kinds, "f1")
            self.seen["patch_kinds"] = key, (made.col0, made.row0)
        return self.textures["u_patch_kinds"], self.seen["patch_kinds"][1]

    def beach_mesh(self, level: Level):
        """The beach mesh on samples (H03), RGBA16F with a linear filter, and metres a sample."""
        key = level.revision, level.settings
        if self.seen.get("beach_mesh", (None,))[0] != key:
            values, cell_m = beach_raster(level)
            self._whole("u_beach_mesh", values, "f2")
            self.textures["u_beach_mesh"].filter = self.ctx.LINEAR, self.ctx.LINEAR
            self.seen["beach_mesh"] = key, cell_m
        return self.textures["u_beach_mesh"], self.seen["beach_mesh"][1]

    def shore_field(self, level: Level):
        """Distance, direction, beach (H10, H11), RGBA8 with a linear filter; only what changed is sent."""
        field = shore_field(level)
        known, revision = self.seen.get("shore_field", (None, 0))
        fresh = known is not field
        for rect in field.changed_since(-1 if fresh else revision):
            self._part("u_shore_field", field.packed, rect, "f1")
        self.seen["shore_field"] = field, field.revision
        return self._smooth("u_shore_field")

    def current(self, level: Level, more: float = 0.0):
        """The current, the quiet area and the way to the shore (flow.py), RGBA16F with a linear filter.

        `more`: how much stronger flow points are than the level's own, while weather changes (D36).
        """
        made = current(level)
        more = more if made.to_points is not None else 0.0
        if self.seen.get("current") is not made or self.seen.get("current_more") != more:
            self._whole("u_current", made.with_points(more), "f2")
            self.seen["current_more"] = more
            self._smooth("u_current")
            self.seen["current"] = made
        return self.textures["u_current"]

    def flow_bytes(self, level: Level):
        """The current in the exporters' own bytes (T02), RGB8 with a linear filter, row 0 south."""
        made = flow_bytes(level)
        if self.seen.get("flow_bytes") is not made:
            self._whole("u_flow_bytes", made.bytes, "f1")
            self._smooth("u_flow_bytes")
            self.seen["flow_bytes"] = made
        return self.textures["u_flow_bytes"]

    def tables(self, level: Level) -> None:
        """Bring water table and lattice up to date."""
        key = table_in_use(level), level.settings.level.seed
        if self.seen.get("tables") != key:
            self._whole("u_tables", tables(level), "f4")
            self._smooth("u_tables")
            self.seen["tables"] = key

    def force(self, packed: np.ndarray | None):
        """The force field, or (None) a texel that nothing reads."""
        if "u_force" not in self.textures or self.seen.get("force") is not packed:
            self._whole("u_force", np.zeros((1, 1, 4), np.float32) if packed is None else packed, "f4")
            self.seen["force"] = packed
        return self.textures["u_force"]

    def weather_noise(self, level: Level, make):
        """The noise of the weather's simulation (Z05), RGBA16F, tiling."""
        seed = level.settings.level.seed
        if self.seen.get("weather_noise") != seed:
            self._whole("u_weather_noise", make(seed), "f2")
            self._smooth("u_weather_noise", tiles=True)
            self.seen["weather_noise"] = seed
        return self.textures["u_weather_noise"]

    def shot_skies(self, level: Level, names: tuple[str, ...]):
        """Skies of shots (Z20), RGBA16F, tiling, a layer each; a texel for none. Layers are kept while they fit."""
        sampler, held = "u_weather_shot_skies", self.seen.get("u_weather_shot_skies")
        texture = self.textures.get(sampler)
        if held is None or len(names) > texture.layers or (names and texture.width == 1):
            if texture is not None:
                texture.release()
            side = WEATHER_GRID.rows if names else 1
            texture = self.ctx.texture_array((side, side, max(len(names), 1)), 4, dtype="f2")
            self.textures[sampler], held = texture, ()
            self._smooth(sampler, tiles=True)
        for layer, name in enumerate(names):
            if held[layer : layer + 1] != (name,):
                sky = np.pad(level.skies[name], ((0, 0), (0, 0), (0, 1))).tobytes()
                texture.write(sky, (0, 0, layer, *texture.size[:2], 1))
                self.sent[sampler] += len(sky)
        self.seen[sampler] = names + held[len(names) :]
        return self.textures[sampler]
