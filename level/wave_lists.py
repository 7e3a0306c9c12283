"""Which wave objects count: at most 4 reach any hectare, at most 32 a level (Hitman talk, H08).

An object is on the list of every hectare that its circle has a part in, so its weight is exactly 0 on all others and
neighbours agree at their border. Where a file has more, the weakest are left out of the whole sea, never of one hectare
alone: that would tear the water along its border.
"""

from __future__ import annotations

import numpy as np

from .errors import BadInput
from .level import Level
from .objects import SwellRegion, WaveObject
from .patches import PATCH_M, Circle, in_mesh

MOST_OBJECTS, MOST_ON_PATCH, MOST_REGIONS = 32, 4, 4


def _placed(level: Level) -> tuple[tuple[WaveObject, ...], tuple[SwellRegion, ...]]:
    """Both kinds by id; looked for once as long as no object changes, for the sea asks many times a picture."""
    known, made = level.derived.get("waves_placed", (None, None))
    if known != (level.objects_revision, len(level.objects)):
        things = sorted(level.objects.values(), key=lambda o: o.id)
        made = tuple(tuple(o for o in things if isinstance(o, kind)) for kind in (WaveObject, SwellRegion))
        level.derived["waves_placed"] = (level.objects_revision, len(level.objects)), made
    return made


def wave_objects(level: Level) -> tuple[WaveObject, ...]:
    """All of them, by id."""
    return _placed(level)[0]


def wave_regions(level: Level) -> tuple[SwellRegion, ...]:
    """Those that count, by id: the first MOST_REGIONS."""
    return _placed(level)[1][:MOST_REGIONS]


def strength(thing: WaveObject) -> tuple:
    """What the weakest has least of: height, then reach; of two alike the later id is weaker."""
    return thing.amplitude_m, thing.radius_m, tuple(-ord(c) for c in thing.id)


def hectares(thing: WaveObject) -> list[tuple[int, int]]:
    """Columns and rows of the hectares that its circle has a part in."""
    circle = Circle(thing.x, thing.y, thing.radius_m)
    spans = [
        np.arange(int(np.floor((v - thing.radius_m) / PATCH_M)), int(np.floor((v + thing.radius_m) / PATCH_M)) + 1)
        for v in (thing.x, thing.y)
    ]
    cols, rows = np.meshgrid(*spans)
    inside = in_mesh(circle, cols, rows)
    return list(zip(cols[inside].tolist(), rows[inside].tolist(), strict=True))


def patch_lists(things) -> dict[tuple[int, int], list[WaveObject]]:
    """Objects by hectare (column, row), those without any left out."""
    lists: dict[tuple[int, int], list[WaveObject]] = {}
    for thing in things:
        for at in hectares(thing):
            lists.setdefault(at, []).append(thing)
    return lists


def counted(level: Level) -> tuple[tuple[WaveObject, ...], tuple[str, ...]]:
    """The objects that make waves, by id, and a sentence for each that is left out; kept while objects stay."""
    things = wave_objects(level)
    known, made = level.derived.get("wave_lists", (None, None))
    if known != things:
        made = _counted(things)
        level.derived["wave_lists"] = things, made
    return made


def uncounted(level: Level) -> list[WaveObject]:
    """Wave objects that make no waves, being too many."""
    kept = counted(level)[0]
    return [thing for thing in wave_objects(level) if thing not in kept]


def _counted(things: tuple[WaveObject, ...]) -> tuple[tuple[WaveObject, ...], tuple[str, ...]]:
    kept, told = list(things), []
    while (crowd := crowded(kept)) is not None:
        at, those = crowd
        weakest = min(those, key=strength)
        kept.remove(weakest)
        told.append(f"{_too_many(at)}: {weakest.id}, the weakest, is left out of the sea")
    return tuple(kept), tuple(told)


def crowded(things) -> tuple[tuple[int, int] | None, list[WaveObject]] | None:
    """The fullest hectare with more objects than it may have, and those; hectare None: the level has too many."""
    things = list(things)
    if len(things) > MOST_OBJECTS:
        return None, things
    lists = patch_lists(things)
    at = max(sorted(lists), key=lambda key: len(lists[key]), default=None)
    return (at, lists[at]) if at is not None and len(lists[at]) > MOST_ON_PATCH else None


def _too_many(at: tuple[int, int] | None) -> str:
    if at is None:
        return f"a level has at most {MOST_OBJECTS} wave objects"
    west, south = at[0] * PATCH_M, at[1] * PATCH_M
    return f"at most {MOST_ON_PATCH} wave objects reach one hectare, and that from {west:g}, {south:g} m on has more"


def refuse_crowd(level: Level, thing: object) -> None:
    """BadInput when placing `thing`, or moving it there, would be one wave object or region too many."""
    others = [other for name, other in level.objects.items() if name != thing.id]
    if isinstance(thing, SwellRegion):
        regions = [other for other in others if isinstance(other, SwellRegion)]
        if len(regions) >= MOST_REGIONS:
            raise BadInput(f"a level has at most {MOST_REGIONS} regions of swell: remove one of them first")
    if not isinstance(thing, WaveObject):
        return
    before = level.objects.get(thing.id)
    mine = set(hectares(thing))
    waves = [other for other in others if isinstance(other, WaveObject)]
    if len(waves) >= MOST_OBJECTS and not isinstance(before, WaveObject):
        weakest = min(waves, key=strength)
        raise BadInput(f"{_too_many(None)}; the weakest is {weakest.id}, which might go first")
    # a file may have come with too many: what makes it no worse is allowed
    had = set(hectares(before)) if isinstance(before, WaveObject) else set()
    lists = patch_lists(waves)
    for at in sorted(mine - had):
        if len(lists.get(at, ())) >= MOST_ON_PATCH:
            weakest = min(lists[at], key=strength)
            raise BadInput(f"{_too_many(at)} with {thing.id}; the weakest there is {weakest.id}, which might go first")


def left_out(objects) -> tuple[str, ...]:
    """One sentence for each of a level's wave objects and regions of swell that makes no waves."""
    objects = sorted(objects, key=lambda o: o.id)
    regions = [o.id for o in objects if isinstance(o, SwellRegion)]
    told = f"a level has at most {MOST_REGIONS} regions of swell: "
    waves = _counted(tuple(o for o in objects if isinstance(o, WaveObject)))[1]
    return (*waves, *(f"{told}{name} is left out" for name in regions[MOST_REGIONS:]))
