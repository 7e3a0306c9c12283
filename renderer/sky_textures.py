"""Uploads what sky_light.py works out, made anew when sun, air or clouds change."""

from __future__ import annotations

import moderngl
import numpy as np

from ..level import Level
from .overcast import Overcast
from .sky_light import SkyLight, sky_light


class SkyTextures:
    """Sky textures by sampler name: `u_sky` the clear sky, `u_aerial` light that the air adds; `light` all of it."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self.textures: dict[str, moderngl.Texture] = {}
        self.light: SkyLight | None = None
        self.overcast: Overcast | None = None

    def update(self, level: Level, time_s: float, overcast: Overcast | None = None) -> None:
        """Follow the level's light settings, the hour of a day that runs and what hangs over it."""
        self.overcast = overcast
        light = sky_light(level.settings, time_s, overcast)
        if light is self.light:
            return
        self.light = light
        self._put("u_sky", light.table)
        distances, elevations, azimuths, _ = light.aerial.shape
        self._put("u_aerial", light.aerial.reshape(distances * elevations, azimuths, 3))

    def _put(self, name: str, table: np.ndarray) -> None:
        """Send a table `(rows, cols, 3)`; a texture of its size is used again."""
        size = table.shape[1], table.shape[0]
        if name not in self.textures:
            texture = self.textures[name] = self.ctx.texture(size, 3, dtype="f2", alignment=2)
            texture.repeat_x = texture.repeat_y = False
            texture.filter = moderngl.LINEAR, moderngl.LINEAR
        data = np.ascontiguousarray(np.clip(table, 0, 60000).astype(np.float16))
        self.textures[name].write(data.tobytes(), alignment=2)

    def release(self) -> None:
        for texture in self.textures.values():
            texture.release()
        self.textures.clear()
        self.light = None
