"""The editor's window: hello_imgui's docking runner round the panels, the viewport and the session.

    run(Session.open("cove.shore"))

One thread for OpenGL and imgui. Panels and callbacks are guarded: a failure costs a frame, not the level.
"""

from __future__ import annotations

import contextlib
import ctypes
import logging
from collections.abc import Callable
from pathlib import Path

import imgui_bundle
from imgui_bundle import hello_imgui, imgui, implot
from pydantic import ValidationError

from ..level import BadInput
from . import keys, layout, menus, status_bar, theme
from .dialogs import Dialogs
from .editor import Editor
from .guard import Guard
from .palette import Palette
from .panels import (
    brush_bar,
    history_panel,
    layers_panel,
    log_panel,
    objects_panel,
    settings_panel,
    timing_panel,
    views_panel,
)
from .panels.probe_panel import ProbePanel
from .panels.waves_panel import WavesPanel
from .panels.weather_panel import WeatherPanel
from .picture import Picture
from .preferences import Preferences, load
from .session import Session
from .timeline import Timeline
from .viewport import Viewport

log = logging.getLogger(__name__)
SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software")
GLFW = ("libglfw.so.3", "libglfw*.dylib", "glfw*.dll")  # beside imgui-bundle's own module, and loaded by it
STILL_FPS = 12.0  # how often a still window looks at its widgets
Drive = Callable[[object, "Window"], None]


class Window:
    """Everything of one window; `run` shows it until it is closed."""

    def __init__(self, session: Session, preferences: Preferences | None = None, drive: Drive | None = None) -> None:
        self.editor = Editor(session, preferences or load())
        self.guard = Guard()
        self.dialogs = Dialogs(self.editor)
        self.palette = Palette(self.editor)
        self.timeline = Timeline(self.editor)
        self.waves = WavesPanel()
        self.probes = ProbePanel()
        self.weather = WeatherPanel(self.editor)
        self.picture: Picture | None = None
        self.viewport: Viewport | None = None
        self.drive = drive
        self.drive_error: BaseException | None = None
        self.shown_title = ""
        self.params = self._params()

    def run(self) -> None:
        """Show the window until it is closed; the last session stays open. BadInput where there is no OpenGL 4.1."""
        self.editor.messages.attach()
        plots = implot.create_context()
        try:
            hello_imgui.run(self.params)
        except BaseException as error:
            self._keep_work()
            if self.picture is None and isinstance(error, RuntimeError):  # it never came up
                raise BadInput(
                    "no window with OpenGL 4.1 can be opened here; `render` and `stroke` need none"
                ) from error
            raise
        finally:
            implot.destroy_context(plots)
            self.editor.messages.detach()
        if self.drive_error:
            raise self.drive_error

    def _keep_work(self) -> None:
        """The window itself broke: leave the recovery log for the next start."""
        session = self.editor.session
        if session.recovery and session.dirty:
            session.recovery.close(discard=False)
            session.recovery = None

    # Parameters of the runner

    def _params(self) -> hello_imgui.RunnerParams:
        params = hello_imgui.RunnerParams()
        preferences = self.editor.preferences
        window = params.app_window_params
        window.window_title = f"{self.editor.session.title} – Shorewright"
        window.window_geometry.size = (preferences.window_width, preferences.window_height)
        inside = params.imgui_window_params
        inside.default_imgui_window_type = hello_imgui.DefaultImGuiWindowType.provide_full_screen_dock_space
        inside.show_menu_bar = inside.show_status_bar = True
        inside.show_menu_app = inside.show_menu_view = False
        inside.show_status_fps = inside.remember_status_bar_settings = False
        params.ini_folder_type = hello_imgui.IniFolderType.app_user_config_folder
        params.ini_filename = f"shorewright/window-{layout.VERSION}.ini"
        params.ini_disable = self.drive is not None
        params.renderer_backend_options.open_gl_options = _opengl_41()
        params.fps_idling.fps_idle = STILL_FPS
        params.docking_params = layout.docking(
            self._panels(), (preferences.window_width, preferences.window_height), preferences.ui_scale
        )
        self._callbacks(params.callbacks)
        if self.drive:
            params.use_imgui_test_engine = True
            params.callbacks.register_tests = self._register
        return params

    def _panels(self) -> dict[str, Callable[[], None]]:
        """What each dockable window of layout.PANELS draws."""
        editor = self.editor
        draws = {
            "Viewport": lambda: self.viewport.draw() if self.viewport else None,
            "Timeline": self.timeline.draw,
            "Brushes": lambda: brush_bar.draw(editor),
            "Brush": lambda: brush_bar.draw_parameters(editor),
            "Settings": lambda: settings_panel.draw(editor),
            "Weather map": lambda: self.weather.draw(self.picture.ctx) if self.picture else None,
            "Objects": lambda: objects_panel.draw(editor),
            "Layers": lambda: layers_panel.draw(editor, self.picture.gpu_bytes() if self.picture else {}),
            "History": lambda: history_panel.draw(editor),
            "Views": lambda: views_panel.draw(editor),
            "Waves": lambda: self.waves.draw(editor),
            "Probes": lambda: self.probes.draw(editor),
            "Timing": lambda: timing_panel.draw(editor),
            "Log": lambda: log_panel.draw(editor),
        }
        return {name: self.guard.wrap(name, draw) for name, draw in draws.items()}

    def _callbacks(self, callbacks: hello_imgui.RunnerCallbacks) -> None:
        callbacks.load_additional_fonts = theme.load_fonts
        callbacks.setup_imgui_config = _configure
        callbacks.setup_imgui_style = lambda: theme.apply_style(self.editor.preferences.ui_scale)
        callbacks.post_init = self._started
        callbacks.before_exit = self._ending
        callbacks.confirm_exit = self._may_close
        callbacks.pre_new_frame = self.guard.wrap("Frame", self._before_frame, draws=False)
        callbacks.show_menus = self.guard.wrap("Menus", lambda: menus.draw(self.editor))
        callbacks.show_status = self.guard.wrap("Status bar", lambda: status_bar.draw(self.editor, self.picture))
        callbacks.show_gui = self.guard.wrap("Keys", self._keys)
        callbacks.post_render_dockable_windows = self.guard.wrap("Dialogs", self._on_top)

    # Life

    def _started(self) -> None:
        import moderngl

        ctx = moderngl.create_context(require=410)
        software = any(word in ctx.info["GL_RENDERER"].lower() for word in SOFTWARE)
        self.picture = Picture(ctx, self.editor.preferences.frame_rate, software)
        self.viewport = Viewport(self.editor, self.picture)
        if software:
            self.editor.quality = "low"
        log.info("%s, OpenGL %s", ctx.info["GL_RENDERER"], ctx.info["GL_VERSION"])
        if self.drive is None:
            self.guard.wrap("Recovery", self.dialogs.offer_recovery, draws=False)()

    def _ending(self) -> None:
        if self.picture:
            self.weather.release()
            self.picture.release()
        size = hello_imgui.get_runner_params().app_window_params.window_geometry.size
        if self.drive is None:
            preferences = self.editor.preferences
            with contextlib.suppress(ValidationError):  # a size that no window should be opened with
                preferences.window_width, preferences.window_height = size
            preferences.save(self.editor.save_to)

    def _may_close(self) -> bool:
        """The window's close button: leave at once when nothing would be lost, else ask."""
        self.editor.session.ask("quit")
        return False

    # Every frame

    def _before_frame(self) -> None:
        editor = self.editor
        editor.tick()
        params = hello_imgui.get_runner_params()
        if editor.shall_exit:
            params.app_shall_exit = True
        busy = (
            editor.live
            or editor.arrivals.busy
            or editor.shapings.busy
            or editor.currents.busy
            or (self.picture is not None and self.picture.waiting)
        )
        params.fps_idling.enable_idling = not busy and self.drive is None
        self._title()

    def _on_top(self) -> None:
        if "palette" in self.editor.asked:
            self.editor.asked.remove("palette")
            self.palette.show()
        self.palette.draw()
        self.dialogs.draw()

    def _title(self) -> None:
        title = f"{self.editor.session.title} – Shorewright"
        if title != self.shown_title:
            self.shown_title = title
            _set_title(title)

    def _keys(self) -> None:
        if self.dialogs.open or imgui.get_io().want_text_input or self.editor.flying:
            return
        for action in keys.pressed():
            self.editor.do(action)

    # Being driven by a test

    def _register(self) -> None:
        engine = hello_imgui.get_imgui_test_engine()
        test = imgui.test_engine.register_test(engine, "editor", "driven")
        test.test_func = self._driven
        io = imgui.test_engine.get_io(engine)
        io.config_run_speed = imgui.test_engine.TestRunSpeed.fast
        # after a minute the engine would do nothing more, which on a busy computer is too soon
        io.config_watchdog_warning = io.config_watchdog_kill_test = io.config_watchdog_kill_app = 900.0
        imgui.test_engine.queue_test(engine, test)

    def _driven(self, ctx) -> None:
        try:
            self.drive(ctx, self)
        except BaseException as error:  # on the engine's thread: carried over to whoever called run
            self.drive_error = error
        finally:
            self.params.app_shall_exit = True


def run(session: Session, preferences: Preferences | None = None, drive: Drive | None = None) -> int:
    """Show the editor until it is closed; `drive(ctx, window)` works it by imgui's test engine instead of a person."""
    window = Window(session, preferences, drive)
    try:
        window.run()
    finally:
        if window.editor.session is not session:
            window.editor.session.close()
    return 0


def _opengl_41() -> hello_imgui.OpenGlOptions:
    options = hello_imgui.OpenGlOptions()
    options.major_version, options.minor_version, options.glsl_version = 4, 1, "410"
    options.use_core_profile = options.use_forward_compat = True
    options.anti_aliasing_samples = 0  # the picture comes as a texture; widgets are smooth by themselves
    return options


def _configure() -> None:
    io = imgui.get_io()
    io.config_flags = int(io.config_flags) | int(imgui.ConfigFlags_.docking_enable)
    io.config_windows_move_from_title_bar_only = True
    io.config_drag_click_to_input_text = False


def _set_title(title: str) -> None:
    """Tell the window system through the GLFW that imgui-bundle brings; where that fails the old title stays."""
    try:
        folder = Path(imgui_bundle.__file__).parent
        library = next(path for name in GLFW for path in folder.glob(name))
        set_title = ctypes.CDLL(str(library)).glfwSetWindowTitle
        set_title.argtypes = (ctypes.c_void_p, ctypes.c_char_p)
        set_title(hello_imgui.get_glfw_window_address(), title.encode())
    except (OSError, AttributeError, StopIteration) as error:
        log.debug("the window's title stays: %s", error)
