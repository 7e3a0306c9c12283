"""Undo and redo of everything (T08): a step is a list of atoms that swap with the level.

Tiles are saved before their first write and of them only the cells that differ are kept, packed (`tiles.py`); settings
and objects are kept as the frozen models they are; whole grids (import, resize, crop) as bytes (`atoms.py`). The budget
is in bytes: past it the steps farthest from now go to the store, and when there is none, away.
"""

from __future__ import annotations

import pickle
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Protocol

from .atoms import Thing, Value, Whole, whole_state
from .grid import NOWHERE, Rect
from .layers import LayerData
from .level import Level
from .params import replace
from .settings import Settings
from .tiles import Tiles


class Store(Protocol):
    """Where steps past the budget go; the app hands one in, `level` opens no file."""

    def put(self, key: str, data: bytes) -> None: ...
    def get(self, key: str) -> bytes: ...
    def drop(self, key: str) -> None: ...


@dataclass
class Step:
    """A labelled list of atoms; while open it also holds the snapshots of tiles being written."""

    label: str
    merge_key: str = ""
    atoms: list = field(default_factory=list)
    snapshots: dict[str, dict[tuple[int, int], tuple]] = field(default_factory=dict)
    rects: dict[str, Rect] = field(default_factory=dict)
    spilled: str = ""  # key in the store, when the atoms are there

    @property
    def bytes(self) -> int:
        return sum(atom.bytes for atom in self.atoms)

    def save(self, data: LayerData, rect: Rect) -> None:
        """Keep every tile of a layer that `rect` touches, before its first write in this step."""
        kept = self.snapshots.setdefault(data.row.name, {})
        for tile in data.grid.tiles(rect):
            if tile not in kept:
                kept[tile] = data.snapshot(tile)
        self.rects[data.row.name] = self.rects.get(data.row.name, NOWHERE).union(rect)


class Journal:
    """The steps of one level. `store` takes what the byte budget no longer holds."""

    def __init__(self, level: Level, budget_bytes: int = 256 << 20, store: Store | None = None) -> None:
        self.level = level
        self.budget_bytes = budget_bytes
        self.store = store
        self.done: list[Step] = []
        self.undone: list[Step] = []
        self.open: Step | None = None
        self._keys = 0

    # A step: begin, save what will be written, commit or abort

    @contextmanager
    def step(self, label: str, merge_key: str = "") -> Iterator[Step]:
        """A transaction: committed at the end, rolled back when the body raises."""
        step = self.begin(label, merge_key)
        try:
            yield step
        except BaseException:
            self.abort()
            raise
        self.commit()

    def begin(self, label: str, merge_key: str = "") -> Step:
        """Open a step; an open one is committed first."""
        if self.open:
            self.commit()
        self.open = Step(label, merge_key)
        self.level.live = True
        return self.open

    def commit(self) -> Step | None:
        """Settle what was written and keep the step; returns None when nothing changed."""
        step, self.open, self.level.live = self.open, None, False
        if step is None:
            return None
        self._settle(step)
        if not step.atoms:
            return None
        for gone in self.undone:
            self._drop(gone)
        self.undone.clear()
        if step.merge_key and self.done and self.done[-1].merge_key == step.merge_key:
            return self.done[-1]  # the older step already holds the value to go back to
        self.done.append(step)
        self._keep_budget()
        return step

    def _settle(self, step: Step) -> None:
        """Turn the snapshots of an open step into atoms; a tile that ended as it began leaves none."""
        for name, kept in step.snapshots.items():
            data = self.level.layers[name]
            atom = Tiles.settle(data, kept, step.rects[name])
            if atom.held:
                step.atoms.append(atom)
            for rect in data.grid.cover(kept, step.rects[name]):
                self.level.mark(name, rect)
        step.snapshots.clear()
        step.rects.clear()

    def abort(self) -> None:
        """Leave no trace of the open step."""
        step, self.open, self.level.live = self.open, None, False
        if step is None:
            return
        for name, kept in step.snapshots.items():
            data = self.level.layers[name]
            for tile, snapshot in kept.items():
                data.restore(tile, snapshot)
            for rect in data.grid.cover(kept, step.rects[name]):
                self.level.mark(name, rect)
        for atom in reversed(step.atoms):
            atom.swap(self.level)

    def seal(self) -> None:
        """End merging: the next change of the same slider is a step of its own."""
        if self.done:
            self.done[-1].merge_key = ""

    # What a step can hold besides tiles

    def set(self, path: str, value: object, merge: bool = False) -> None:
        """Change a setting as a step; `merge` joins it to a running drag of the same slider."""
        self.set_settings(f"Set {path}", replace(self.level.settings, path, value), path if merge else "")

    def set_settings(self, label: str, settings: Settings, merge_key: str = "") -> None:
        """Change any number of settings as one step."""
        with self.step(label, merge_key) as step:
            step.atoms.append(Value(self.level.settings))
            self.level.set_settings(settings)

    def put(self, name: str, thing: object | None) -> None:
        """Place, change or remove an object as a step."""
        self.put_all(f"{'Remove' if thing is None else 'Place'} {name}", {name: thing})

    def put_all(
        self, label: str, things: dict[str, object | None], merge_key: str = "", settings: Settings | None = None
    ) -> None:
        """Place, change or (None) remove objects by id as one step, with the settings that go with it."""
        with self.step(label, merge_key) as step:
            if settings is not None and settings != self.level.settings:
                step.atoms.append(Value(self.level.settings))
                self.level.set_settings(settings)
            for name, thing in things.items():
                step.atoms.append(Thing(name, self.level.objects.get(name)))
                self.level.put_object(name, thing)

    def whole(self, step: Step) -> None:
        """Keep the whole grid in an open step, before an import, resize or crop."""
        self._settle(step)  # tiles saved so far belong to the grid that is about to go
        step.atoms.append(Whole(whole_state(self.level)))

    # Undo

    def undo(self) -> str | None:
        """Go back one step; returns its label, None when there is none. An open stroke is aborted first."""
        if self.open:
            label = self.open.label
            self.abort()
            return label
        return self._move(self.done, self.undone)

    def redo(self) -> str | None:
        return None if self.open else self._move(self.undone, self.done)

    def _move(self, source: list[Step], target: list[Step]) -> str | None:
        if not source:
            return None
        step = source[-1]
        self._fetch(step)  # when the store fails, the step stays where it is
        source.pop()
        for atom in reversed(step.atoms):
            atom.swap(self.level)
        step.atoms.reverse()
        step.merge_key = ""
        target.append(step)
        self._keep_budget()
        return step.label

    @property
    def bytes(self) -> int:
        return sum(step.bytes for step in self.done) + sum(step.bytes for step in self.undone)

    def _keep_budget(self) -> None:
        over = self.bytes - self.budget_bytes
        for steps in (self.done, self.undone):
            for step in steps[:-1]:  # the farthest from now come first in both
                if over <= 0:
                    return
                if not step.spilled:
                    over -= step.bytes
                    self._spill(step, steps)

    def _spill(self, step: Step, steps: list[Step]) -> None:
        if self.store is None:
            steps.remove(step)
            return
        self._keys += 1
        step.spilled = f"step{self._keys}"
        self.store.put(step.spilled, pickle.dumps(step.atoms, protocol=5))
        step.atoms = []

    def _drop(self, step: Step) -> None:
        if step.spilled:
            self.store.drop(step.spilled)
            step.spilled = ""

    def _fetch(self, step: Step) -> None:
        if step.spilled:
            step.atoms = pickle.loads(self.store.get(step.spilled))
            self._drop(step)
