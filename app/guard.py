"""An exception inside one panel costs that panel one frame, never the level: it is caught, logged, and told once."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

from imgui_bundle import imgui

log = logging.getLogger(__name__)
REPEAT_S = 5.0  # the same failure is told again only after this long


class Guard:
    """Wraps what the window calls every frame; `failures` says what went wrong where, for the panel that failed."""

    def __init__(self) -> None:
        self.failures: dict[str, str] = {}
        self._told: dict[str, tuple[str, float]] = {}

    def wrap(self, name: str, draw: Callable[[], None], draws: bool = True) -> Callable[[], None]:
        """A callback that cannot raise; what it opened in imgui is closed for it. `draws` is False outside a frame."""

        def guarded() -> None:
            state = imgui.internal.ErrorRecoveryState()
            if draws:
                imgui.internal.error_recovery_store_state(state)
            try:
                draw()
                self.failures.pop(name, None)
            except Exception as error:
                if draws:
                    _close_what_is_open(state)
                self._tell(name, error)

        return guarded

    def _tell(self, name: str, error: Exception) -> None:
        text = f"{type(error).__name__}: {error}".partition("\n")[0]
        self.failures[name] = text
        before, at = self._told.get(name, ("", 0.0))
        if before != text or time.monotonic() - at > REPEAT_S:
            log.error("%s failed, the level is safe: %s", name, text, exc_info=error)
            self._told[name] = text, time.monotonic()


def _close_what_is_open(state) -> None:
    """End the windows, ids and styles that the failed code left open; imgui's own asserts are off meanwhile."""
    io = imgui.get_io()
    asserts, tips, logs = (
        io.config_error_recovery_enable_assert,
        io.config_error_recovery_enable_tooltip,
        io.config_error_recovery_enable_debug_log,
    )
    io.config_error_recovery_enable_assert = io.config_error_recovery_enable_tooltip = False
    io.config_error_recovery_enable_debug_log = True  # imgui wants at least one way to tell
    try:
        imgui.internal.error_recovery_try_to_recover_state(state)
    finally:
        io.config_error_recovery_enable_assert = asserts
        io.config_error_recovery_enable_tooltip = tips
        io.config_error_recovery_enable_debug_log = logs
