"""Uploads the generated textures that `shaders/lib` samples: noise, ground, ripple, foam and the sky's table.

textures = Textures(ctx)
textures.update(level)              # once a frame: the sky follows the sun and the haze
textures["u_noise"].use(location=3) # by sampler name
"""

from __future__ import annotations

import moderngl
import numpy as np

from ..level import Level
from ..level import textures as made
from .cache import cached
from .sky_table import sky_table

SAMPLERS = ("u_noise", "u_ground", "u_ripple", "u_foam", "u_sky")
DETAIL = ("u_ground", "u_foam")


class Textures:
    """Generated textures by sampler name; made once a context, the sky's whenever the sun or the haze changes."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self._sky_key: tuple | None = None
        self._by_name = {
            "u_noise": _tiling(ctx, _kept("noise", made.noise_texture)),
            "u_foam": _tiling(ctx, _kept("foam", made.foam_texture)),
            "u_ripple": _tiling(ctx, _kept("ripple", lambda: made.ripple_texture().astype(np.float16))),
            "u_ground": _array(ctx, _kept("ground", made.ground_texture)),
        }
        # tints need no blend between mip levels, which in software costs a second fetch
        self._by_name["u_noise"].filter = moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR

    def __getitem__(self, sampler: str) -> moderngl.Texture | moderngl.TextureArray:
        return self._by_name[sampler]

    def items(self):
        """(sampler name, texture) of all."""
        return self._by_name.items()

    def update(self, level: Level, blended: bool = True) -> None:
        """Make the sky's table follow the level's light settings; `blended` between mip levels, or the nearest one."""
        for name in DETAIL:
            filters = moderngl.LINEAR_MIPMAP_LINEAR if blended else moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR
            if self._by_name[name].filter != filters:
                self._by_name[name].filter = filters
        light = level.settings.light
        key = (light.sun_elevation_deg, light.turbidity)
        if key == self._sky_key:
            return
        self._sky_key = key
        if "u_sky" in self._by_name:
            self._by_name["u_sky"].release()
        table = np.ascontiguousarray(sky_table(*key).astype(np.float16))
        sky = self.ctx.texture((table.shape[1], table.shape[0]), 3, table.tobytes(), dtype="f2", alignment=2)
        sky.repeat_x = sky.repeat_y = False
        _mipmapped(sky)
        self._by_name["u_sky"] = sky

    def release(self) -> None:
        for texture in self._by_name.values():
            texture.release()
        self._by_name.clear()


def _kept(name: str, make) -> np.ndarray:
    """A texture of level/textures.py at its own seed and size: making all four takes seconds."""
    return cached(name, make, made.__file__)


def _mipmapped(texture) -> None:
    texture.build_mipmaps()
    texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR


def _tiling(ctx: moderngl.Context, pixels: np.ndarray) -> moderngl.Texture:
    rows, cols, channels = pixels.shape
    kind = {np.dtype(np.uint8): "f1", np.dtype(np.float16): "f2"}[pixels.dtype]
    texture = ctx.texture((cols, rows), channels, np.ascontiguousarray(pixels).tobytes(), dtype=kind)
    _mipmapped(texture)
    return texture


def _array(ctx: moderngl.Context, layers: np.ndarray) -> moderngl.TextureArray:
    count, rows, cols, channels = layers.shape
    texture = ctx.texture_array((cols, rows, count), channels, np.ascontiguousarray(layers).tobytes())
    _mipmapped(texture)
    return texture
