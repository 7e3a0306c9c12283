"""The noises of clouds and their height curves on the GPU: made once, kept on disk (Z01)."""

from __future__ import annotations

from functools import partial
from pathlib import Path

import moderngl
import numpy as np

from ..level import cloud_noise, textures
from ..level.cloud_noise import SEED
from .cache import cached


class CloudTextures:
    """Textures of level/clouds.glsl by sampler name, made when first asked for; `bytes` is what they hold."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self.ctx = ctx
        self.held: dict[str, object] = {}
        self.bytes: dict[str, int] = {}
        self._profile: np.ndarray | None = None

    def textures(self, profile: np.ndarray) -> dict[str, object]:
        """All of them, the curves as in `profile` `(3, 64)`."""
        for name, make in cloud_noise.CLOUD_NOISES.items():
            if name not in self.held:
                patterns = Path(textures.__file__).read_text()
                stem, made = name.removeprefix("u_"), partial(make, SEED)
                self._put(name, cached(stem, made, cloud_noise.__file__, patterns))
        if self._profile is None or not np.array_equal(self._profile, profile):
            self._put_profile(profile)
        return self.held

    def perlin_slice(self):
        """The Perlin noise that the shape began with, one slice of it: only a view asks for it (Z21)."""
        if "u_cloud_perlin" not in self.held:
            values = cached("cloud_perlin", lambda: cloud_noise.perlin_slice(SEED), cloud_noise.__file__)
            self._put("u_cloud_perlin", values)
        return self.held["u_cloud_perlin"]

    def _put(self, name: str, values: np.ndarray) -> None:
        sides, channels, data = values.shape[:-1][::-1], values.shape[-1], np.ascontiguousarray(values).tobytes()
        make = self.ctx.texture3d if len(sides) == 3 else self.ctx.texture
        texture = make(sides, channels, data, alignment=1)
        texture.build_mipmaps()
        texture.filter = moderngl.LINEAR_MIPMAP_LINEAR, moderngl.LINEAR
        self.held[name] = texture
        self.bytes[name] = values.nbytes * 8 // 7 if len(sides) == 3 else values.nbytes * 4 // 3

    def _put_profile(self, profile: np.ndarray) -> None:
        if "u_cloud_profile" not in self.held:
            texture = self.ctx.texture(profile.shape[::-1], 1, dtype="f2", alignment=2)
            texture.filter = moderngl.LINEAR, moderngl.LINEAR
            texture.repeat_x = texture.repeat_y = False
            self.held["u_cloud_profile"] = texture
            self.bytes["u_cloud_profile"] = 2 * profile.size
        self.held["u_cloud_profile"].write(profile.astype(np.float16).tobytes(), alignment=2)
        self._profile = profile.copy()

    def release(self) -> None:
        for texture in self.held.values():
            texture.release()
        self.held.clear()
        self.bytes.clear()
        self._profile = None
