"""What every edit of a session has in common: it leaves a step, which is recorded and written to the recovery log."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ..level import Journal, Level
from ..level.journal import Step
from . import words
from .recovery import RecoveryLog


class Steps:
    """The bookkeeping under `Session`."""

    level: Level
    journal: Journal
    record: list[words.Action]
    notes: list[str]
    recovery: RecoveryLog | None

    @contextmanager
    def _edit(self, word: words.Action | None = None, merge: bool = False) -> Iterator[None]:
        """Round an edit: when it left a step, note it in the recovery log and the script."""
        before = self._top()
        yield
        step = self._top()
        if step is None or (step is before and not merge):
            return
        self._noted(step)
        if word is not None:
            self._recorded(word, merged=step is before)

    def _noted(self, step: Step) -> None:
        self._changed()
        if self.recovery:
            self.recovery.note(self.level, step)
            self._told()

    def _told(self) -> None:
        if self.recovery and self.recovery.failed and self.recovery.failed not in self.notes:
            self.notes.append(self.recovery.failed)

    def _recorded(self, word: words.Action, merged: bool = False) -> None:
        """Add a word to the script; one whose step joined the last one takes that one's place."""
        if merged:
            last = next(n for n in reversed(range(len(self.record))) if isinstance(self.record[n], type(word)))
            self.record[last] = word
        else:
            self.record.append(word)

    def _top(self) -> Step | None:
        return self.journal.done[-1] if self.journal.done else None

    def _mark(self) -> tuple:
        """Tells two states apart by identity: the last step, and the settings that a slider drag merges into it."""
        return self._top(), self.level.settings

    def _changed(self) -> None:
        """What a session keeps in step with the level's settings."""
