"""Shots made, and taken back into the paint, as edits (Z20; part of the session)."""

from __future__ import annotations

import base64
from pathlib import Path

import numpy as np

from ..level import BadInput, Clock
from ..level.atoms import Thing
from ..level.layers import WEATHER_GRID
from ..level.objects import Camera, Shot
from ..level.shot_skies import laid_on, paint_of, sky_at, sky_of_paint
from ..level.shots import SHAPE, sky_name, sky_of
from ..level.tiles import pack, unpack
from . import words
from .object_edits import checked_object
from .river_edits import RiverEdits

SOURCES = ("now", "paint")


class Shots(RiverEdits):
    """Skies of their own for a camera and a stretch of time."""

    clock: Clock

    def shot_add(
        self, name: str = "", start_s: float | None = None, end_s: float | None = None, fade_s: float = 2.0,
        camera: str = "", source: str | Path | np.ndarray = "now", at_s: float | None = None,
    ) -> str:  # fmt: skip
        """A shot as one step; returns its id. It starts now and lasts 20 s unless told otherwise.

        `source` is "now", the sky as that camera sees it at `at_s` (None for the clock's time); "paint", the painted
        sky over the simulation at the start; an image of a weather map; or an array `(512, 512, 3)`, row 0 south.
        """
        name = name or self._free_shot()
        if name in self.level.objects:
            raise BadInput(f"this level has an object {name!r} already")
        start_s = round(self.clock.time_s, 2) if start_s is None else start_s
        fields = {"start_s": start_s, "end_s": start_s + 20 if end_s is None else end_s, "fade_s": fade_s}
        thing = checked_object({"kind": "shot", "id": name, "camera": camera, **fields})
        if thing.end_s <= thing.start_s:
            raise BadInput(f"a shot from {thing.start_s:g} s must end after that, not at {thing.end_s:g} s")
        at_s = self.clock.time_s if at_s is None else at_s
        packed = ""
        if isinstance(source, np.ndarray):
            source, packed = "packed", base64.b85encode(pack(sky_of(source))).decode()
        word = words.ShotAdd(id=name, camera=camera, source=str(source), at_s=at_s, packed=packed, **fields)
        thing = thing.model_copy(update=self._hold_sky(word))
        self._end_stroke()
        with self._edit(word):
            self.journal.put_all(f"Shot {name}", {name: thing})
        if camera and not isinstance(self.level.objects.get(camera), Camera):
            self.notes.append(f"no camera of this level is called {camera!r} yet")
        if not self.level.settings.clouds.on:
            self.notes.append("clouds.on is off, so the shot is not seen yet")
        return name

    def _hold_sky(self, word: words.ShotAdd) -> dict[str, str | bool]:
        """The sky that a word asks for, held by the level: its name, and what it stands for."""
        level = self.level
        if word.source == "now":
            sky = sky_at(level, word.at_s, word.camera)
        elif word.source == "paint":
            sky = sky_of_paint(level, word.start_s, word.camera)
        elif word.source == "packed":
            sky = sky_of(unpacked(word.packed))
        else:
            from ..io.weather_maps import read_weather_map

            paint, notes = read_weather_map(word.source)
            self.notes += notes
            sky = laid_on(level, paint, word.start_s, word.camera)
        stem = Path(word.source).stem if word.source not in (*SOURCES, "packed") else word.id
        held = sky_name(stem, sky)
        level.put_sky(held, sky)
        # what comes from here has the paint in it; what comes whole has its own horizon
        return {"map": held, "painted": word.source not in SOURCES, "whole": word.source != "now"}

    def shot_to_paint(self, name: str) -> None:
        """Lay the sky of a shot over the painted one, wholly, and let paint show on the shot: one step."""
        shot = self.shot(name)
        if shot.map not in self.level.skies:
            raise BadInput(f"the shot {name!r} has no sky")
        paint = paint_of(self.level, self.level.skies[shot.map], shot.start_s)
        data = self.level.layers["weather"]
        self._end_stroke()
        with self._edit(words.ShotToPaint(id=name)), self.journal.step(f"Paint {name}") as step:
            step.save(data, WEATHER_GRID.rect)
            data.array[:] = paint
            self.level.mark("weather", WEATHER_GRID.rect)
            step.atoms.append(Thing(name, shot))
            self.level.put_object(name, shot.model_copy(update={"painted": True}))

    def shot_remove(self, name: str) -> None:
        """Remove a shot; BadInput when there is none of that id."""
        self.shot(name)
        self.remove(name)

    def shot(self, name: str) -> Shot:
        """A shot by its id; BadInput lists those there are."""
        thing = self.level.objects.get(name)
        if not isinstance(thing, Shot):
            known = ", ".join(sorted(o.id for o in self.level.objects.values() if isinstance(o, Shot))) or "none"
            raise BadInput(f"this level has no shot {name!r}; it has: {known}")
        return thing

    def _free_shot(self) -> str:
        number = 1
        while f"shot-{number}" in self.level.objects:
            number += 1
        return f"shot-{number}"


def unpacked(text: str) -> np.ndarray:
    """The array in a word of a script."""
    try:
        return unpack(base64.b85decode(text), SHAPE)
    except Exception:  # whatever its parts find wrong with bytes that are none of ours
        raise BadInput("its packed sky is damaged") from None
