"""NAME_objects.json: all that is placed in a level, a list a kind, in the level's coordinates and the engine's."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from pydantic import BaseModel, Field, create_model

from ...level import Level
from .data_axes import Frame, clean
from .data_kinds import FACTS, kinds
from .data_models import DataFile, EngineAxes, EnginePose, Place, Pose, copied, vector

HIGHER = (
    "Where it is: metres, x east, y north, z up. What has no height of its own lies on the water, or on the ground "
    "where that is higher; a prop is where it is at time 0, one that floats on the waves."
)
NEAR_M = 1e-5  # that a place of the file may be off its twin


def _model(kind: str, source: type[BaseModel]) -> type[BaseModel]:
    facts = [fact for fact in FACTS if fact.kind == kind]
    extra: dict[str, Any] = {}
    if not source.placeless:
        turned = "yaw_deg" in source.model_fields
        extra["place"] = (Pose if turned else Place, Field(description=HIGHER))
        extra["engine"] = (EnginePose if turned else Place, Field(description="The same in the target's axes, units."))
    extra |= {fact.name: (fact.type, Field(description=fact.doc)) for fact in facts}
    without = tuple(fact.name for fact in facts) + (("x", "y") if source.placeless else ())
    return copied(source.__name__, source, extra, without)


def rows_of(in_time: bool) -> dict[str, Any]:
    """Fields of a file: for each kind a list of its objects, by id."""
    return {
        kind: (list[_model(kind, source)], Field(description=source.__doc__.split("\n")[0]))
        for kind, source in kinds(in_time).items()
    }


class _Objects(DataFile):
    engine: EngineAxes


ObjectsFile = create_model(
    "ObjectsFile",
    __base__=_Objects,
    __module__=__name__,
    __doc__="Everything placed, a list a kind by id; `place` in metres of the level, `engine` as the target has it.",
    **rows_of(False),
)


def make(level: Level, frame: Frame) -> dict[str, Any] | None:
    """None for a level in which nothing is placed."""
    rows = listed(level, frame, False)
    return {"engine": EngineAxes.of(frame).model_dump(), **rows} if any(rows.values()) else None


def listed(level: Level, frame: Frame, in_time: bool) -> dict[str, list[dict[str, Any]]]:
    """The objects of each kind by id, with their facts."""
    at_0 = _props(level) if not in_time else {}
    rows: dict[str, list] = {kind: [] for kind in kinds(in_time)}
    for key in sorted(level.objects):
        thing = level.objects[key]
        if thing.kind in rows:
            rows[thing.kind].append(_row(level, frame, thing, at_0.get(key)))
    return rows


def _props(level: Level) -> dict[str, Any]:
    from ...level.buoyancy import poses

    return poses(level, 0.0) if any(thing.kind == "prop" for thing in level.objects.values()) else {}


def _row(level: Level, frame: Frame, thing, pose) -> dict[str, Any]:
    own = {key: value for key, value in thing.model_dump().items() if not (thing.placeless and key in ("x", "y"))}
    if not thing.placeless:
        own |= _placed(level, frame, thing, pose)
    return own | {fact.name: fact.make(level, frame, thing) for fact in FACTS if fact.kind == thing.kind}


def _placed(level: Level, frame: Frame, thing, pose) -> dict[str, Any]:
    """Its place, and where it looks if it can be turned."""
    from ...level.buoyancy import turned

    at = (thing.x, thing.y, _height(level, thing)) if pose is None else pose.place
    at = clean(at)
    place, engine = vector(at), vector(frame.place(at))
    if hasattr(thing, "yaw_deg"):
        pitch, roll = getattr(thing, "pitch_deg", 0.0), getattr(thing, "roll_deg", 0.0)
        axes = turned(thing.yaw_deg, pitch, roll) if pose is None else pose.axes
        for name, way in (("ahead", axes[:, 1]), ("up", axes[:, 2])):
            place[name], engine[name] = vector(clean(way, 9)), vector(frame.direction(way))
        engine["rotation"] = vector(frame.rotation(axes))
    return {"place": place, "engine": engine}


def _height(level: Level, thing) -> float:
    """World height of a thing: its own, else that of the water or the ground, whichever is higher."""
    from ...level.pick import ground_at
    from ...level.river_water import still_water_m

    if hasattr(thing, "z"):
        return thing.z
    at = np.array([thing.x]), np.array([thing.y])
    return float(max(still_water_m(level, *at)[0], ground_at(level, *at)[0]))


def off(level: Level, file: BaseModel) -> float:
    """How far the engine's places, taken back, are off the level's own, cm; inf when a parameter isn't the level's."""
    frame = Frame(file.engine.target, file.engine.north_m, file.engine.sea_level_m)
    for kind in kinds(False):
        for row in getattr(file, kind):
            own = level.objects[row.id].model_dump()
            told = row.model_dump()
            replaced = {fact.name for fact in FACTS if fact.kind == kind}
            if any(told[key] != own[key] for key in own.keys() & told.keys() - replaced):
                return float("inf")
    return 100 * max((away_m(frame, pair) for pair in pairs(file)), default=0.0)


def pairs(model: Any) -> Iterator[BaseModel]:
    """Every part of a file that has a place in the level and one in the engine."""
    if isinstance(model, BaseModel):
        if "place" in type(model).model_fields:
            yield model
        for name in type(model).model_fields:
            yield from pairs(getattr(model, name))
    elif isinstance(model, list | tuple):
        for one in model:
            yield from pairs(one)


def away_m(frame: Frame, pair) -> float:
    """How far the engine's place of something lies from its place in the level; a turn counts as metres of its axes."""
    place, engine = pair.place, pair.engine
    off = [np.abs(frame.back([engine.x, engine.y, engine.z]) - [place.x, place.y, place.z]).max()]
    if isinstance(engine, EnginePose):
        for name in ("ahead", "up"):
            here, there = (list(getattr(end, name).model_dump().values()) for end in (place, engine))
            off.append(np.abs(frame.direction(here) - there).max())
        off.append(_turned_off(frame, engine))
    return float(max(off))


def _turned_off(frame: Frame, engine: EnginePose) -> float:
    """Between the axes that the quaternion turns the engine's own to, and those that are told."""
    from scipy.spatial.transform import Rotation

    q = list(engine.rotation.model_dump().values())
    if abs(np.linalg.norm(q) - 1) > 1e-6:
        return 1.0
    _, ahead, up = Rotation.from_quat(q).apply(np.array(frame.axes.looks, float))
    return float(max(np.abs(ahead - [*vars(engine.ahead).values()]).max(),
                     np.abs(up - [*vars(engine.up).values()]).max()))  # fmt: skip


def check(file, others: dict[str, BaseModel], manifest) -> list[str]:
    """Findings: ids, and that every place of the engine is that of the level."""
    frame = Frame.told(manifest)
    if file.engine != EngineAxes.of(frame):
        return ["its axes are not those of the manifest"]
    ids = [row.id for kind in kinds(False) for row in getattr(file, kind)]
    findings = [] if len(ids) == len(set(ids)) else ["two objects have one id"]
    wrong = [name for name, row in named_rows(file) if any(not away_m(frame, pair) < NEAR_M for pair in pairs(row))]
    if wrong:
        findings.append(f"{', '.join(wrong[:3])}: place and engine are two places")
    return findings


def named_rows(file) -> Iterator[tuple[str, BaseModel]]:
    for kind in kinds(False):
        for row in getattr(file, kind):
            yield row.id, row
