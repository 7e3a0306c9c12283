"""Draw a level: frame passes, views and pictures. Importing this costs nothing; OpenGL is loaded by what draws."""

from .camera import Matrices, camera_matrices, pick
from .frame import PASSES, Pass
from .quality import TIERS, Tier
from .show import SHOW_FLAGS, Flag, Overlays, Ring, Show
from .views import VIEWS, View

__all__ = [
    "PASSES", "SHOW_FLAGS", "TIERS", "VIEWS", "Flag", "Matrices", "Overlays", "Pass", "Renderer", "Ring", "Show",
    "Tier", "View", "camera_matrices", "pick", "render",
]  # fmt: skip


def __getattr__(name: str):
    if name == "Renderer":
        from .renderer import Renderer

        return Renderer
    if name == "render":
        from .offscreen import render

        return render
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
