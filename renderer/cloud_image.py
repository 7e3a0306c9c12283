"""The clouds' own image and what a live picture remembers of it (Z16)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

BLOCK = 4  # of every block of so many pixels a side one is marched a frame
# the order in which the pixels of a block are marched: each is far from those before it (Bayer 1973)
ORDER = ((0, 0), (2, 2), (2, 0), (0, 2), (1, 1), (3, 3), (3, 1), (1, 3),
         (1, 0), (3, 2), (3, 0), (1, 2), (0, 1), (2, 3), (2, 1), (0, 3))  # fmt: skip


class CloudImage:
    """Light and transmittance of the clouds, and how far they are: RGBA16F and R32F."""

    def __init__(self, ctx, size: tuple[int, int]) -> None:
        self.size = size
        self.textures = [ctx.texture(size, 4, dtype="f2"), ctx.texture(size, 1, dtype="f4")]
        for texture in self.textures:
            texture.filter = ctx.LINEAR, ctx.LINEAR
            texture.repeat_x = texture.repeat_y = False
        self.met = ctx.depth_texture(size)  # 0 where the cheap steps met cloud, 1 elsewhere
        self.framebuffer = ctx.framebuffer(self.textures, self.met)

    def release(self) -> None:
        for thing in (self.framebuffer, self.met, *self.textures):
            thing.release()


@dataclass(frozen=True, eq=False)
class Seen:
    """From where and when an image was seen; `key` is all else that it depends on."""

    position: np.ndarray
    rays: tuple[np.ndarray, np.ndarray, np.ndarray]  # forward, and a unit of clip space to the right and up
    time_s: float
    drift_m: np.ndarray
    light: np.ndarray  # about what reaches the clouds, `(3,)`
    key: tuple

    def same_view(self, other: Seen) -> bool:
        """Whether every pixel looks the same way at the same moment."""
        rays = all(np.array_equal(a, b) for a, b in zip(self.rays, other.rays, strict=True))
        return rays and np.array_equal(self.position, other.position) and self.time_s == other.time_s


class CloudHistory:
    """Two images that take turns, and the last sixteen parts as they were marched, each with where it was seen from."""

    def __init__(self, ctx, size: tuple[int, int]) -> None:
        self.size = size
        self.images = [CloudImage(ctx, size), CloudImage(ctx, size)]
        self.part = -(-size[0] // BLOCK), -(-size[1] // BLOCK)  # sides of what is marched a frame
        self.parts = CloudImage(ctx, (BLOCK * self.part[0], BLOCK * self.part[1]))  # side by side, a slot each
        self.slots: list[Seen | None] = [None] * len(ORDER)
        self.now = 0
        self.frames = 0  # live ones since this was made
        self.seen: Seen | None = None  # what the present image shows
        self.settled = 0  # live frames since the last thing that changed
        self.painted = 0  # revision of the painted sky in it

    @property
    def image(self) -> CloudImage:
        return self.images[self.now]

    @property
    def slot(self) -> int:
        """Where in the round of ORDER the next part stands."""
        return self.frames % len(ORDER)

    def corner(self, slot: int) -> tuple[int, int]:
        """First texel of a part among `parts`."""
        return slot % BLOCK * self.part[0], slot // BLOCK * self.part[1]

    def forget(self) -> None:
        """Nothing that was marched counts any more."""
        self.slots = [None] * len(ORDER)

    @property
    def textures(self) -> list:
        return [texture for image in (*self.images, self.parts) for texture in (*image.textures, image.met)]

    def release(self) -> None:
        for image in (*self.images, self.parts):
            image.release()
