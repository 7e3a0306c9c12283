"""Shadow map of the land: worked out when height, sun or size change, kept otherwise."""

from __future__ import annotations

import math

from ..frame import Frame
from ..look import sun_direction

SUN_RADIUS_RAD = 0.00465


class ShadowMap:
    """Two RG32F maps that take turns; `texture` is the finished one."""

    def __init__(self, ctx, size: tuple[int, int]) -> None:
        self.size = size
        self.textures = [ctx.texture(size, 2, dtype="f4") for _ in range(2)]
        for texture in self.textures:
            texture.filter = ctx.LINEAR, ctx.LINEAR
            texture.repeat_x = texture.repeat_y = False
        self.framebuffers = [ctx.framebuffer([texture]) for texture in self.textures]
        self.key: tuple = ()
        self.now = 0

    @property
    def texture(self):
        return self.textures[self.now]

    def release(self) -> None:
        for thing in (*self.framebuffers, *self.textures):
            thing.release()


def draw(frame: Frame) -> None:
    kept, grid, light = frame.renderer.kept, frame.level.grid, frame.level.settings.light
    longest = max(grid.cols, grid.rows)
    scale = min(frame.tier.shadow_size / longest, 1.0)
    size = max(round(grid.cols * scale), 2), max(round(grid.rows * scale), 2)
    shadow = kept.get("shadow")
    if shadow is None or shadow.size != size:
        if shadow is not None:
            shadow.release()
        shadow = kept["shadow"] = ShadowMap(frame.renderer.ctx, size)
    cell_m = grid.extent_m[0] / (size[0] - 1)
    key = frame.renderer.uploader.seen["height"], light.sun_azimuth_deg, light.sun_elevation_deg, light.shadows
    if light.shadows and shadow.key != key:
        _march(frame, shadow, cell_m)
        shadow.key = key
    frame.textures["u_shadow"] = shadow.texture
    frame.uniforms["u_shadow_cell_m"] = cell_m
    slant = math.cos(math.radians(max(light.sun_elevation_deg, 1.0))) ** 2
    frame.uniforms["u_shadow_spread"] = SUN_RADIUS_RAD / max(slant, 0.05)


def _march(frame: Frame, shadow: ShadowMap, cell_m: float) -> None:
    east, north, up = sun_direction(
        frame.level.settings.light.sun_azimuth_deg, frame.level.settings.light.sun_elevation_deg
    )
    flat = math.hypot(east, north)
    if flat < 1e-3:
        east, north, flat = 0.0, 1.0, 1e-3  # at the zenith nothing throws a shadow
    extent = frame.level.grid.extent_m
    step = east / flat * cell_m / extent[0], north / flat * cell_m / extent[1]
    rounds = max(math.ceil(math.log2(max(shadow.size))), 1)
    for index in range(rounds + 1):
        reach = 1 if index == 0 else 2 ** (index - 1)
        shader = frame.shader("shadow.glsl", **({"START": ""} if index == 0 else {"SPREAD": ""}))
        values = {
            "u_step_uv": (step[0] * reach, step[1] * reach),
            "u_step_m": cell_m * reach,
            "u_rise_m": cell_m * reach * float(up / flat),
        }
        for name, value in values.items():
            shader.program[name].value = value
        if index == 0:
            shader.program["u_target"].value = tuple(float(side) for side in shadow.size)
        target = 1 - shadow.now
        shadow.framebuffers[target].use()
        shader.fullscreen()
        shadow.now = target
        frame.textures["u_shadow"] = shadow.texture
    frame.stats["shadow_rounds"] = rounds + 1
