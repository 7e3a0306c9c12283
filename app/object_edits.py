"""Objects placed, changed, renamed and removed, each an undoable step (part of the session)."""

from __future__ import annotations

from typing import Any

from pydantic import ValidationError

from ..level import BadInput
from ..level.objects import OBJECT, OBJECT_KINDS, Pin, Placed, WaveObject
from ..level.params import replace, sentence
from ..level.pins import check_pins, pinned
from ..level.wave_fit import fit_to_shore
from ..level.wave_lists import refuse_crowd
from . import words
from .prop_edits import Props


class Objects(Props):
    """`tool` is what a click in the viewport does (tools.py), `selected` the object in hand."""

    tool: str = "brush"
    selected: str = ""  # an id, "" for none; it may be gone by now
    mesh: str = ""  # that of new props, a name among the level's meshes; "" for the last one

    def place(self, thing: Any, merge: bool = False, use: bool = False) -> None:
        """Place an object (model or dict), or put it where the one with its id was; BadInput says what is wrong.

        `merge` joins the steps of a drag until `seal`; `use` makes a water table the one in use, in the same step.
        """
        thing = checked_object(thing)
        if merge and self.level.objects.get(thing.id) == thing:
            return
        refuse_crowd(self.level, thing)
        self._end_stroke()
        if isinstance(thing, Pin):
            check_pins(self.level, [*(pin for pin in pinned(self.level) if pin.id != thing.id), thing])
        settings = replace(self.level.settings, "water.table", thing.id) if use else None
        with self._edit(words.Place(object=thing, use=use), merge):
            self.journal.put_all(
                f"Place {thing.id}", {thing.id: thing}, f"object {thing.id}" if merge else "", settings
            )

    def alter(self, name: str, values: dict[str, Any], merge: bool = False) -> None:
        """Change fields of an object, checked; `merge` as in `place`; BadInput out of range."""
        thing = self.object(name)
        for field, value in values.items():
            thing = replace(thing, field, value)
        self.place(thing, merge)

    def fit_wave(self, name: str, place: bool = False) -> None:
        """Turn and bend a wave object along the shore near it, with `place` move it there too; one step (H09)."""
        thing = self.object(name)
        if not isinstance(thing, WaveObject):
            raise BadInput(f"{name} is no wave object, so there is nothing to fit to a bay")
        self.alter(name, fit_to_shore(self.level, thing, place))

    def remove(self, name: str) -> None:
        """Remove an object; BadInput when there is none of that id."""
        self.object(name)
        self._end_stroke()
        with self._edit(words.Remove(id=name)):
            self.journal.put(name, None)

    def rename(self, name: str, to: str) -> None:
        """Give an object another id, as one step; BadInput when that is taken or no id."""
        thing = self.object(name)
        if to == name:
            return
        if to in self.level.objects:
            raise BadInput(f"this level has an object {to!r} already")
        renamed = replace(thing, "id", to)
        self._end_stroke()
        settings = self.level.settings
        if settings.water.table == name:  # a table that is in use stays so
            settings = replace(settings, "water.table", to)
        with self._edit(words.Rename(id=name, to=to)):
            self.journal.put_all(f"Rename {name}", {name: None, to: renamed}, settings=settings)
        if self.selected == name:
            self.selected = to

    def object(self, name: str) -> Placed:
        """An object by its id; BadInput lists those there are."""
        if name not in self.level.objects:
            known = ", ".join(sorted(self.level.objects)) or "none"
            raise BadInput(f"this level has no object {name!r}; it has: {known}")
        return self.level.objects[name]


def checked_object(thing: Any) -> Placed:
    """An object of a model or a dict; BadInput says what is wrong."""
    # a model may be a copy whose values nobody has checked
    thing = thing.model_dump() if isinstance(thing, Placed) else thing
    try:
        return OBJECT.validate_python(thing)
    except ValidationError as error:
        kinds = ", ".join(OBJECT_KINDS)
        kind = thing.get("kind") if isinstance(thing, dict) else None
        told = sentence(error, "object") if kind in OBJECT_KINDS else f"an object's kind is one of {kinds}"
        raise BadInput(told) from None
