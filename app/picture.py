"""The level drawn into a texture for the viewport: redrawn only when something changed, smaller while it moves."""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass
from typing import Any

from ..level import LAYERS
from ..renderer import VIEWS
from ..renderer.cloud_image import ORDER
from ..renderer.memory import gpu_memory
from .editor import Editor
from .governor import Governor

log = logging.getLogger(__name__)
SETTLE_S = 0.22  # a still picture is drawn at full size after this long without a change
STILL_STEP = 2.0  # it grows by this much a time, so that something sharper is seen soon
LONGEST_STILL_S = 6.0  # and no larger than what should take this long
WIDGETS_FIRST = 2  # frames with widgets only: the first picture waits for its shaders
RETRY_S = 3.0  # after a failure
REFINED = 16  # samples a pixel that a picture which stands still gathers in the end (L04)
FIRST_GATHERED = 4  # of them at once: fewer would show coarser edges than the smoothed picture before
LONGEST_SAMPLE_S = 0.1  # where one takes longer the smoothed picture is left as it is
STILLS = {"low": "medium"}  # tiers that are there for speed draw what stands still as another


@dataclass
class Drawn:
    """What the texture shows."""

    key: Any
    size: tuple[int, int]
    seconds: float  # what drawing it cost
    quality: str
    samples: int = 1
    partial: bool = False  # its clouds are not all marched for it (Z16)


class Picture:
    """Owns the renderer of a window's OpenGL context; the renderer is thrown away and made again when it fails."""

    def __init__(self, ctx, target_fps: float = 30.0, slow: bool = False) -> None:
        """`slow` when OpenGL is done in software."""
        self.ctx = ctx
        self.governor = Governor(target_fps, 0.35 if slow else 1.0)
        self._shown = 0
        self.renderer = None
        self.texture = None
        self.drawn: Drawn | None = None
        self.failure = ""
        self.draws = 0
        self._failed_at = -1e9
        self._changed_at = 0.0
        self._unfinished = False
        self._refining = False

    def show(self, editor: Editor, size: tuple[int, int]) -> Any:
        """The texture for a viewport of `size` pixels (its first row at the bottom), None before the first success."""
        self._shown += 1
        if self._shown <= WIDGETS_FIRST:
            return None
        now = time.monotonic()
        key = self._key(editor, size)
        if self.drawn is None or self.drawn.key != key:
            self._changed_at = now
            self._draw(editor, key, self._scaled(size, self.governor.scale), moving=True)
        elif not self._settled(editor, size) and now - self._changed_at > SETTLE_S and not editor.live:
            still = self._sharper(size)
            if still:
                self._draw(editor, key, still, moving=False)
        elif self._gathering(editor, size) and now - self._changed_at > SETTLE_S and not editor.live:
            had = self.drawn.samples if self.drawn.samples > 1 else 0
            self._draw(editor, key, size, moving=False, part=range(had, max(had + 1, FIRST_GATHERED)))
        self._refining = self._gathering(editor, size)
        return self.texture

    def _gathering(self, editor: Editor, size: tuple[int, int]) -> bool:
        """Whether a picture that stands still gets more samples a pixel: at full size, where that is quick."""
        if self.drawn is None or not self._settled(editor, size) or self.drawn.samples >= REFINED:
            return False
        return self.drawn.seconds < LONGEST_SAMPLE_S and not VIEWS[editor.session.view].value

    @property
    def waiting(self) -> bool:
        """Whether a first or a sharper picture is due although nothing changes."""
        if self.drawn is None:
            return not self.failure
        if self.renderer is not None and not self.renderer.generated.settled:
            return True
        return self._unfinished or self._refining or self._changed_at + SETTLE_S * 2 > time.monotonic()

    @property
    def updating(self) -> bool:
        """Whether the waves shown keep times of arrival that are coarse or of a bed from before (T06)."""
        return self.renderer is not None and self.renderer.arriving

    def _settled(self, editor: Editor, size: tuple[int, int]) -> bool:
        """Whether what is shown is what a picture that stands still becomes in the end."""
        drawn = self.drawn
        whole = (drawn.size, drawn.quality) == (size, STILLS.get(editor.quality, editor.quality))
        return whole and not drawn.partial

    @staticmethod
    def _scaled(size: tuple[int, int], scale: float) -> tuple[int, int]:
        return max(int(size[0] * scale), 16), max(int(size[1] * scale), 16)

    def _key(self, editor: Editor, size: tuple[int, int]) -> Any:
        session = editor.session
        level = session.level
        looks = (session.camera, session.view, session.show, editor.overlays, editor.quality)
        arrived = self.renderer.generated.arrived if self.renderer is not None else 0  # finer textures
        return (id(level), level.revision, session.clock.time_s, looks, arrived, editor.arrivals_seen, size)

    def _sharper(self, size: tuple[int, int]) -> tuple[int, int] | None:
        """The next larger size for a picture that stands still; None when this computer would take too long over it."""
        scale = min(STILL_STEP * self.drawn.size[0] / size[0], 1.0)
        growth = (scale * size[0] / self.drawn.size[0]) ** 2
        self._unfinished = self.drawn.seconds * growth <= LONGEST_STILL_S
        return self._scaled(size, scale if scale < 0.9 else 1.0) if self._unfinished else None

    def _draw(
        self, editor: Editor, key: Any, size: tuple[int, int], moving: bool, part: range | None = None
    ) -> None:  # fmt: skip
        if self.failure and time.monotonic() - self._failed_at < RETRY_S:
            return
        session = editor.session
        quality = editor.quality if moving else STILLS.get(editor.quality, editor.quality)
        start = time.perf_counter()
        try:
            self.texture = self._renderer().draw(
                session.level, session.camera, size, session.clock.time_s, session.view,
                show=session.show, quality=quality, overlays=editor.overlays,
                samples=REFINED if part else 1, part=part,
                live=moving,  # of the clouds a sixteenth a picture (Z16); what stands still is marched whole
                scale=1.0,  # the governor has chosen the pixels: the tier's own scale would lower them twice
            )  # fmt: skip
            self.ctx.finish()
        except Exception as error:
            self._fail(error)
            return
        finally:
            self.ctx.screen.use()  # imgui draws into whatever is bound
        self.failure = ""
        seconds = time.perf_counter() - start
        if moving:
            self._note(size, seconds)
        smooth = self.ctx.LINEAR if size != self._pixels(key) else self.ctx.NEAREST
        self.texture.filter = smooth, smooth
        # one whole march costs less than the live pictures that would come to the same
        partial = self.renderer.stats.get("clouds_settled", len(ORDER)) < len(ORDER)
        self.drawn = Drawn(key, size, seconds / len(part or (0,)), quality, part.stop if part else 1, partial)
        self._unfinished = not self._settled(editor, self._pixels(key))
        self.draws += 1

    def _note(self, size: tuple[int, int], seconds: float) -> None:
        # The first frame of a size also makes its targets and programs: it says nothing about the next.
        if self.drawn is not None and self.drawn.size == size:
            self.governor.note(seconds)

    @staticmethod
    def _pixels(key: Any) -> tuple[int, int]:
        return key[-1]

    def _renderer(self):
        if self.renderer is None:
            from ..renderer import Renderer

            self.renderer = Renderer(self.ctx, background=True)
        return self.renderer

    def _fail(self, error: Exception) -> None:
        """Keep the last picture, throw the renderer away, try again later: the level isn't in it."""
        text = f"{type(error).__name__}: {error}".partition("\n")[0]
        if text != self.failure:
            log.error("the picture could not be drawn: %s", text, exc_info=error)
        self.failure, self._failed_at = text, time.monotonic()
        self.drawn = self.texture = None
        self.release()

    def gpu_bytes(self) -> dict[str, int]:
        """Bytes of textures by layer name, and `generated` for textures, `other` for maps and targets."""
        held = {"other": 0, "generated": 0}
        if self.renderer is None:
            return held
        for row in gpu_memory(self.renderer):
            layer = "height" if row.name == "u_height" else row.name.removeprefix("u_layer_")
            group = "generated" if row.kind == "generated" else layer if layer in LAYERS else "other"
            held[group] = held.get(group, 0) + row.bytes
        return held

    def release(self) -> None:
        """Give back what the GPU holds."""
        renderer, self.renderer = self.renderer, None
        if renderer is not None:
            try:
                renderer.release()
            except Exception as error:
                log.info("releasing the renderer: %s", error)
