"""PASSES in drawing order: how a frame comes about. Read this first.

Each row names a module in `passes/`, the shaders it draws with, what it reads and what it writes; `draw(frame)` of that
module does it. Targets are described in targets.py, and each is a view (views.py).
"""

from __future__ import annotations

import copy
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from ..level import Level
from ..level.objects import Camera
from ..level.params import get
from ..level.sun import day_runs
from ..level.weather_keys import level_at
from .camera import Matrices, camera_matrices, jitter
from .quality import Tier, tier
from .show import Overlays, Show
from .views import View, find_view

if TYPE_CHECKING:
    from .sky_textures import SkyTextures


@dataclass(frozen=True)
class Pass:
    name: str
    shaders: tuple[str, ...]
    reads: tuple[str, ...]
    writes: tuple[str, ...]
    doc: str
    ids: str = ""
    once: bool = False  # a picture, after the mean of its samples is taken


GBUFFER = ("g_albedo", "g_normal", "g_material", "g_emissive", "g_eye_depth", "g_before")
# What a level has switched off, its dearest programs are compiled without: in software a branch costs what it skips.
OFF = {
    "sea.glsl": {"sea.on": "NO_GERSTNER", "shore.on": "NO_SHORE_WAVES", "force.on": "NO_FORCE", "flow.on": "NO_FLOW",
                 "caustics.on": "NO_CAUSTICS"},
    "plate.glsl": {"caustics.on": "NO_CAUSTICS"},
}  # fmt: skip
WITH_WAVES = ("sea.glsl", "view.glsl", "terrain.glsl", "scatter.glsl", "fronts.glsl")  # read patches.glsl
WITH_FRONTS = ("sea.glsl", "view.glsl", "fronts.glsl")  # read gerstner.glsl
IN_THE_SUN = ("sea.glsl", "light.glsl", "view.glsl")  # ask sun_visibility
UNDER = ("under_albedo", "under_normal", "under_eye_depth")

PASSES: tuple[Pass, ...] = (
    Pass("weather", ("weather.glsl",), ("u_layer_weather",), ("u_weather",), "The weather map round the camera.",
         "Z04 Z05 Z06"),
    Pass("cloud_dome", ("cloud_dome.glsl",), ("u_weather", "u_aerial"), ("u_cloud_dome",),
         "Clouds all round, as the sea mirrors them, kept for a while.", "Z17"),
    Pass("lobes", ("lobes.glsl",), ("u_sky", "u_cloud_dome"), ("u_lobes",),
         "The sky as things mirror it, kept.", "L02"),
    Pass("shadow", ("shadow.glsl",), ("u_height",), ("u_shadow",),
         "Height of the land's shadow, kept while nothing changes."),
    Pass("prop_shadow", ("prop_shadow.glsl", "copy_depth.glsl"), (), ("u_prop_shadow",),
         "Heights up to which things shade, kept while nothing changes.", "L03 D12"),
    Pass("cloud_shadow", ("cloud_shadow.glsl",), ("u_weather",), ("u_cloud_shadow",),
         "How much of the sun comes through the clouds, round the camera.", "Z19"),
    Pass("openness", ("openness.glsl",), ("u_height",), ("u_openness",),
         "Open sky over the land, kept likewise.", "L02 L03"),
    Pass("force", (), (), ("u_force",), "Water pushed about by what moves in it, stepped on the CPU.", "D18"),
    Pass("terrain", ("terrain.glsl",), ("u_height", "u_openness", "u_layer_cover"), GBUFFER,
         "Land into the G-buffer.", "D01 L05"),
    Pass("scatter", ("scatter.glsl",), ("u_bed", "u_noise"), GBUFFER, "Rocks, driftwood and grass.", "L09"),
    Pass("props", ("props.glsl",), (), GBUFFER, "Meshes that stand in the level or float.", "D12"),
    Pass("contact", ("contact.glsl",), ("g_eye_depth",), ("g_albedo",), "Less sky at the foot of things.", "L03"),
    Pass("under", (), GBUFFER, UNDER, "Copies what lies under the water.", "D02"),
    Pass("plate", ("light.glsl", "plate.glsl"), (*GBUFFER, "u_shadow"), ("hdr", "u_plates"),
         "Lit land at half size, as it is seen through water.", "H12 H13"),
    Pass("reflections", ("reflections.glsl",), ("hdr", "under_eye_depth"), ("u_mirrored", "u_mirrored_way"),
         "The lit land mirrored in the still sea, at half size.", "H17"),
    Pass("lids", ("lids.glsl",), (), (), "Keeps the sea out of hulls: depth alone.", "D12"),
    Pass("sea", ("sea.glsl",), ("u_bed", "u_variety", "u_shadow", *UNDER), GBUFFER, "Sea into it.", "D01 D10 H05"),
    Pass("horizon", ("sea.glsl",), ("u_bed", "u_variety", "u_shadow", *UNDER), GBUFFER, "Sea beyond the mesh.", "H21"),
    Pass("lookdev", ("lookdev.glsl",), (), GBUFFER, "In its view: balls and a card.", "L08"),
    Pass("light", ("light.glsl",), (*GBUFFER, "u_shadow", "u_prop_shadow", "u_lobes", "u_mirrored"), ("hdr",),
         "Lights all of it, once.", "D01"),
    Pass("lamps", ("lamps.glsl",), GBUFFER, ("hdr",), "Point lights, land and sea alike.", "D01"),
    Pass("sky", ("sky.glsl",), ("g_eye_depth",), ("hdr",), "Sky where nothing was drawn."),
    Pass("fog", ("fog.glsl",), ("hdr", "g_eye_depth", "u_aerial"), ("picture",), "Air, haze.", "L02 D38"),
    Pass("clouds", ("clouds.glsl", "cloud_resolve.glsl", "cloud_composite.glsl"),
         ("u_weather", "g_eye_depth", "u_aerial"), ("picture",),
         "Clouds in volume over sky and land.", "Z02 Z12 Z14 Z15 Z16 Z17"),
    Pass("rain", ("rain.glsl",), ("u_weather", "g_eye_depth", "u_clouds"), ("picture",),
         "Rain and snow, far and near.", "Z18 Z24"),
    Pass("view", ("view.glsl", "cloud_view.glsl"), (*GBUFFER, "hdr", "u_clouds"), ("picture",),
         "Instead of it: a buffer or a mask.", "T11"),
    Pass("display", ("display.glsl",), ("picture",), ("shown", "display"), "Exposure, curve, sRGB, dither.", once=True),
    Pass("antialias", ("antialias.glsl",), ("shown",), ("display",), "Smooths single frames.", once=True),
    Pass("upscale", ("upscale.glsl",), ("shown", "smoothed"), ("display",), "To full size where fewer are drawn.",
         once=True),
    Pass("fronts", ("fronts.glsl",), ("g_eye_depth", "g_material", "u_bed", "u_arrival"), ("display",),
         "When fronts pass, on the water: crests, ghosts, isochrones, speed, breakers.", "T06", once=True),
    Pass("overlay", ("overlay.glsl", "lines.glsl"), ("g_eye_depth", "under_eye_depth"), ("display",),
         "Brush ring, walkable depth, outline, lines.", "D31 D40", once=True),
    Pass("insets", ("view.glsl", "weather_inset.glsl"), (*GBUFFER, "u_layer_weather"), ("display",),
         "Views and the weather map in the picture's corners.", "T12 Z04", once=True),
)  # fmt: skip


@dataclass
class Frame:
    """One picture in the making: everything a pass may read."""

    renderer: Renderer
    level: Level  # its settings are those of the show flags
    camera: Camera
    size: tuple[int, int]  # what is drawn
    full_size: tuple[int, int]  # what is shown; larger where the tier draws fewer pixels
    time_s: float
    view: View
    show: Show
    tier: Tier
    overlays: Overlays
    samples: int
    matrices: Matrices
    targets: object
    textures: dict
    source: Level  # as it is edited, whatever the time
    sky: SkyTextures  # the light of its moment
    index: int = 0  # which of the samples
    travels: bool = False  # waves come by the time that they travel (T06)
    pinned: bool = False  # and pins shift them (T07)
    live: bool = False  # one of many pictures: what is dear may be made a part at a time
    uniforms: dict = field(default_factory=dict)
    defines: dict = field(default_factory=dict)  # of programs that read the sun's visibility
    stats: dict = field(default_factory=dict)

    @property
    def scaled(self) -> bool:
        """True where fewer pixels are drawn than shown."""
        return self.size != self.full_size

    @property
    def smoothed(self) -> bool:
        """True where edges are smoothed in the finished picture."""
        return not self.view.value and self.samples == 1 and "antialias" in self.show

    def shader(self, name: str, **defines: str):
        """A program with this frame's uniforms and textures bound."""
        from ..level.patches import overrides
        from ..level.waves import wave_defines
        from .uniforms import bind_textures, set_uniforms

        if name in WITH_FRONTS:
            defines |= wave_defines(self.level)
        if name in WITH_WAVES and overrides(self.level):
            defines["PATCHED"] = ""
        if name in WITH_WAVES and self.travels:
            defines["TRAVEL_TIME"] = ""
        if name in WITH_WAVES and self.pinned:
            defines["PINS"] = ""
        if name in IN_THE_SUN:
            defines |= self.defines
        defines |= {off: "" for path, off in OFF.get(name, {}).items() if not get(self.level.settings, path)}
        shader = self.renderer.programs.get(name, **defines)
        set_uniforms(shader.program, self.uniforms)
        bind_textures(shader, self.textures)
        return shader


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
        from ..level.pins import pinned
        from ..level.shore import shore_map
        from .uniforms import frame_uniforms

        show, row = show or Show(), tier(quality)
        shown = _dated(level, time_s, view, show)
        self.uploader.sync(level)
        self.uploader.table(shown)
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
        frame.pinned = bool(pinned(shown))
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
