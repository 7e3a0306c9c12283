"""Generated textures that `shaders/lib` samples: noise, foam, ripple, and the ground's two arrays by resolution.

textures = Textures(ctx)              # in the window: Textures(ctx, background=True)
textures.update(tier)                 # once a frame
textures["u_noise"].use(location=3)   # by sampler name

What isn't in the cache takes seconds to make. In the background coarse ones stand in until the fine ones are there;
without it `update` waits for them, so that a picture depends on the level alone.
"""

from __future__ import annotations

import logging
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import moderngl
import numpy as np

from ..level import ground_textures, tiling
from ..level import textures as made
from .cache import cached
from .quality import Tier

log = logging.getLogger(__name__)
COARSE = tiling.DRAFT  # samples a side of what stands in
DETAIL = ("u_ground_shape", "u_ground_colour", "u_foam")
SHARED = {
    "noise": lambda size=made.SIZE: made.noise_texture(size),
    "foam": lambda size=made.SIZE: made.foam_texture(size),
    "caustics": lambda size=512: made.caustics_texture(size),
    "ripple": lambda size=256: made.ripple_texture(size).astype(np.float16),
}


class Textures:
    """Generated textures by sampler name; `bytes` is what each set holds on the GPU."""

    def __init__(self, ctx: moderngl.Context, background: bool = False) -> None:
        self.ctx = ctx
        self.bytes: dict[str, int] = {}
        self._background = background
        self._pool = ThreadPoolExecutor(1, "textures") if background else None
        self._coming: dict[str, Future] = {}
        self._sets: dict[str, tuple] = {}  # textures by set name
        self._ground = ""  # the ground's set in use

    def __getitem__(self, sampler: str) -> moderngl.Texture | moderngl.TextureArray:
        return dict(self.items())[sampler]

    def items(self):
        """(sampler name, texture) of all."""
        yield from ((f"u_{name}", self._held(name)[0]) for name in SHARED)
        yield from zip(("u_ground_shape", "u_ground_colour"), self._held(self._ground), strict=True)

    def _held(self, name: str) -> tuple:
        """The textures of a set, or what stands in for them."""
        return self._sets.get(name) or self._sets[f"{name.split()[0]} coarse"]

    @property
    def settled(self) -> bool:
        """Whether nothing is on its way."""
        return not self._coming

    @property
    def arrived(self) -> int:
        """How many sets have come, those not yet taken with them: a picture of fewer is out of date."""
        return len(self.bytes) + sum(future.done() for future in self._coming.values())

    def update(self, tier: Tier) -> None:
        """Take what has arrived, ask for what `tier` needs, choose how detail is filtered."""
        wanted = f"ground {tier.ground_texels}"
        for name in (*SHARED, wanted):
            if self._pool is None and name not in self.bytes:
                self._put(name, _make(name))
            elif name not in self.bytes and name not in self._coming:
                self._stand_in(name)
                self._coming[name] = self._pool.submit(_make, name)
        for name in [name for name, future in self._coming.items() if future.done()]:
            self._put(name, self._coming.pop(name).result())
        others = [name for name in self.bytes if name.startswith("ground")]
        self._ground = wanted if wanted in self.bytes else max(others, key=self.bytes.get, default=wanted)
        filters = moderngl.LINEAR_MIPMAP_LINEAR if tier.mips_blended else moderngl.LINEAR_MIPMAP_NEAREST
        for name, texture in self.items():
            if name in DETAIL and texture.filter != (filters, moderngl.LINEAR):
                texture.filter = filters, moderngl.LINEAR

    def settle(self, tier: Tier) -> None:
        """Wait for all that `tier` needs."""
        self.update(tier)
        for future in list(self._coming.values()):
            future.exception()
        self.update(tier)

    def _stand_in(self, name: str) -> None:
        """A coarse one where there is none of its kind: a tenth of a second for all, most of it for the ground."""
        kind = name.split()[0]
        if not any(held.split()[0] == kind for held in self._sets):
            make = SHARED.get(kind, ground_textures.ground_textures)
            self._sets[f"{kind} coarse"] = _textures(self.ctx, name, make(COARSE))

    def _put(self, name: str, pixels: np.ndarray) -> None:
        for old in self._sets.pop(f"{name.split()[0]} coarse", ()):
            old.release()
        self._sets[name] = _textures(self.ctx, name, pixels)
        self.bytes[name] = pixels.nbytes * 4 // 3  # with its mip levels
        log.info("textures: %s, %.1f MB on the GPU", name, self.bytes[name] / 1e6)

    def release(self) -> None:
        if self._pool is not None:
            self._pool.shutdown(wait=False, cancel_futures=True)
        self._coming.clear()
        for held in self._sets.values():
            for texture in held:
                texture.release()
        self._sets.clear()
        self.bytes.clear()


def _make(name: str) -> np.ndarray:
    """A set from the cache, or made for it."""
    patterns = Path(tiling.__file__).read_text()  # the code that all depend on besides their own
    if name in SHARED:
        return cached(name, SHARED[name], made.__file__, patterns)
    size = int(name.split()[1])
    return cached(f"ground{size}", lambda: ground_textures.ground_textures(size), ground_textures.__file__, patterns)


def _textures(ctx: moderngl.Context, name: str, pixels: np.ndarray) -> tuple:
    return (
        tuple(_array(ctx, layers) for layers in pixels) if name.startswith("ground") else (_tiling(ctx, pixels, name),)
    )


def _tiling(ctx: moderngl.Context, pixels: np.ndarray, name: str) -> moderngl.Texture:
    rows, cols, channels = pixels.shape
    kind = {np.dtype(np.uint8): "f1", np.dtype(np.float16): "f2"}[pixels.dtype]
    texture = ctx.texture((cols, rows), channels, np.ascontiguousarray(pixels).tobytes(), dtype=kind)
    texture.build_mipmaps()
    # tints need no blend between mip levels, which in software costs a second fetch
    between = moderngl.LINEAR_MIPMAP_NEAREST if name == "noise" else moderngl.LINEAR_MIPMAP_LINEAR
    texture.filter = between, moderngl.LINEAR
    return texture


def _array(ctx: moderngl.Context, layers: np.ndarray) -> moderngl.TextureArray:
    count, rows, cols, channels = layers.shape
    texture = ctx.texture_array((cols, rows, count), channels, np.ascontiguousarray(layers).tobytes())
    texture.build_mipmaps()
    texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
    return texture
