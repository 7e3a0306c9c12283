"""Settings of the mesh along the waterline (H03)."""

from __future__ import annotations

from .params import Section, param


class BeachMesh(Section):
    """The mesh along the waterline that exports and its view show (H03)."""

    along_m: float = param(5.0, 1, 50, "m", "Distance of its vertices along the shore.", soft=(2, 10))
    rows: int = param(9, 3, 64, "", "Rows of vertices across the shore, seaward to landward.")
    error_m: float = param(
        0.25, 0.01, 20, "m", "How far its sand may miss the ground before it gets more vertices.", soft=(0.1, 2)
    )
    seaward_m: float = param(28.0, 2, 200, "m", "How far out to sea it has rows.", soft=(10, 60))
    landward_m: float = param(16.0, 2, 200, "m", "How far up the land it has rows.", soft=(5, 40))
