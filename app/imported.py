"""A height map read with flags that came from a command line, a form or a script."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..level import BadInput

if TYPE_CHECKING:
    from ..io import Heightmap


def imported_height(path: Path | str, flags: dict[str, Any]) -> Heightmap:
    """`io.import_height` with flags that may come from a script; BadInput for one it doesn't know."""
    from inspect import signature

    from ..io import import_height

    known = list(signature(import_height).parameters)[1:]
    for name in flags:
        if name not in known:
            raise BadInput(f"an import has no flag {name!r}; it has: {', '.join(known)}")
    flags = {name: tuple(value) if isinstance(value, list) else value for name, value in flags.items()}
    try:
        return import_height(path, **flags)
    except (TypeError, AttributeError) as error:
        raise BadInput(f"a flag of the import of {path} is of the wrong kind ({error})") from None
