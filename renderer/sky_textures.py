"""Uploads what sky_table.py works out, made anew when the sun, the air or the clouds change."""

from __future__ import annotations

import moderngl
import numpy as np

from ..level import Level
from .sky_table import sky_table


class SkyTextures:
    """Sky textures by sampler name: `u_sky`."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self.textures: dict[str, moderngl.Texture] = {}
        self._key: tuple | None = None

    def items(self):
        """(sampler name, texture) of all."""
        return self.textures.items()

    def update(self, level: Level) -> None:
        """Follow the level's light settings."""
        light = level.settings.light
        key = (light.sun_elevation_deg, light.turbidity)
        if key == self._key:
            return
        self._key = key
        if "u_sky" in self.textures:
            self.textures["u_sky"].release()
        table = np.ascontiguousarray(sky_table(*key).astype(np.float16))
        sky = self.ctx.texture((table.shape[1], table.shape[0]), 3, table.tobytes(), dtype="f2", alignment=2)
        sky.repeat_x = sky.repeat_y = False
        sky.build_mipmaps()
        sky.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
        self.textures["u_sky"] = sky

    def release(self) -> None:
        for texture in self.textures.values():
            texture.release()
        self.textures.clear()
        self._key = None
