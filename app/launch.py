"""What `make run` starts: the editor where there is a display, the same work headless where there is none."""

from __future__ import annotations

import os
import sys
from pathlib import Path


def has_display() -> bool:
    """Whether a window can be opened here."""
    if sys.platform in ("win32", "darwin"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def main(level: str) -> int:
    """Open `level` in the window, or sculpt, render and export it into `out/`."""
    if has_display():
        from .cli import main as command_line

        return command_line(["edit", level])
    from .demo import run_demo

    sys.stdout.write("No display here: sculpting, rendering and exporting without a window into out/\n")
    return run_demo(Path("out"))


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1] if len(sys.argv) > 1 else "sample_levels/cove.shore"))
