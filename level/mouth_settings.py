"""Where a river's water goes over into the sea's (D35): a section of `param` rows."""

from __future__ import annotations

from .params import Section, param


class MouthLook(Section):
    """How the plume of a river looks out at sea."""

    plume: float = param(1.0, 0, 1, "", "How much of a river's colour goes out to sea with its jet.")
    waver: float = param(1.0, 0, 3, "×", "How far eddies along its sides push them in and out.", soft=(0, 2))
    seam: float = param(0.9, 0, 1, "", "Foam in a thin line where its water shears along the sea's.")
    flotsam: float = param(0.6, 0, 1, "", "Leaves and wood that gather in that line.")
    blocked: float = param(0.8, 0, 1, "", "Foam of chop that breaks where the current holds it up.")
