"""Textures by sampler name that fit what is sent to them, whole or a rectangle at a time; bytes are counted."""

from __future__ import annotations

from collections import Counter

import numpy as np

from ..level import Rect


class HeldTextures:
    """`textures` by sampler name, `bytes` sent, `sent` by name; `seen` is what each was made of."""

    def __init__(self, ctx) -> None:
        self.ctx = ctx
        self.textures: dict = {}
        self.sent: Counter[str] = Counter()
        self.seen: dict[str, object] = {}

    @property
    def bytes(self) -> int:
        """Bytes sent since this was made."""
        return sum(self.sent.values())

    def _whole(self, name: str, values: np.ndarray, dtype: str) -> None:
        self._part(name, values, Rect(0, 0, *values.shape[:2]), dtype)

    def _part(self, name: str, values: np.ndarray, rect: Rect, dtype: str) -> None:
        """Send `rect` of `values` `(rows, cols[, channels])`; a texture of another shape is sent whole."""
        if self._refit(name, values.shape, dtype):
            rect = Rect(0, 0, *values.shape[:2])
        self._send(name, values[rect.slices], rect, dtype)

    def _refit(self, name: str, shape: tuple[int, ...], dtype: str) -> bool:
        """Make a texture fit `(rows, cols[, channels])`; True when it had to be made anew."""
        size, components = (shape[1], shape[0]), shape[2] if len(shape) == 3 else 1
        texture = self.textures.get(name)
        if texture is not None and texture.size == size and texture.components == components:
            return False
        if texture is not None:
            texture.release()
        texture = self.ctx.texture(size, components, dtype=dtype, alignment=1)
        texture.filter = self.ctx.NEAREST, self.ctx.NEAREST
        texture.repeat_x = texture.repeat_y = False
        self.textures[name] = texture
        return True

    def _send(self, name: str, values: np.ndarray, rect: Rect, dtype: str) -> None:
        """Send the samples of `rect` to a texture that fits."""
        if rect.empty:
            return
        data = np.ascontiguousarray(values, {"f4": np.float32, "f2": np.float16, "f1": np.uint8}[dtype])
        size = rect.col1 - rect.col0, rect.row1 - rect.row0
        self.textures[name].write(data, viewport=(rect.col0, rect.row0, *size), alignment=1)
        self.sent[name] += data.nbytes

    def release(self) -> None:
        for texture in self.textures.values():
            texture.release()
        self.textures.clear()
        self.seen.clear()

    def _smooth(self, name: str, tiles: bool = False):
        """The texture, read with a linear filter, and going on past its edges when it tiles."""
        texture = self.textures[name]
        texture.filter = self.ctx.LINEAR, self.ctx.LINEAR
        if tiles:
            texture.repeat_x = texture.repeat_y = True
        return texture
