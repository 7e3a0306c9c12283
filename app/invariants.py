"""What is true of a session after every edit; tests call it after each of theirs."""

from __future__ import annotations

import math

import numpy as np

from .session import Session


def broken(session: Session) -> list[str]:
    """Sentences about what is wrong, [] when all holds. Reads every sample: not for every frame."""
    return [*_layers(session), *_objects(session), *_undo(session)]


def _layers(session: Session) -> list[str]:
    found = []
    live = session.stroke is not None
    for name, data in session.level.layers.items():
        if name != "height" and data.neutral:
            continue
        if data.array.shape != data.shape or data.array.dtype != np.float32:
            found.append(f"{name} is {data.array.dtype} {data.array.shape}, not float32 {data.shape}")
        if not np.isfinite(data.array).all():
            found.append(f"{name} holds values that are no numbers")
        if live:
            continue
        found += _unwritten(name, data)
    height = session.level.layers["height"]
    if not live and not height.neutral and not np.array_equal(height.array, height.base + height.sculpt):
        found.append("height is not its base and what was sculpted on it")
    return found


def _unwritten(name: str, data) -> list[str]:
    """Tiles that were never written are neutral."""
    for tile in data.grid.tiles(data.grid.rect):
        where = data.grid.tile_rect(tile).slices
        neutral = data.base[where] if name == "height" else 0
        if not data.written[tile] and not np.array_equal(
            data.array[where], np.broadcast_to(neutral, data.array[where].shape)
        ):
            return [f"{name} has tile {tile} changed but not written"]
    return []


def _objects(session: Session) -> list[str]:
    return [f"{key} is called {thing.id}" for key, thing in session.level.objects.items() if thing.id != key]


def _undo(session: Session) -> list[str]:
    journal = session.journal
    found = []
    if (journal.open is not None) != (session.stroke is not None):
        found.append("a step is open without a stroke, or a stroke without a step")
    held = sum(step.bytes for step in [*journal.done[:-1], *journal.undone[:-1]])
    if held > journal.budget_bytes:
        found.append(f"undo holds {held} bytes, more than its budget")
    if not math.isfinite(session.clock.time_s) or session.clock.time_s < 0:
        found.append(f"the clock stands at {session.clock.time_s}")
    return found
