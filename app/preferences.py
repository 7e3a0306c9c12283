"""What the editor remembers between runs: recent levels, window, viewport. One JSON file in the user's config folder.

A damaged or newer file costs the preferences, never the start.
"""

from __future__ import annotations

import contextlib
import json
import logging
import os
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

log = logging.getLogger(__name__)
MOST_RECENT = 12


class Preferences(BaseModel):
    """Preferences, checked on the way in; unknown names, as of a newer version, are left alone."""

    model_config = ConfigDict(extra="ignore", validate_assignment=True, allow_inf_nan=False)

    recent: list[str] = Field(default=[], max_length=1000, description="Levels opened last, newest first.")
    window_width: int = Field(1600, ge=320, le=16384, description="Window width, pixels.")
    window_height: int = Field(900, ge=240, le=16384, description="Window height, pixels.")
    ui_scale: float = Field(1.0, ge=0.5, le=4, description="Size of text and widgets.")
    quality: str = Field("medium", pattern="^(low|medium|high)$", description="Quality tier of the viewport.")
    frame_rate: float = Field(30.0, ge=5, le=240, description="Frames a second that the governor holds.")
    fly_speed_mps: float = Field(15.0, ge=0.1, le=1000, description="Speed of flying with the right button held.")

    def remember(self, level: Path | str) -> None:
        """Put a level in front of the recent ones."""
        name = str(Path(level).resolve())
        self.recent = [name, *(other for other in self.recent if other != name)][:MOST_RECENT]

    def recent_levels(self) -> list[Path]:
        """Those of the recent levels that still exist."""
        return [path for path in map(Path, self.recent) if (path / "level.json").is_file()]

    def save(self, path: Path | None = None) -> bool:
        """Write them; False when the disk refuses, which is not worth a word."""
        path = path or default_path()
        part = path.with_suffix(f".{os.getpid()}.part")
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            part.write_text(self.model_dump_json(indent=1) + "\n", "utf-8")
            os.replace(part, path)
        except OSError as error:
            log.warning("preferences were not saved: %s", error)
            with contextlib.suppress(OSError):
                part.unlink()
            return False
        return True


def load(path: Path | None = None) -> Preferences:
    """The saved preferences; defaults for whatever is missing or cannot be read."""
    path = path or default_path()
    try:
        raw = json.loads(path.read_text("utf-8"))
    except FileNotFoundError:
        return Preferences()
    except (OSError, ValueError, RecursionError) as error:
        log.warning("%s cannot be read, so the defaults hold: %s", path, error)
        return Preferences()
    kept = {}
    for name, value in raw.items() if isinstance(raw, dict) else ():
        with contextlib.suppress(ValidationError):
            Preferences.model_validate({name: value})
            kept[name] = value
    return Preferences(**kept)


def default_path() -> Path:
    import platformdirs

    return platformdirs.user_config_path("shorewright", appauthor=False) / "preferences.json"
