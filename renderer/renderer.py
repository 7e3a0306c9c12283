"""The renderer: draws levels by running PASSES (frame.py), and keeps between pictures what they share."""

from __future__ import annotations

import copy
from contextlib import nullcontext
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from ..level import Level
from ..level.objects import Camera
from ..level.sun import day_runs
from ..level.weather_keys import level_at
from .camera import camera_matrices, jitter
from .frame import PASSES, Frame
from .quality import tier
from .show import Overlays, Show
from .views import View, find_view

if TYPE_CHECKING:
    from .sky_textures import SkyTextures


class Renderer:
    """Draws levels with one OpenGL context; can be thrown away and made again at any frame."""

    def __init__(self, ctx, background: bool = False) -> None:
        """`background`: draw with coarse textures while fine ones are made (Textures)."""
        from .cloud_textures import CloudTextures
        from .program import Programs
        from .sky_textures import SkyTextures
        from .textures import Textures
        from .upload import Uploader

        self.ctx = ctx
        self.programs = Programs(ctx)
        self.uploader = Uploader(ctx)
        self.generated = Textures(ctx, background)
        self.sky = SkyTextures(ctx)
        self.clouds = CloudTextures(ctx)
        self.targets: dict[tuple, object] = {}
        self.meshes: dict[int, object] = {}
        self.kept: dict[str, object] = {}  # what passes keep from frame to frame
        self.stats: dict = {}
        self.arriving = False  # the map of arrival in the last picture was not the last word (T06)
        self.unit = 1.0  # of the light in the picture last drawn (sky_light.py)

    def draw(
        self, level: Level, camera: Camera, size: tuple[int, int], time_s: float = 0.0, view: str = "final",
        show: Show | None = None, quality: str = "medium", samples: int = 1, overlays: Overlays | None = None,
        scale: float | None = None, part: range | None = None, live: bool = False,
    ):  # fmt: skip
        """Draw a picture; returns the texture to show, RGBA8 `size`, its first row at the bottom.

        `samples` > 1 averages that many pictures, each moved by a part of a pixel, in linear light; with `part` only
        these of them now, over those drawn by calls before. `scale` is the share of the sides that is drawn before a
        filter fills them, None the tier's; views of numbers are never scaled. `live` pictures follow each other: of
        the clouds of each a part is marched, the others are remembered.
        """
        from .light_ahead import light_ahead

        row = find_view(view)
        scale = 1.0 if row.value else tier(quality).scale if scale is None else scale
        part = range(max(samples, 1)) if part is None else part
        for index in part:
            frame = self.prepare(level, camera, size, time_s, row, show, quality, overlays, samples, index, scale)
            frame.live = live
            if live:
                light_ahead(frame.level.settings, time_s, self.sky.overcast)
            targets = frame.targets
            self._run(frame, once=False)
            if samples > 1:
                self._accumulate(targets, index)
        if samples > 1:
            self._mean(targets, part.stop)
        self._run(frame, once=True)
        self.stats = frame.stats
        self.unit = self.sky.light.unit if row.ramp == "light" or not row.value else 1.0
        return targets.textures["display"]

    def read(self, linear: bool = False) -> np.ndarray:
        """The picture last drawn, row 0 on top: uint8 or (linear) float32 `(height, width, 3)` of what was drawn."""
        targets = next(iter(self.targets.values()))
        framebuffer, kind, dtype = (targets.picture, np.float32, "f4") if linear else (targets.display, np.uint8, "f1")
        data = framebuffer.read(components=3, dtype=dtype, alignment=1)
        width, height = framebuffer.size
        pixels = np.frombuffer(data, kind).reshape(height, width, 3)[::-1]
        return pixels / np.float32(self.unit) if linear else pixels.copy()

    def prepare(
        self, level: Level, camera: Camera, size, time_s: float, view: View, show: Show | None, quality: str,
        overlays: Overlays | None, samples: int = 1, index: int = 0, scale: float = 1.0,
    ) -> Frame:  # fmt: skip
        """Upload what changed and work out everything the passes share; `index` counts the samples of a picture."""
        from ..level.arrival import arrival
        from ..level.shore import shore_map
        from .uniforms import frame_uniforms

        show, row = show or Show(), tier(quality)
        shown = _dated(level, time_s, view, show)
        self.uploader.sync(level)
        self.uploader.tables(shown)
        made = arrival(shown, time_s)
        settled = level.live or shore_map(level).whole
        self.arriving = not settled or (made is not None and not made.settled)
        if made is not None:
            self.uploader.arrival(made)
        self.generated.update(row)
        self.sky.update(shown, time_s, _overcast(shown, time_s, camera, show))
        drawn = tuple(max(round(side * scale), 1) for side in size)
        offset = np.array(jitter(index, samples)) * size / drawn
        matrices = camera_matrices(camera, size, self._near(level, camera), tuple(offset))
        targets = self._targets(size, drawn)
        textures = {**self.uploader.textures, **dict(self.generated.items()), **self.sky.textures, **targets.textures}
        frame = Frame(
            self, shown, camera, drawn, size, time_s, view, show, row, overlays or Overlays(), samples, matrices,
            targets, textures, level, self.sky, index=index,
        )  # fmt: skip
        frame.travels = made is not None
        frame.uniforms = frame_uniforms(frame)
        return frame

    def at_time(self, frame: Frame, time_s: float, sky: SkyTextures) -> Frame:
        """The frame from the same place as it would be at another time; `sky` takes that moment's light."""
        from .uniforms import frame_uniforms

        shown = _dated(frame.source, time_s, frame.view, frame.show)
        sky.update(shown, time_s, _overcast(shown, time_s, frame.camera, frame.show))
        textures = {**frame.textures, **sky.textures}
        there = replace(frame, level=shown, time_s=time_s, textures=textures, sky=sky, uniforms={}, stats={})
        there.uniforms = frame_uniforms(there)
        return there

    def ask_light(self, frame: Frame, time_s: float) -> None:
        """Have the light of another moment of a day that runs worked out beside the pictures."""
        from .light_ahead import light_ahead

        if day_runs(frame.level.settings.light):
            shown = _dated(frame.source, time_s, frame.view, frame.show)
            light_ahead(shown.settings, time_s, _overcast(shown, time_s, frame.camera, frame.show), 0.0)

    def _run(self, frame: Frame, once: bool) -> None:
        self.ctx.disable(self.ctx.DEPTH_TEST | self.ctx.BLEND | self.ctx.CULL_FACE)
        debug = "GL_KHR_debug" in self.ctx.extensions
        for row in PASSES:
            if row.once == once:
                with self.ctx.debug_scope(row.name) if debug else nullcontext():
                    import_module(f".passes.{row.name}", __package__).draw(frame)

    def _near(self, level: Level, camera: Camera) -> float:
        """Near plane: part the clearance over everything that can be drawn, never nearer than 0.1 m."""
        from ..level.waves import largest_height_m

        top = max(float(self.uploader.bounds.range[1]) if self.uploader.bounds else camera.z, level.sea_level_m)
        return float(np.clip(0.4 * (camera.z - top - 2 * largest_height_m(level)), 0.1, 200.0))

    def _targets(self, size: tuple[int, int], drawn: tuple[int, int]):
        from .targets import Targets

        if (size, drawn) not in self.targets:
            for old in self.targets.values():
                old.release()
            self.targets = {(size, drawn): Targets(self.ctx, size, drawn)}
        return self.targets[size, drawn]

    def _accumulate(self, targets, index: int) -> None:
        total = targets.total
        if index == 0:
            total.clear()
        total.use()
        self.ctx.enable(self.ctx.BLEND)
        self.ctx.blend_func = self.ctx.ONE, self.ctx.ONE
        self._copy(targets.textures["picture"], 1.0)
        self.ctx.disable(self.ctx.BLEND)

    def _mean(self, targets, samples: int) -> None:
        targets.picture.use()
        self._copy(targets.textures["total"], 1.0 / samples)

    def _copy(self, texture, factor: float) -> None:
        shader = self.programs.get("copy.glsl")
        shader.program["u_factor"].value = factor
        shader.program["u_source"].value = 0
        texture.use(0)
        shader.fullscreen()

    def release(self) -> None:
        """Give back everything on the GPU."""
        for part in (self.programs, self.uploader, self.generated, self.sky, self.clouds):
            part.release()
        for held in (self.targets, self.meshes, self.kept):
            _give_back(held)
            held.clear()


def _dated(level: Level, time_s: float, view: View, show: Show) -> Level:
    """A level as a picture shows it at a time: arrays and caches are shared, settings its own."""
    shown = copy.copy(level_at(level, time_s))
    shown.settings = view.changed(show.settings(shown.settings))
    return shown


def _overcast(shown: Level, time_s: float, camera: Camera, show: Show):
    from .overcast import overcast

    return overcast(shown, time_s, (camera.x, camera.y), "clouds" in show and "sky" in show)


def _give_back(held: dict) -> None:
    """Release what a dictionary holds, dictionaries in it too; what needs no release is let go."""
    for thing in held.values():
        if isinstance(thing, dict):
            _give_back(thing)
        elif hasattr(thing, "release"):
            thing.release()
