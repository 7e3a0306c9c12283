"""A script: what was done to a level, as JSON that people write, recordings produce and `shorewright stroke` replays.

    {"version": 1, "actions": [
      {"do": "time", "t": 12.5}, {"do": "pause"},
      {"do": "stroke", "brush": "raise", "params": {"size_m": 8}, "points": [[40, 52], [60, 55, 0.5]]},
      {"do": "set", "name": "sea.swell_m", "value": 1.2}, {"do": "undo"}]}

Its words are in words.py. An error names the action by its number, from 1.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from ..level import BadInput
from .words import ACTION, WORDS, Action

VERSION = 1
MAX_BYTES = 256 << 20


class Script(BaseModel):
    """A checked script."""

    version: int = VERSION
    actions: list[Action] = []

    def dump(self) -> dict:
        """As plain data for JSON; `parse` reads it back."""
        return {"version": VERSION, "actions": [action.model_dump(mode="json") for action in self.actions]}


def parse(raw: Any, name: str = "the script") -> Script:
    """A script from plain data; BadInput with the number of the action that cannot be used."""
    if isinstance(raw, Script):
        return raw
    if not isinstance(raw, dict) or not isinstance(raw.get("actions"), list):
        raise BadInput(f'{name} is not a script: it must be an object like {{"version": 1, "actions": […]}}')
    version = raw.get("version")
    if version != VERSION:
        newer = isinstance(version, int) and version > VERSION
        raise BadInput(f"{name} has version {version!r}, not {VERSION}" + ("; update Shorewright" if newer else ""))
    extra = sorted(set(raw) - {"version", "actions"})
    if extra:
        raise BadInput(f"{name} has {extra[0]!r} beside version and actions, which means nothing here")
    return Script(actions=[_action(item, f"{name}, action {n}") for n, item in enumerate(raw["actions"], 1)])


def _action(item: Any, where: str) -> Action:
    try:
        return ACTION.validate_python(item)
    except ValidationError as error:
        raise BadInput(f"{where}{_said(item)}: {_first(error)}") from None


def _said(item: Any) -> str:
    word = item.get("do") if isinstance(item, dict) else None
    return f" ({word})" if isinstance(word, str) else ""


def _first(error: ValidationError) -> str:
    first = error.errors()[0]
    # the discriminator, and the class that a union tried, are no names a person wrote
    path = [str(part) for part in first["loc"][1:] if not str(part).startswith("tuple")]
    if not first["loc"] and first["type"].startswith("union_tag"):
        return f'"do" must be one of {", ".join(WORDS)}'
    told = first["msg"].removeprefix("Value error, ")
    told = f"{told[0].lower()}{told[1:]}"
    return f"{'.'.join(path)}: {told}" if path else told


def load(path: Path | str) -> Script:
    """A script from a JSON file; BadInput when it is missing, no JSON or no script."""
    path = Path(path)
    try:
        if path.stat().st_size > MAX_BYTES:
            raise BadInput(f"{path} is larger than {MAX_BYTES >> 20} MB: split the script")
        text = path.read_text("utf-8")
    except FileNotFoundError:
        raise BadInput(f"{path} does not exist") from None
    except UnicodeDecodeError:
        raise BadInput(f"{path} is not UTF-8 text, so it is no script") from None
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from None
    try:
        raw = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise BadInput(f"{path} is not valid JSON: {error}") from None
    return parse(raw, str(path))


def dumps(script: Script) -> str:
    """JSON text, one action a line."""
    lines = ",\n".join("  " + json.dumps(action, allow_nan=False) for action in script.dump()["actions"])
    return f'{{"version": {VERSION}, "actions": [\n{lines}\n]}}\n'
