"""Edits besides strokes: settings, objects, whole grids, undo, and scripts of all of them (part of the session)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..level import BadInput, Clock
from ..level.atoms import Thing, Value
from ..level.objects import Camera
from ..level.params import get, replace
from ..level.preset_cover import covered
from ..level.reshape import crop, crop_rect, replace_base, resize, resized_grid
from ..level.wave_lists import uncounted
from . import recovery_record, words
from .front_edits import FrontEdits
from .imported import imported_height
from .script import Script, parse
from .shot_edits import unpacked


class Edits(FrontEdits):
    """Everything but strokes that changes a level, each an undoable step."""

    clock: Clock
    camera: Camera

    # Settings

    def set(self, path: str, value: Any, merge: bool = False, always: bool = False) -> None:
        """Change a setting such as `sea.swell_m`; `merge` joins the steps of a slider drag until `seal`.

        The value it has already leaves no step unless `always`.
        """
        changed = replace(self.level.settings, path, value)
        if changed == self.level.settings and not always:
            return
        self._end_stroke()
        with self._edit(words.Set(name=path, value=get(changed, path)), merge):
            self.journal.set(path, value, merge)

    def set_all(self, label: str, values: dict[str, Any], merge: bool = False) -> None:
        """Change settings that belong together, by path, as one step of that label; `merge` as in `set`."""
        changed = self.level.settings
        for path, value in values.items():
            changed = replace(changed, path, value)
        if changed == self.level.settings:
            return
        self._end_stroke()
        word = words.SetAll(label=label, values={path: get(changed, path) for path in values})
        with self._edit(word, merge):
            self.journal.set_settings(label, changed, label if merge else "")
        self.notes += covered(self.level, values, self.clock.time_s, self.camera.id)

    def seal(self) -> None:
        """The slider was let go: its next change is a step of its own."""
        self.journal.seal()

    # Whole grids

    def resize(self, samples: int | None = None, cell_m: float | None = None) -> None:
        """Resample every map: to `samples` on the longer side, or to another cell; the land covered stays."""
        grid = resized_grid(self.level.grid, samples, cell_m)
        self._end_stroke()
        with self._edit(words.Resize(samples=samples, cell_m=cell_m)), self.journal.step("Resize") as step:
            self.journal.whole(step)
            resize(self.level, grid)

    def crop(self, west_m: float, south_m: float, east_m: float, north_m: float) -> None:
        """Keep a rectangle of metres, grown to whole cells; its corner becomes 0, 0, objects and sky move along."""
        rect = crop_rect(self.level.grid, west_m, south_m, east_m, north_m)
        word = words.Crop(west_m=west_m, south_m=south_m, east_m=east_m, north_m=north_m)
        self._end_stroke()
        with self._edit(word), self.journal.step("Crop") as step:
            self.journal.whole(step)
            step.atoms.append(Value(self.level.settings))
            before = {name for name, thing in self.level.objects.items() if self._inside(thing)}
            left_out = {thing.id for thing in uncounted(self.level)}
            moved = crop(self.level, rect)
            for name, thing in list(self.level.objects.items()):
                step.atoms.append(Thing(name, thing))
                self.level.put_object(name, thing.moved(-moved[0], -moved[1]))
        outside = sorted(name for name in before if not self._inside(self.level.objects[name]))
        if outside:
            self.notes.append(f"outside the level now, where they stood: {', '.join(outside)}")
        # hectares lie elsewhere now, so another may have too many wave objects
        crowded_out = sorted(thing.id for thing in uncounted(self.level) if thing.id not in left_out)
        if crowded_out:
            self.notes.append(f"left out of the sea now, for a hectare has too many: {', '.join(crowded_out)}")

    def _inside(self, thing: Any) -> bool:
        east_m, north_m = self.level.grid.extent_m
        return 0 <= thing.x <= east_m and 0 <= thing.y <= north_m

    def import_height(self, path: Path | str, **flags) -> list[str]:
        """Put another ground under what was sculpted, which stays where the grid is the same; returns what to tell."""
        found = imported_height(path, flags)
        self._end_stroke()
        word = words.Import(path=str(path), flags=flags)
        with self._edit(word), self.journal.step(f"Import {Path(path).name}") as step:
            self.journal.whole(step)
            same = replace_base(self.level, found.height, found.cell_m)
            self.level.georeference = dict(found.georeference or {})
        notes = list(found.notes)
        if not same:
            notes.append(
                "the import has another grid, so what was sculpted and painted before is gone (undo brings it back)"
            )
        self.notes += notes
        return notes

    def apply_change(self, change: recovery_record.Change) -> None:
        """Bring in what a recovery log held, as one step."""
        with self._edit():
            recovery_record.apply(self.level, self.journal, change)

    # Undo

    def undo(self) -> str | None:
        """Go back one step; an open stroke is aborted instead. Returns its label, None when there is none."""
        if self.stroke:
            label = self.journal.open.label if self.journal.open else None
            self.stroke_abort()
            return label
        return self._moved(self.journal.undo(), self.journal.undone, "undo")

    def redo(self) -> str | None:
        """Go forward again; nothing while a stroke is open."""
        return None if self.stroke else self._moved(self.journal.redo(), self.journal.done, "redo")

    def _moved(self, label: str | None, now_in: list, word: str) -> str | None:
        if label is not None:
            self._noted(now_in[-1])
            self._recorded(words.Plain(do=word))
        return label

    # Time

    def pause(self) -> None:
        self.clock.paused = True
        self._recorded(words.Plain(do="pause"))

    def run_time(self) -> None:
        """Let time run."""
        self.clock.paused = False
        self._recorded(words.Plain(do="run"))

    def toggle_pause(self) -> None:
        self.run_time() if self.clock.paused else self.pause()

    def step_time(self, steps: int = 1) -> None:
        """To the next (or, negative, an earlier) whole step of the clock, paused there."""
        self.clock.step(steps)
        self._recorded(words.Steps(steps=steps))

    def scrub(self, time_s: float) -> None:
        """Go to a moment."""
        self.clock.scrub(time_s)
        last = self.record[-1] if self.record else None
        if isinstance(last, words.Time):
            self.record.pop()
        self._recorded(words.Time(t=self.clock.time_s))

    # Scripts

    @property
    def script(self) -> dict:
        """What was done so far, as plain data that `run` takes."""
        return Script(actions=self.record).dump()

    def run(self, script: dict | Script, name: str = "the script", progress=None) -> int:
        """Do everything in a script, checked first; returns how many actions.

        BadInput names the number of the action that failed; what was done before it stays, as steps to undo.
        """
        script = parse(script, name)
        self._rehearse(script, name)
        for number, action in enumerate(script.actions, 1):
            try:
                self._do(action)
            except BadInput as error:
                raise BadInput(f"{name}, action {number} ({action.do}): {error}") from None
            if progress:
                progress(number, len(script.actions))
        return len(script.actions)

    def _rehearse(self, script: Script, name: str) -> None:
        """Find unknown brushes, parameters and settings before anything is done."""
        settings = self.level.settings
        for number, action in enumerate(script.actions, 1):
            try:
                if isinstance(action, words.Stroke):
                    self.with_params(action.brush, action.params, fresh=True)
                elif isinstance(action, words.Set):
                    settings = replace(settings, action.name, action.value)
                elif isinstance(action, words.SetAll):
                    for path, value in action.values.items():
                        settings = replace(settings, path, value)
            except BadInput as error:
                raise BadInput(f"{name}, action {number} ({action.do}): {error}") from None

    def _do(self, action: words.Action) -> None:
        match action:
            case words.Stroke():
                options = {"invert": action.invert, "smooth": action.smooth}
                params = self.with_params(action.brush, action.params, fresh=True)
                self.draw(action.brush, params, action.points, **options)
            case words.CarveRiver():
                self.river_carve(action.id)
            case words.FillWater():
                self.fill_water(*action.at, action.level_m, action.drain)
            case words.ShapeFront():
                self.shape_front(**action.model_dump(exclude={"do"}))
            case words.Set():
                self.set(action.name, action.value, always=True)  # a drag that ended where it began was a step
            case words.SetAll():
                self.set_all(action.label, action.values)
            case words.Time():
                self.scrub(action.t)
            case words.Steps():
                self.step_time(action.steps)
            case words.Place():
                self.place(action.object, use=action.use)
            case words.Remove():
                self.remove(action.id)
            case words.Rename():
                self.rename(action.id, action.to)
            case words.ShotAdd():
                source = unpacked(action.packed) if action.source == "packed" else action.source
                fields = action.model_dump(include={"start_s", "end_s", "fade_s", "camera", "at_s"})
                self.shot_add(action.id, source=source, **fields)
            case words.ShotToPaint():
                self.shot_to_paint(action.id)
            case words.Resize():
                self.resize(action.samples, action.cell_m)
            case words.Crop():
                self.crop(action.west_m, action.south_m, action.east_m, action.north_m)
            case words.Import():
                self.import_height(action.path, **action.flags)
            case words.Mesh():
                self.import_mesh(action.path, action.up, action.scale)
            case words.WeatherImport():
                self.weather_import(**action.model_dump(exclude={"do"}))
            case words.Plain():
                PLAIN[action.do](self)


PLAIN = {"pause": Edits.pause, "run": Edits.run_time, "undo": Edits.undo, "redo": Edits.redo}
