"""The one editor object (T08, T10): level, undo, clock, brush in hand. Window, command line and tests are thin clients.

No OpenGL. Every edit enters here, so that everything done is undoable, recorded as a script and in the recovery log.

    session = Session.open("cove.shore")
    session.drag("raise", (120, 80), (160, 90), size_m=12)
    session.undo(); session.redo(); session.save()
"""

from __future__ import annotations

from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..brushes import BRUSHES, Stroke
from ..level import BadInput, Clock, Grid, Journal, Level
from ..level.framing import cameras, frame
from ..level.objects import Camera
from ..level.params import Section
from ..level.sun import stand_at
from . import words
from .edits import Edits
from .imported import imported_height
from .spill import FileStore

if TYPE_CHECKING:
    from ..renderer.show import Show
    from .recovery import RecoveryLog
    from .recovery_offer import Offer

UNDO_BYTES = 256 << 20


class Session(Edits):
    """A level being edited. Use `new`, `imported`, `open` or `recover` to get one, and `close` it."""

    def __init__(self, level: Level, *, undo_bytes: int = UNDO_BYTES, spill_root: Path | None = None) -> None:
        from ..renderer.show import Show

        self.level = level
        self.clock = Clock()
        self.store = FileStore(spill_root)
        self.journal = Journal(level, undo_bytes, self.store)
        self.path: Path | None = None
        self.folder = None
        self.recovery: RecoveryLog | None = None
        self.brush = next(iter(BRUSHES))
        self.params: dict[str, Section] = {name: brush.params() for name, brush in BRUSHES.items()}
        self.stroke: Stroke | None = None
        self.record: list[words.Action] = []
        self.notes: list[str] = []  # what is worth telling, for whoever shows it
        # How it is looked at; no part of the level.
        self.show: Show = Show()
        self.view = "final"
        self.camera: Camera = self._first_camera()
        self.cursor: tuple[float, float, float] | None = None  # ground under the pointer
        self.sky_cursor: tuple[float, float, float] | None = None  # and the clouds' shell, with a brush for it in hand
        self.sky_hand: tuple[float, float] | None = None  # where in the world a stroke on the weather map has come to
        self.requests: deque[str] = deque()  # what a window has to ask the person, such as "open"
        self._saved: Any = self._mark()
        self._changed()

    # Getting one, keeping it, letting go

    @classmethod
    def new(cls, grid: Grid | None = None, base=None, georeference: dict | None = None, **options) -> Session:
        """A level that no folder holds yet: a sloping beach unless `base` float32 `(rows, cols)` is given."""
        from ..level.starter import sloping_beach

        grid = grid or Grid(513, 513)
        level = Level(grid, sloping_beach(grid) if base is None else base, georeference=georeference)
        level.set("clouds.on", True)
        level.set("shore.plunge", 1.0)
        for camera in cameras(level):
            level.put_object(camera.id, camera)
        session = cls(level, **options)
        session._saved = None  # nothing holds it
        return session

    @classmethod
    def imported(cls, path: Path | str, *, sea_level_m: float = 0.0, samples: int | None = None, **flags) -> Session:
        """A new level from a height map; `flags` as `io.import_height` takes them, BadInput names the one missing."""
        found = imported_height(path, flags)
        session = cls.new(Grid(*found.height.shape, found.cell_m), found.height, dict(found.georeference or {}))
        session.level.set_settings(stand_at(session.level.settings, session.level.georeference))
        if sea_level_m:
            session.level.set("level.sea_level_m", sea_level_m)
        if samples:
            session.resize(samples=samples)
        for camera in cameras(session.level):
            session.level.put_object(camera.id, camera)
        session.camera = session._first_camera()
        session.journal.done.clear()
        session.record.clear()
        session.notes += found.notes
        return session

    @classmethod
    def open(cls, path: Path | str, **options) -> Session:
        """A level's folder, locked for editing; BadInput when it is no level or open elsewhere."""
        from ..io import LevelFolder

        folder = LevelFolder(path)
        level = folder.open()
        try:
            session = cls(level, **options)
        except BaseException:
            folder.close()
            raise
        session.folder, session.path = folder, Path(path)
        session.notes += folder.notes
        return session

    @classmethod
    def recover(cls, offer: Offer, **options) -> Session:
        """What a killed editor had after its last finished step; dirty, and undo leads back to its folder's state."""
        change = offer.change()
        if offer.folder is not None and (offer.folder / "level.json").exists():
            session = cls.open(offer.folder, **options)
        elif change.ground is not None:
            session = cls.new(change.ground.grid, change.ground.base, change.ground.georeference, **options)
            session.level.objects.clear()
        else:
            raise BadInput(f"{offer.folder} is gone, and the recovery log holds only what was changed in it")
        session.apply_change(change)
        session.keep_log(resume=offer)
        return session

    def keep_log(self, root: Path | None = None, resume: Offer | None = None) -> None:
        """Write a recovery log from now on (the editor does; a script, which saves once, needs none)."""
        from .recovery import RecoveryLog

        self.recovery = RecoveryLog(root or (resume.path.parent if resume else None), resume.path if resume else None)
        if resume:
            self.recovery.resume(resume.good_bytes)
        else:
            self.recovery.start(self.level, self.path)
        self._told()

    def save(self, path: Path | str | None = None, overwrite: bool = False) -> Path:
        """Save to the level's folder, or to another one from now on; what the disk held stays when it fails."""
        self._end_stroke()
        if path is None and self.path is None:
            raise BadInput("this level has no folder yet: save it under a name such as cove.shore")
        path = self.path if path is None else Path(path)
        if self.folder is None or path.resolve() != self.path.resolve():
            self._save_as(path, overwrite)
        else:
            if self.recovery:
                self.recovery.saving()
            self.folder.save(self.level)
        self._saved = self._mark()
        if self.recovery:
            self.recovery.start(self.level, self.path)
            self._told()
        return path

    def _save_as(self, path: Path, overwrite: bool) -> None:
        from ..io import LevelFolder
        from ..io.lock import is_husk

        if path.exists() and not overwrite and not is_husk(path):
            raise BadInput(f"{path} exists already: choose another name")
        folder = LevelFolder(path)
        try:
            folder.save(self.level)
        except BaseException:
            folder.close()
            raise
        if self.folder:
            self.folder.close()
        self.folder, self.path = folder, path

    def close(self) -> None:
        """Let go of the folder; what was not saved is gone, on purpose."""
        self.stroke_abort()
        if self.recovery:
            self.recovery.close(discard=True)
            self.recovery = None
        if self.folder:
            self.folder.close()
            self.folder = None
        self.store.close()

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *exc) -> None:
        self.close()

    @property
    def dirty(self) -> bool:
        """Whether something would be lost on closing; undoing back to the saved state makes it clean again."""
        if self.stroke is not None or self._saved is None:
            return True
        return any(now is not then for now, then in zip(self._mark(), self._saved))

    @property
    def title(self) -> str:
        return f"{self.path.name if self.path else 'untitled'}{' •' if self.dirty else ''}"

    # Time

    def advance(self, wall_s: float) -> int:
        """Let wall time pass; returns the simulation steps that fell due."""
        return self.clock.advance(wall_s)

    # Looking

    def frame(self) -> None:
        """Move the view's camera to what is under the pointer, or to the whole level."""
        self.camera = frame(self.level, self.camera, self.cursor)

    def ask(self, request: str) -> None:
        """Leave a request for a window, such as a file dialog; without a window nobody answers."""
        self.requests.append(request)

    def _first_camera(self) -> Camera:
        saved = [thing for thing in self.level.objects.values() if isinstance(thing, Camera)]
        named = {camera.id: camera for camera in saved}
        return named.get("play") or (saved or cameras(self.level))[0]

    def _changed(self) -> None:
        """The clock follows the level's time settings, when those change."""
        time = self.level.settings.time
        if getattr(self, "_time", None) is time:
            return
        self._time = time
        self.clock.step_s, self.clock.rate = time.step_s, time.rate
        has_loop = time.loop_end_s > time.loop_start_s
        self.clock.loop = (time.loop_start_s, time.loop_end_s) if has_loop else None
