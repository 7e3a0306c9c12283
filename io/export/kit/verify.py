"""Check the kit of an export: its maps fill the .f32, and every probe says a sea that can be."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np

from ..records import Manifest
from .files import NAME


def check_kit(manifest: Manifest, whole: dict[str, Path]) -> list[str]:
    """Findings about the kit's numbers; files that are missing or changed were reported before this."""
    records = {Path(record.name).suffix: record for record in manifest.files if record.map == NAME}
    numbers, texels = records.get(".json"), records.get(".f32")
    if not records or numbers is None or numbers.name not in whole:
        return [] if not records or numbers else ["the runtime kit has no numbers (.json)"]
    try:
        data = json.loads(whole[numbers.name].read_text("utf-8"))
        ends = [m["offset"] + m["width"] * m["height"] * m["channels"] for m in data["maps"].values()]
        normals = np.array([p["normal"] for p in data["probes"]], np.float64).reshape(-1, 3)
        heights = np.array([p["position"] for p in data["probes"]], np.float64).reshape(-1, 3)[:, 2]
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError, RecursionError):
        return [f"{numbers.name} is no list of numbers that a runtime kit has"]
    findings = []
    if texels is not None and max(ends, default=0) * 4 != texels.size_bytes:
        findings.append(f"{texels.name} holds {texels.size_bytes} bytes, its maps need {max(ends, default=0) * 4}")
    if not len(normals) or np.abs(np.linalg.norm(normals, axis=1) - 1).max() > 1e-3:
        findings.append(f"{numbers.name}: its probes have normals that are not of unit length")
    off = np.abs(heights - manifest.world.sea_level_m)
    far = manifest.world.height_max_m - manifest.world.height_min_m + 100.0
    if not np.isfinite(heights).all() or (len(off) and off.max() > far):
        findings.append(f"{numbers.name}: its probes have heights that no sea of this level reaches")
    return findings
