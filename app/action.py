"""What a command of the editor is: a row of ACTIONS."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .session import Session


@dataclass(frozen=True)
class Action:
    """A row: `menu` is where it stands ("" for nowhere), `enabled` whether it can do something now."""

    id: str
    title: str
    keys: tuple[str, ...]
    menu: str
    run: Callable[[Session], object]
    enabled: Callable[[Session], bool] = lambda session: True
    repeats: bool = False  # holding the key goes on
