"""Read the timing (T06): where times come from, what is drawn on the water, and where the level makes trouble."""

from __future__ import annotations

from imgui_bundle import imgui

from ...level.framing import frame
from ...level.hot_spots import KINDS, HotSpot
from ...level.params import get
from ...renderer.show import MOST_GHOSTS
from .. import front_overlay, param_widgets, theme
from ..editor import Editor
from ..front_view import UNITS
from ..idle_settings import idle
from ..param_widgets import slider, tooltip
from . import settings_panel

SOURCE = ("timing.source", "timing.blend")
BOXES = (
    ("crests", "Crests and ghosts", "Where crests stand now, and where they stood and will stand."),
    ("isochrones", "Arrival", "Lines of one time of arrival, labelled in seconds."),
    ("speed", "Speed", "Speed of fronts over the ground as colour."),
    ("breakers", "Breakers", "Where waves break, and how: spilling, plunging, surging."),
)
STEPS = {UNITS[0]: (0.1, 10.0), UNITS[1]: (1.0, 5.0), UNITS[2]: (1.0, 4.0)}


def draw(editor: Editor) -> None:
    rows = settings_panel.sections()["timing"]
    _source(editor, [row for row in rows if row.name in SOURCE])
    imgui.separator_text("On the water")
    _overlays(editor)
    reading = editor.fronts.reading(editor.session)
    imgui.separator_text("Under the pointer")
    hint = "Point at the waves to read them." if editor.fronts.shown else "Switch one on to read the waves."
    for line in reading.lines if reading else (hint, ""):  # always two, so that nothing below moves under the pointer
        imgui.text_unformatted(line)
    if imgui.collapsing_header("Hot spots###hot_spots", imgui.TreeNodeFlags_.default_open):
        _spots(editor)
    if imgui.collapsing_header("Limits###timing_limits"):
        _rows(editor, [row for row in rows if row.name not in SOURCE])


def _source(editor: Editor, rows: list) -> None:
    settings = editor.session.level.settings.timing
    _rows(editor, [row for row in rows if row.name != "timing.blend" or settings.source == "blend"])
    if editor.fronts.updating:
        imgui.text_colored(theme.colour(theme.WARM), f"{theme.icon('rotate')} updating…")
        tooltip("Travel times of the changed bed are on their way; till then those from before are shown.")


def _rows(editor: Editor, rows: list) -> None:
    session = editor.session
    settings, idle_now = session.level.settings, idle(session.level, session.clock.time_s)
    param_widgets.draw_all(rows, lambda path: get(settings, path), editor.set, session.seal, idle_now)


def _overlays(editor: Editor) -> None:
    fronts = editor.fronts
    if imgui.begin_table("###fronts", 2):
        for name, label, doc in BOXES:
            imgui.table_next_column()
            changed, _ = imgui.checkbox(f"{label}###front_{name}", fronts.on[name])
            tooltip(doc)
            if changed:
                fronts.toggle(name)
        imgui.end_table()
    if fronts.on["crests"]:
        _ghosts(editor)
    wide = imgui.get_content_region_avail().x * 0.5
    if fronts.on["isochrones"]:
        imgui.set_next_item_width(wide)
        _, fronts.every_s = slider("###every", fronts.every_s, 0.5, 20.0, f"every {fronts.every_s:.1f} s", log=True)
        tooltip("Seconds between two lines of arrival.")
    if fronts.on["speed"]:
        imgui.set_next_item_width(wide)
        fastest = fronts.fastest_mps
        _, fronts.fastest_mps = slider("###fastest", fastest, 1.0, 40.0, f"up to {fastest:.0f} m/s", log=True)
        tooltip("The speed of the brightest colour.")
        corner = imgui.get_cursor_screen_pos()
        width = imgui.get_content_region_avail().x
        front_overlay.ramp_bar(imgui.get_window_draw_list(), corner.x, corner.y, width, 10)
        imgui.dummy(imgui.ImVec2(width, 12))


def _ghosts(editor: Editor) -> None:
    """How many crests of other moments, and how far apart in time."""
    fronts = editor.fronts
    part = imgui.get_content_region_avail().x / 3 - 6
    imgui.set_next_item_width(part)
    told = f"{fronts.ghosts} each way" if fronts.ghosts else "no ghosts"
    _, fronts.ghosts = slider("###ghosts", fronts.ghosts, 0, MOST_GHOSTS, told, whole=True)
    tooltip("Ghosts: crests some steps before, blue, and after, orange; paler the farther off.")
    imgui.same_line()
    imgui.set_next_item_width(part)
    low, high = STEPS[fronts.unit]
    _, fronts.step = slider("###step", fronts.step, low, high, f"{fronts.step:.1f}")
    tooltip(f"Between two of them: {fronts.step_s(editor.session):.2f} s.")
    imgui.same_line()
    imgui.set_next_item_width(part)
    changed, number = imgui.combo("###unit", UNITS.index(fronts.unit), list(UNITS))
    if changed:
        fronts.unit = UNITS[number]
        fronts.step = min(max(fronts.step, STEPS[fronts.unit][0]), STEPS[fronts.unit][1])


def _spots(editor: Editor) -> None:
    found = editor.fronts.hot_spots(editor.session)
    if not found:
        imgui.text_colored(theme.colour(theme.INK_FAINT), "None: fronts run in evenly.")
    for number, spot in enumerate(found, 1):
        if imgui.selectable(f"{number}  {KINDS[spot.kind]}, {spot.size_m:.0f} m###spot_{number}", False)[0]:
            go_to(editor, spot)
        tooltip("Go there.")
        imgui.push_text_wrap_pos(0)
        imgui.text_unformatted(spot.sentence)
        imgui.text_colored(theme.colour(theme.INK_FAINT), spot.advice)
        imgui.pop_text_wrap_pos()
        imgui.spacing()


def go_to(editor: Editor, spot: HotSpot) -> None:
    """Fly to a hot spot, so that it is seen with what lies round it."""
    session = editor.session
    end = frame(session.level, session.camera, (spot.x, spot.y, session.level.sea_level_m))
    editor.fly_to(end)
    if not editor.fronts.shown:
        editor.fronts.on = {**editor.fronts.on, "crests": True}
