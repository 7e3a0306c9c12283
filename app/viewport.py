"""The viewport panel: the picture, the pointer's work in it, what is drawn over it, and its small head-up bar."""

from __future__ import annotations

from imgui_bundle import imgui

from ..renderer import SHOW_FLAGS, VIEWS
from . import front_overlay, sky_brush, theme
from .actions import ACTIONS
from .editor import QUALITIES, Editor
from .marker_overlay import MarkerOverlay
from .panels import views_panel
from .param_widgets import tooltip
from .picture import Picture
from .shape_overlay import ShapeOverlay
from .tools import BRUSH, FRONT, LAKE, SELECT, TOOLS
from .viewport_overlay import Overlay, stroke_text
from .viewport_pointer import Pointer

_FLAGS = imgui.ButtonFlags_
FIRST_OF_GROUP = {next(name for name in TOOLS if name not in (BRUSH, SELECT, FRONT, LAKE)): "Drop"}
BUTTONS = _FLAGS.mouse_button_left | _FLAGS.mouse_button_right | _FLAGS.mouse_button_middle


class Viewport:
    """Draws itself into the current imgui window."""

    def __init__(self, editor: Editor, picture: Picture) -> None:
        self.editor = editor
        self.picture = picture
        self.pointer = Pointer(editor)
        self.corner = (0.0, 0.0)  # screen pixels, for whoever drives the window
        self.size = (16, 16)

    def draw(self) -> None:
        origin, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        size = max(int(room.x), 16), max(int(room.y), 16)
        self.corner, self.size = (origin.x, origin.y), size
        scale = imgui.get_io().display_framebuffer_scale
        texture = self.picture.show(self.editor, (int(size[0] * scale.x), int(size[1] * scale.y)))
        if texture is not None:
            imgui.image(imgui.ImTextureRef(texture.glo), imgui.ImVec2(*size), imgui.ImVec2(0, 1), imgui.ImVec2(1, 0))
        imgui.set_cursor_screen_pos(origin)
        imgui.set_next_item_allow_overlap()
        imgui.invisible_button("###viewport", imgui.ImVec2(*size), BUTTONS)
        hovered = imgui.is_item_hovered() or imgui.is_item_active()
        for key in (imgui.Key.mouse_wheel_y, imgui.Key.mod_alt):
            imgui.set_item_key_owner(key)
        self.pointer.update(origin, size, hovered)
        self._over(origin, size, hovered)
        self._bar(origin)

    def _over(self, origin, size, hovered: bool) -> None:
        draw_list = imgui.get_window_draw_list()
        corner = imgui.ImVec2(origin.x + size[0], origin.y + size[1])
        draw_list.push_clip_rect(origin, corner, True)
        overlay = Overlay(self.editor, draw_list, origin, size)
        session = self.editor.session
        preview = session.stroke.preview() if session.stroke else None
        if preview and "start" in preview:
            overlay.ramp(preview)
        elif sky_brush.in_hand(session):
            self._sky_ring(overlay, hovered)
        elif session.tool == BRUSH and session.cursor and self._brushing(hovered):
            io = imgui.get_io()
            stroke = session.stroke
            invert = stroke.invert if stroke else io.key_ctrl
            overlay.ring(session.cursor, invert, stroke.smooth if stroke else io.key_shift)
            if stroke:
                overlay.beside_pointer(stroke_text(self.editor.probe()))
        self.editor.fronts.updating = self.picture.updating or self.editor.settling
        front_overlay.draw(overlay, self._brushing(hovered))
        if session.tool == FRONT:
            ShapeOverlay(overlay, self.pointer.front).draw()
        MarkerOverlay(overlay).draw(self._where(origin) if hovered else None)
        if self.picture.drawn is None and not self.picture.failure:
            overlay.corner_text("Preparing the picture…")
        elif self.picture.failure:
            overlay.corner_text("The picture failed; see the log. The level is safe.", theme.RED)
        elif session.clock.paused:
            overlay.corner_text(f"{theme.icon('pause')}  paused at {session.clock.time_s:.2f} s", theme.WARM)
        overlay.toast()
        draw_list.pop_clip_rect()

    def _sky_ring(self, overlay: Overlay, hovered: bool) -> None:
        """The brush on the shell of clouds, where the pointer is here or on the weather map."""
        session, io = self.editor.session, imgui.get_io()
        point = session.sky_cursor if self._brushing(hovered) else self.editor.map_pointer
        if point is None:
            return
        held = session.stroke or sky_brush.Held(io.key_ctrl, io.key_shift)
        overlay.ring(point, held.invert, held.smooth, sky=True)

    def _brushing(self, hovered: bool) -> bool:
        return self.pointer.mode == "stroke" or (hovered and not self.pointer.mode)

    @staticmethod
    def _where(origin) -> tuple[float, float]:
        """The pointer in the viewport's pixels."""
        mouse = imgui.get_mouse_pos()
        return mouse.x - origin.x, mouse.y - origin.y

    # The bar over the picture

    def _bar(self, origin) -> None:
        """View chooser, show flags, overlays, cameras: small buttons that don't take the picture's place."""
        imgui.set_cursor_screen_pos(imgui.ImVec2(origin.x + 10, origin.y + 10))
        imgui.push_style_color(imgui.Col_.button, theme.colour(theme.SHADE, 0.66))
        imgui.push_style_color(imgui.Col_.frame_bg, theme.colour(theme.SHADE, 0.66))
        self._tools()
        imgui.same_line()
        self._views()
        imgui.same_line()
        self._flags()
        imgui.same_line()
        self._cameras()
        imgui.same_line()
        self._toggle("person_walking", "walkable", "Walkable depth: green where the player can go, red beyond.")
        imgui.same_line()
        self._water()
        imgui.pop_style_color(2)

    def _tools(self) -> None:
        """The tool in hand, and all others behind it."""
        session = self.editor.session
        row = TOOLS[session.tool]
        if _lit_button(theme.titled(row.glyph, row.title, "tool"), session.tool != BRUSH):
            imgui.open_popup("tool_popup")
        tooltip(f"What the left button does. {row.doc}")
        if imgui.begin_popup("tool_popup"):
            for tool in TOOLS.values():
                if tool.name in FIRST_OF_GROUP:
                    imgui.separator_text(FIRST_OF_GROUP[tool.name])
                label = theme.titled(tool.glyph, tool.title, f"tool_{tool.name}")
                if imgui.menu_item(label, "".join(tool.keys[:1]), tool.name == session.tool)[0]:
                    self.editor.do(ACTIONS[f"tool.{tool.name}"])
                tooltip(tool.doc)
            imgui.end_popup()

    def _views(self) -> None:
        session = self.editor.session
        imgui.set_next_item_width(150)
        current = VIEWS[session.view]
        if imgui.begin_combo("###view", current.label, imgui.ComboFlags_.height_large):
            for view in VIEWS.values():
                if imgui.selectable(f"{view.label}###view_{view.name}", view.name == session.view)[0]:
                    session.view = view.name
                tooltip(view.doc)
            imgui.end_combo()
        tooltip(f"What is shown. {current.doc}")

    def _flags(self) -> None:
        session = self.editor.session
        hidden = len(session.show.hidden)
        if imgui.button(theme.titled("eye", f"Show ({hidden} off)" if hidden else "Show", "show")):
            imgui.open_popup("show_popup")
        tooltip("Switch parts of the picture off; the level stays as it is.")
        if imgui.begin_popup("show_popup"):
            for name in SHOW_FLAGS:
                views_panel.flag_box(self.editor, name)
            imgui.separator()
            for name, label in (("outline", "Border of the level"), ("centre", "Centre of the screen")):
                changed, on = imgui.checkbox(label, getattr(self.editor, name))
                if changed:
                    setattr(self.editor, name, on)
            imgui.separator_text("Quality")
            for quality in QUALITIES:
                if imgui.radio_button(quality.capitalize(), self.editor.quality == quality):
                    self.editor.choose_quality(quality)
                imgui.same_line()
            imgui.new_line()
            imgui.end_popup()

    def _cameras(self) -> None:
        if imgui.button(theme.titled("video", "Camera", "camera")):
            imgui.open_popup("camera_popup")
        tooltip("Go to a saved camera, or save this view as one.")
        if imgui.begin_popup("camera_popup"):
            views_panel.cameras(self.editor)
            imgui.end_popup()

    def _toggle(self, glyph: str, name: str, doc: str) -> None:
        on = getattr(self.editor, name)
        if _lit_button(f"{theme.icon(glyph) or name}###{name}", on):
            setattr(self.editor, name, not on)
        tooltip(doc)

    def _water(self) -> None:
        session = self.editor.session
        if _lit_button(f"{theme.icon('water') or 'water'}###water", "water" in session.show):
            self.editor.do("water")
        tooltip("The water, on or off: off, the bed lies dry (Shift+W).")


def _lit_button(label: str, on: bool) -> bool:
    """A button that glows while it is on."""
    if on:
        imgui.push_style_color(imgui.Col_.button, theme.colour(theme.ACCENT, 0.95))
    clicked = imgui.button(label)
    if on:
        imgui.pop_style_color()
    return clicked
