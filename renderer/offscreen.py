"""Pictures without a window: an OpenGL context of our own, a frame, an array."""

from __future__ import annotations

import atexit
import sys

import numpy as np

from ..level import BadInput, Level
from ..level.objects import Camera
from ..level.water_table import check_table
from .quality import tier
from .show import Overlays, Show

_own: dict[str, object] = {}
MOST_SIDE = 16384
MOST_PIXELS = 40_000_000  # some 70 bytes each
MOST_SAMPLES = 1024
LINE = 2  # pixels between two pictures


def own_context():
    """A standalone OpenGL 4.1 context: EGL on Linux, the platform's own elsewhere; BadInput when there is none."""
    import moderngl

    if "ctx" not in _own:
        options = {"backend": "egl"} if sys.platform.startswith("linux") else {}
        try:
            _own["ctx"] = moderngl.create_standalone_context(require=410, **options)
        except Exception as error:
            hint = "on Debian: apt install libegl1 libgl1-mesa-dri"
            raise BadInput(f"no OpenGL 4.1 on this computer to draw with ({error}); {hint}") from None
        atexit.register(release)
    return _own["ctx"]


def own_renderer():
    """The renderer of `own_context`, kept for the next picture."""
    from .renderer import Renderer

    if "renderer" not in _own:
        _own["renderer"] = Renderer(own_context())
    return _own["renderer"]


def release() -> None:
    """Give the context back."""
    if "renderer" in _own:
        _own.pop("renderer").release()
    if "ctx" in _own:
        _own.pop("ctx").release()


def render(
    level: Level, camera: Camera | str = "play", size: tuple[int, int] = (1280, 720), time_s: float = 0.0,
    view: str = "final", show: Show | None = None, quality: str = "medium", samples: int = 1,
    overlays: Overlays | None = None, linear: bool = False, renderer=None,
) -> np.ndarray:  # fmt: skip
    """A picture of a level as `(height, width, 3)`, row 0 on top; BadInput for an unknown camera, view or size.

    uint8 for the display, or with `linear` float32: radiance in kcd/m² before exposure, or a view's numbers.
    """
    if not all(isinstance(side, int) and 1 <= side <= MOST_SIDE for side in size):
        raise BadInput(f"a picture of {size[0]} × {size[1]} pixels is outside 1 to {MOST_SIDE} a side")
    if size[0] * size[1] > MOST_PIXELS:
        raise BadInput(f"a picture of {size[0]} × {size[1]} pixels is more than {MOST_PIXELS // 10**6} million")
    if not 1 <= samples <= MOST_SAMPLES:
        raise BadInput(f"{samples} samples a pixel are outside 1 to {MOST_SAMPLES}")
    camera = level.camera(camera) if isinstance(camera, str) else camera
    check_table(level)
    level.derived.pop("force", None)  # a picture depends on the level and the time, not on how it was come to
    renderer = renderer or own_renderer()
    renderer.generated.settle(tier(quality))  # never a picture of coarse stand-ins
    scale = 1.0 if linear else None  # numbers are never made up by a filter
    renderer.draw(level, camera, size, time_s, view, show, quality, samples, overlays, scale)
    return renderer.read(linear)


def compare(level: Level, other: Level, camera: Camera | str = "play", other_look: dict | None = None, **options):
    """Left half of one picture beside the right half of another, a white line between (D42).

    `other` may be the same level with other settings, `other_look` changes options of `render` for the right half.
    """
    left = render(level, camera, **options)
    right = render(other, camera, **{**options, **(other_look or {})})
    middle = left.shape[1] // 2
    both = np.concatenate([left[:, :middle], right[:, middle:]], axis=1)
    if both.dtype == np.uint8 and both.shape[1] > 2 * LINE:
        both[:, middle - LINE // 2 : middle + LINE // 2] = 255
    return both
