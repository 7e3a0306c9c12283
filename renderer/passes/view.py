"""A buffer or mask in place of the picture: the view's own expression, compiled into shaders/view.glsl."""

from __future__ import annotations

from ...level.flow_bytes import flow_bytes
from ..frame import Frame
from ..high_layers import bind_patterns
from ..uniforms import shore_field_uniforms
from ..view_row import View
from . import cloud_view, weather
from .fronts import passage_uniforms
from .sea import bind_water, extent_uniforms, sea_extent


def draw(frame: Frame) -> None:
    if not frame.view.value:
        return
    if frame.view.sky:
        cloud_view.draw(frame)
        return
    defines = bind_view(frame, frame.view)
    frame.targets.picture.use()
    frame.shader("view.glsl", **defines).fullscreen()


def bind_view(frame: Frame, view: View) -> dict[str, str]:
    """What a view's expression reads, bound; returns the defines that it is compiled with."""
    uploader = frame.renderer.uploader
    defines = {"VIEW_VALUE": view.value}
    if view.layer:
        defines["LAYER"] = ""
        frame.textures["u_layer"] = uploader.layer(frame.level, view.layer)
        frame.uniforms["u_layer_cell_m"] = frame.level.layers[view.layer].grid.cell_m
    if view.name == "walkable":
        defines["WALKABLE"] = ""
        frame.textures["u_walkable"] = uploader.walkable(frame.level)
    if "shore_field" in view.value:
        defines["SHORE_FIELD"] = ""
        frame.textures["u_shore_field"] = uploader.shore_field(frame.level)
        frame.uniforms |= shore_field_uniforms(frame.level)
    if "flow_exported" in view.value or "flow_lost" in view.value:
        defines["FLOW_BYTES"] = ""
        _bind_flow_bytes(frame)
    if "passage_" in view.value:
        defines["PASSAGE"] = ""
        frame.uniforms |= passage_uniforms(frame)
    if "cirrus_at" in view.value or "alto_at" in view.value:
        defines["HIGH_CLOUDS"] = ""
        bind_patterns(frame, frame.renderer.kept)
    if "patch_colour" in view.value:
        defines["PATCHES"] = ""
        frame.textures["u_patch_kinds"], frame.uniforms["u_patch_first"] = uploader.patch_kinds(frame.level)
        frame.uniforms |= extent_uniforms(frame, sea_extent(frame))
    if "beach_mesh" in view.value:
        defines["BEACH_MESH"] = ""
        frame.textures["u_beach_mesh"], frame.uniforms["u_beach_mesh_cell_m"] = uploader.beach_mesh(frame.level)
    if "weather_stage" in view.value:
        defines["WEATHER_STAGE"] = ""
        weather.bind_map(frame, view.name.removeprefix("weather_"))
    if "rain_at" in view.value or "weather_map" in view.value:
        defines["WEATHER"] = ""
        weather.bind_map(frame)
    bind_water(frame)
    return defines


def _bind_flow_bytes(frame: Frame) -> None:
    coded = flow_bytes(frame.level)
    frame.textures["u_flow_bytes"] = frame.renderer.uploader.flow_bytes(frame.level)
    frame.uniforms |= {"u_flow_bytes_cell_m": coded.cell_m, "u_flow_range_mps": coded.range_mps}
