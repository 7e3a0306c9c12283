"""docs/schema, made from the models that write and check exports: `python -m shorewright.app.schemas docs/schema`."""

from __future__ import annotations

import sys
from pathlib import Path

from ..io.export.data_schema import MODELS, schema_text


def main(folder: Path) -> None:
    """Write the JSON Schema of the manifest and of every data file into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in MODELS:
        (folder / f"{name}.schema.json").write_text(schema_text(name), "utf-8", newline="\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
