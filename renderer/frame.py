"""PASSES in drawing order: how a frame comes about. Read this first.

Each row names a module in `passes/`, the shaders it draws with, what it reads and what it writes; `draw(frame)` of that
module does it. Targets are described in targets.py, and each is a view (views.py).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ..level import Level
from ..level.objects import Camera
from ..level.params import get
from .camera import Matrices
from .quality import Tier
from .show import Overlays, Show
from .views import View

if TYPE_CHECKING:
    from .renderer import Renderer
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
WITH_WAVES = ("sea.glsl", "view.glsl", "terrain.glsl", "scatter.glsl", "fronts.glsl")  # know the level's waves
RAINED_ON = ("sea.glsl", "view.glsl")
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
    Pass("sea", ("sea.glsl",), ("u_bed", "u_tables", "u_shadow", *UNDER), GBUFFER, "Sea into it.", "D01 D10 H05"),
    Pass("horizon", ("sea.glsl",), ("u_bed", "u_tables", "u_shadow", *UNDER), GBUFFER, "Sea beyond the mesh.", "H21"),
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

    def shader(self, name: str, without: tuple[str, ...] = (), **defines: str):
        """A program with this frame's uniforms and textures bound; `without` some defines of what the level has."""
        from ..level.wave_uniforms import wave_defines
        from .uniforms import bind_textures, set_uniforms

        if name in WITH_WAVES:
            defines |= wave_defines(self.level) | ({"TRAVEL_TIME": ""} if self.travels else {})
        if name in IN_THE_SUN:
            defines |= self.defines
        if name in RAINED_ON and self.uniforms.get("u_rain_share", 0.0) > 0:
            defines["RAIN_RINGS"] = ""
        defines |= {off: "" for path, off in OFF.get(name, {}).items() if not get(self.level.settings, path)}
        defines = {define: value for define, value in defines.items() if define not in without}
        shader = self.renderer.programs.get(name, **defines)
        set_uniforms(shader.program, self.uniforms)
        bind_textures(shader, self.textures)
        return shader
