"""The targets of a frame. The G-buffer's layout is here; shaders/lib/gbuffer.glsl packs and unpacks it (D01).

| texture | format | what |
|---|---|---|
| `g_albedo` | RGBA8 | square root of linear albedo; a: sky visibility (1 open) |
| `g_normal` | RGBA16F | world normal; a: roughness |
| `g_material` | RGBA8 | r: square root of specular reflectance (F0), g: material id / 255, b: foam, a: wetness |
| `g_emissive` | RGBA16F | light that is already finished, kcd/m²; a: how much of the lit surface shows over it |
| `g_eye_depth` | R32F | linear depth along the view, metres; 0 where nothing was drawn |
| `g_before` | RG32F | world xy before deformation (H30); on land the world xy itself |

Position isn't stored: it is the pixel's ray times eye depth, camera-relative. `under_*` are copies of the land's part
taken before the water is drawn (D02); `u_plates` is the lit land twice at half size, side by side (H12); `u_mirrored`
and `u_mirrored_way` are what the still sea mirrors of it, at half size (H17).
`hdr` is linear radiance in kcd/m², RGBA16F; `picture` the same with
haze, or a view's numbers, RGBA32F; `total` sums jittered frames; `shown`, `smoothed` (only where the picture is drawn
smaller than it is shown) and `display` are display colours, RGBA8. All but `display` have the size that is drawn.
"""

from __future__ import annotations

GBUFFER = {
    "g_albedo": (4, "f1"),
    "g_normal": (4, "f2"),
    "g_material": (4, "f1"),
    "g_emissive": (4, "f2"),
    "g_eye_depth": (1, "f4"),
    "g_before": (2, "f4"),
}
UNDER = ("g_albedo", "g_normal", "g_eye_depth")  # what water may read of the land below it
MATERIALS = ("nothing", "land", "sea", "river", "ice", "puddle", "snow")  # ids 0, 1, 2 …; gbuffer.glsl has the same


class Targets:
    """All textures and framebuffers of a picture; `textures` by name, as shaders and VIEWS name them.

    `size` is that of the finished picture, `drawn` that of everything before it.
    """

    def __init__(self, ctx, size: tuple[int, int], drawn: tuple[int, int]) -> None:
        self.ctx = ctx
        self.size = size
        self.drawn = drawn
        self.textures: dict = {}
        for name, (components, dtype) in GBUFFER.items():
            self._add(name, components, dtype)
        for name in UNDER:
            components, dtype = GBUFFER[name]
            self._add(name.replace("g_", "under_"), components, dtype)
        self._add("hdr", 4, "f2")
        self.plate_size = (drawn[0] + 1) // 2, (drawn[1] + 1) // 2
        for name, sides in (("u_plates", 2), ("u_plate_half", 1)):
            self.textures[name] = self._texture((sides * self.plate_size[0], self.plate_size[1]), 4, "f2")
            self.textures[name].filter = ctx.LINEAR, ctx.LINEAR
        for name, components in (("u_mirrored", 4), ("u_mirrored_way", 2)):
            self.textures[name] = self._texture(self.plate_size, components, "f2")
        self.textures["u_mirrored"].filter = ctx.LINEAR_MIPMAP_LINEAR, ctx.LINEAR
        self.textures["u_mirrored_way"].filter = ctx.LINEAR, ctx.LINEAR
        self._add("picture", 4, "f4")
        self._add("total", 4, "f4")
        self._add("shown", 4, "f1")
        if drawn != size:
            self._add("smoothed", 4, "f1")
            for name in ("shown", "smoothed"):
                self.textures[name].filter = ctx.LINEAR, ctx.LINEAR
        self.textures["display"] = self._texture(size, 4, "f1")
        self.depth = ctx.depth_texture(drawn)
        self.gbuffer = self._framebuffer(*GBUFFER, depth=True)
        self.land = [self._framebuffer(name) for name in UNDER]
        self.under = [self._framebuffer(name.replace("g_", "under_")) for name in UNDER]
        self.hdr = self._framebuffer("hdr")
        self.plates = self._framebuffer("u_plates")
        self.plate_half = self._framebuffer("u_plate_half")
        self.mirrored = self._framebuffer("u_mirrored", "u_mirrored_way")
        self.picture = self._framebuffer("picture")
        self.total = self._framebuffer("total")
        self.shown = self._framebuffer("shown")
        self.smoothed = self._framebuffer("smoothed") if drawn != size else None
        self.display = self._framebuffer("display")

    def _add(self, name: str, components: int, dtype: str) -> None:
        self.textures[name] = self._texture(self.drawn, components, dtype)

    def _texture(self, size: tuple[int, int], components: int, dtype: str):
        texture = self.ctx.texture(size, components, dtype=dtype)
        texture.filter = self.ctx.NEAREST, self.ctx.NEAREST
        texture.repeat_x = texture.repeat_y = False
        return texture

    def _framebuffer(self, *names: str, depth: bool = False):
        return self.ctx.framebuffer([self.textures[name] for name in names], self.depth if depth else None)

    def copy_under(self) -> None:
        """Keep what the land left in the G-buffer, for the water over it."""
        for target, source in zip(self.under, self.land, strict=True):
            self.ctx.copy_framebuffer(target, source)

    def release(self) -> None:
        # Making a framebuffer binds again what was bound before: that must not be one that is gone.
        self.ctx.detect_framebuffer(0).use()
        framebuffers = (
            self.gbuffer,
            self.hdr,
            self.plates,
            self.plate_half,
            self.mirrored,
            self.picture,
            self.total,
            self.shown,
            self.display,
        )
        for thing in (*framebuffers, *self.land, *self.under, self.smoothed, *self.textures.values(), self.depth):
            if thing is not None:
                thing.release()
