"""Grey ball, chrome ball and colour card before the camera, lit with everything else (L08)."""

from __future__ import annotations

import numpy as np

from ..frame import Frame

# The 24 patches of the ColorChecker in sRGB, as X-Rite publishes them, from dark skin to black
PATCHES = np.array([
    (115, 82, 68), (194, 150, 130), (98, 122, 157), (87, 108, 67), (133, 128, 177), (103, 189, 170),
    (214, 126, 44), (80, 91, 166), (193, 90, 99), (94, 60, 108), (157, 188, 64), (224, 163, 46),
    (56, 61, 150), (70, 148, 73), (175, 54, 60), (231, 199, 31), (187, 86, 149), (8, 133, 161),
    (243, 243, 242), (200, 200, 200), (160, 160, 160), (122, 122, 121), (85, 85, 85), (52, 52, 52),
])  # fmt: skip


def patch_albedo() -> np.ndarray:
    """Linear albedo of the patches, float32 `(24, 3)`."""
    v = PATCHES / 255
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4).astype(np.float32)


def draw(frame: Frame) -> None:
    if frame.view.scene != "lookdev":
        return
    frame.targets.gbuffer.use()
    frame.uniforms["u_patches"] = patch_albedo()
    frame.shader("lookdev.glsl").fullscreen()
