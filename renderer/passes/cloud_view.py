"""Views of the clouds' noises and of the numbers of their image (Z21)."""

from __future__ import annotations

from ..frame import Frame
from ..uniforms import set_uniforms
from .clouds import cloud_uniforms


def draw(frame: Frame) -> None:
    values = cloud_uniforms(frame)
    if "perlin" in frame.view.value:
        frame.textures["u_cloud_perlin"] = frame.renderer.clouds.perlin_slice()
    shader = frame.shader("cloud_view.glsl", VIEW_VALUE=frame.view.value)
    set_uniforms(shader.program, values)
    frame.targets.picture.use()
    shader.fullscreen()
