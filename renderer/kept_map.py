"""Maps that passes keep from picture to picture, and the frame they are made for: that of a whole time and place."""

from __future__ import annotations

import dataclasses
import math

import numpy as np


class KeptMap:
    """A texture with a linear filter, what it was made for (`key`), and the name under which it is listed."""

    def __init__(self, ctx, name: str, size: tuple[int, int], components: int = 4, repeat: bool = False) -> None:
        self.name = name
        self.size = size
        self.texture = ctx.texture(size, components, dtype="f2")
        self.texture.filter = ctx.LINEAR, ctx.LINEAR
        self.texture.repeat_x = self.texture.repeat_y = repeat
        self.framebuffer = ctx.framebuffer([self.texture])
        self.key: tuple = ()
        self.seen = None  # what whoever reads it must know of how it was made

    def release(self) -> None:
        self.framebuffer.release()
        self.texture.release()


def kept_map(frame, name: str, size: tuple[int, int], components: int = 4, repeat: bool = False) -> KeptMap:
    """The map of that name; made anew where there is none of this size."""
    held = frame.renderer.kept
    made = held.get(name)
    if made is None or made.size != size:
        if made is not None:
            made.release()
        made = held[name] = KeptMap(frame.renderer.ctx, name, size, components, repeat)
    return made


def at_whole(frame, every_s: float, every_m: float):
    """The frame as it is at a whole multiple of a time and of a distance: what is made for it stays for a while."""
    position = np.array(frame.matrices.position, np.float64)
    position[:2] = np.round(position[:2] / every_m) * every_m
    return dataclasses.replace(
        frame, time_s=math.floor(frame.time_s / every_s) * every_s, textures=dict(frame.textures),
        uniforms={**frame.uniforms, "u_camera": tuple(position)},
        matrices=dataclasses.replace(frame.matrices, position=position),
    )  # fmt: skip
