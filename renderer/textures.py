"""Uploads the generated textures that `shaders/lib` samples: noise, ground, ripple, foam.

textures = Textures(ctx)
textures.update()                   # once a frame
textures["u_noise"].use(location=3) # by sampler name
"""

from __future__ import annotations

import moderngl
import numpy as np

from ..level import textures as made
from .cache import cached

SAMPLERS = ("u_noise", "u_ground", "u_ripple", "u_foam")
DETAIL = ("u_ground", "u_foam")


class Textures:
    """Generated textures by sampler name; made once a context."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
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

    def update(self, blended: bool = True) -> None:
        """Choose how detail is filtered: `blended` between mip levels, or the nearest one."""
        for name in DETAIL:
            filters = moderngl.LINEAR_MIPMAP_LINEAR if blended else moderngl.LINEAR_MIPMAP_NEAREST, moderngl.LINEAR
            if self._by_name[name].filter != filters:
                self._by_name[name].filter = filters

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
