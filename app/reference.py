"""docs/reference.md, made from the tables the program runs on: `python -m shorewright.app.reference` prints it."""

from __future__ import annotations

import sys
from collections.abc import Iterable

from ..brushes import BRUSHES
from ..io.export import EXPORTERS
from ..level.layers import LAYERS
from ..level.params import Param, describe
from ..level.settings import Settings
from ..renderer.show import SHOW_FLAGS
from ..renderer.views import VIEWS
from .actions import ACTIONS


def table(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> list[str]:
    """A Markdown table; bars in cells are escaped."""
    lines = [head, tuple("---" for _ in head), *rows]
    return [*("| " + " | ".join(str(cell).replace("|", "\\|") for cell in line) + " |" for line in lines), ""]


def parameters(rows: Iterable[Param]) -> list[str]:
    """Name, default, range, unit and sentence of parameters."""

    def span(row: Param) -> str:
        if row.choices:
            return " · ".join(map(str, row.choices))
        return "" if row.low is None else f"{row.low:g} … {row.high:g}"

    def default(row: Param) -> str:
        return f"{row.default:g}" if row.kind in ("float", "int") else str(row.default).lower()

    rows = [(f"`{row.name}`", default(row), span(row), row.unit, row.doc) for row in rows]
    return table(("name", "default", "range", "unit", "what it does"), rows)


def reference() -> str:
    """The whole page."""
    lines = ["# Reference", "", "Made from the program's own tables by `python -m shorewright.app.reference`.", ""]
    lines += ["## Keys", ""]
    actions = ACTIONS.values() if isinstance(ACTIONS, dict) else ACTIONS
    lines += table(
        ("action", "keys", "menu"),
        [(row.title, " · ".join(f"`{key}`" for key in row.keys), row.menu) for row in actions if row.keys],
    )
    lines += ["## Brushes", ""]
    for row in BRUSHES.values():
        lines += [f"**{row.label}** (`{row.name}`, key `{row.key}`): {row.doc}", "", *parameters(describe(row.params))]
    lines += ["## Settings", "", "On the command line: `--set NAME=VALUE`.", "", *parameters(describe(Settings))]
    lines += ["## Layers", ""]
    lines += table(
        ("layer", "channels", "unit", "what it is"),
        [(f"`{row.name}`", ", ".join(row.channels), row.unit, row.doc) for row in LAYERS.values()],
    )
    lines += ["## Views", "", "On the command line: `--view NAME`.", ""]
    lines += table(("view", "rows", "what it shows"), [(f"`{v.name}`", v.ids, v.doc) for v in VIEWS.values()])
    lines += ["## Show flags", "", "On the command line: `--hide NAME,NAME`.", ""]
    lines += table(("flag", "what it is"), [(f"`{flag.name}`", flag.doc) for flag in SHOW_FLAGS.values()])
    lines += ["## Export targets", ""]
    lines += table(("target", "what it writes"), [(f"`{row.name}`", row.doc) for row in EXPORTERS.values()])
    return "\n".join(lines).rstrip() + "\n"


if __name__ == "__main__":
    sys.stdout.write(reference())
