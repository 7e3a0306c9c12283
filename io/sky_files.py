"""Skies of shots in a level's folder (Z20): `skies/NAME.exr`, half floats: coverage, precipitation, type.

North is on top. Opening a level takes what is missing or damaged for no shot, and tells; the level opens all the same.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ..level import BadInput, Level
from ..level.meshes import NAME
from ..level.shots import SHAPE, digest, skies_in_use, sky_of
from .images import encode, read_header, read_image

FOLDER = "skies"


def sky_file_of(name: str) -> str:
    """The file of a sky, from the level's folder."""
    return f"{FOLDER}/{name}.exr"


def wanted_skies(level: Level) -> list[str]:
    """Names of skies that belong in the level's folder."""
    return sorted(name for name in skies_in_use(level) if NAME.fullmatch(name))


def read_sky(path: Path) -> np.ndarray:
    """The sky in a file, as `level.skies` holds it; BadInput, a sentence, when there is none."""
    header = read_header(path)  # before memory is taken
    if (header.rows, header.cols, len(header.channels)) != SHAPE:
        raise BadInput(f"{path} is no sky of a shot, which has {' × '.join(map(str, SHAPE))} samples")
    try:
        return sky_of(read_image(path)[::-1])
    except BadInput as error:
        raise BadInput(f"{path} cannot be used: {error}") from None


def write_checked_sky(sky: np.ndarray, path: Path) -> None:
    """Write a sky and read it back; OSError when the disk does not give it back."""
    encode(path, np.ascontiguousarray(sky[::-1]), half=True)
    try:
        again = read_sky(path)
    except BadInput as error:
        raise OSError(0, f"what was written cannot be read back: {error}") from None
    if not np.array_equal(again, sky):
        raise OSError(0, f"{path.name} came back other than it was written")


def read_skies(level: Level, paths: dict[str, Path], notes: list[str]) -> None:
    """Give a level the skies in some files; of what cannot be read, a shot shows nothing."""
    for name, path in sorted(paths.items()):
        if not path.exists():
            notes.append(f"{path} is missing, so its shot shows the simulation: give it another sky")
            continue
        try:
            sky = read_sky(path)
        except (OSError, BadInput) as error:
            told = getattr(error, "strerror", None) or error
            notes.append(f"{told}, so its shot shows the simulation")
            continue
        if not name.endswith(digest(sky)[:8]):
            notes.append(f"{path} was changed since it was saved; used as it is")
        level.skies[name] = sky
