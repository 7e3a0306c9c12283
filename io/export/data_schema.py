"""JSON Schema (draft 2020-12) of the data files and the manifest, made from the models that write and check them.

    python -m shorewright.app.schemas docs/schema

Units, ranges, defaults and sentences come from where a parameter is declared. `unit` and `soft` (a slider's range) are
annotations of our own, which validators pass over.
"""

from __future__ import annotations

import json
from functools import lru_cache
from typing import Any

from pydantic import BaseModel, Field

from .data_models import VERSION
from .data_rows import DATA
from .records import SCHEMA_VERSION, Manifest

DIALECT = "https://json-schema.org/draft/2020-12/schema"
MANIFEST = "manifest"


class SignedManifest(Manifest):
    """What an export says of itself: each file's format, formula, numbers, measured error and hash."""

    manifest_sha256: str = Field(pattern="^[0-9a-f]{64}$", description="Of all the rest, keys sorted, without spaces.")


MODELS: dict[str, tuple[type[BaseModel], int]] = {
    **{row.name: (row.model, VERSION) for row in DATA.values()},
    MANIFEST: (SignedManifest, SCHEMA_VERSION),
}


def schema(name: str) -> dict[str, Any]:
    """The schema of a row of DATA, or of the manifest."""
    model, version = MODELS[name]
    made = _plain(model.model_json_schema(mode="serialization", by_alias=True))
    return {"$schema": DIALECT, "$id": f"urn:shorewright:{name}:{version}", "title": f"Shorewright {name}", **made}


@lru_cache(32)
def schema_text(name: str) -> str:
    return json.dumps(schema(name), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _plain(node: Any) -> Any:
    """Without titles that repeat names and annotations that say nothing; all fields are required, for all are written.

    Names of fields and models are no keywords: they are looked into, never dropped.
    """
    if isinstance(node, list):
        return [_plain(one) for one in node]
    if not isinstance(node, dict):
        return node
    out: dict[str, Any] = {}
    for key, value in node.items():
        if key == "title" or (key in ("unit", "soft") and not value):
            continue
        named = key in ("properties", "$defs")
        out[key] = {name: _plain(one) for name, one in value.items()} if named else _plain(value)
    if "properties" in out and out.get("additionalProperties") is False:
        out["required"] = list(out["properties"])
    return out
