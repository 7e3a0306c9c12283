"""Golden pictures on the pinned software driver: what a frame looked like when somebody last looked at it.

`SHOREWRIGHT_GOLDENS=write pytest tests/test_goldens.py` writes them anew; look at each before committing it. Elsewhere
than on that driver the comparison is skipped. Rows seen in them: D01 D03 D04 D10 D11 D31 D38 T11 L01 to L09 H11.
`VIEW@ENVIRONMENT` is a view under an environment.
"""

import os
from pathlib import Path

import numpy as np
import pytest
import shorewright
from shorewright.io.images import read_image, write_image
from shorewright.level.environments import environment_settings

ROOT = Path(__file__).parents[1]
GOLDENS = Path(__file__).parent / "goldens"
DRIVER = ("llvmpipe", "Mesa 22.3.6")
SIZE = (240, 135)
TIME_S = 14.0
TOLERANCE = 3  # of 255, a channel
STRAYS = 0.01  # part of the samples that may leave it: processors round differently where a wave just covers a rock

SHOTS = [
    ("cove", "play", "final"),
    ("cove", "beach", "final"),
    ("cove", "survey", "final"),
    ("cove", "play", "albedo"),
    ("cove", "play", "normal"),
    ("cove", "play", "wave_line"),
    ("cove", "play", "wave_back"),
    ("cove", "play", "crest_fall"),
    ("cove", "survey", "gerstner_height"),
    ("cove", "survey", "walkable"),
    ("island", "survey", "final"),
    ("island", "beach", "final"),
    ("cove", "beach", "lookdev"),
    ("cove", "play", "ground"),
    ("cove", "play", "shore_distance"),
    ("cove", "beach", "final@golden_hour"),
    ("cove", "survey", "final@moonlit"),
    ("island", "beach", "final@storm"),
    ("island", "play", "final@fog"),
]


@pytest.fixture(scope="module")
def driver(ctx):
    info = f"{ctx.info['GL_RENDERER']} {ctx.info['GL_VERSION']}"
    if not all(part in info for part in DRIVER):
        pytest.skip(f"goldens hold on {' '.join(DRIVER)}, this is {info}")


@pytest.mark.gl
@pytest.mark.parametrize(("name", "camera", "view"), SHOTS, ids=["-".join(shot) for shot in SHOTS])
def test_picture_is_the_one_last_looked_at(driver, tmp_path, name, camera, view):
    from shorewright.renderer.offscreen import render

    level = shorewright.open(ROOT / "sample_levels" / f"{name}.shore")
    path = GOLDENS / f"{name}-{camera}-{view.replace('@', '-')}.png"
    view, _, environment = view.partition("@")
    if environment:
        level.set_settings(environment_settings(level.settings, environment))
    seen = render(level, camera, SIZE, TIME_S, view, quality="medium")
    assert seen.std() > 2, "a blank picture"
    if os.environ.get("SHOREWRIGHT_GOLDENS") == "write":
        GOLDENS.mkdir(exist_ok=True)
        write_image(path, seen)
        return
    off = np.abs(seen.astype(int) - read_image(path).astype(int))
    if (off > TOLERANCE).mean() > STRAYS:
        write_image(tmp_path / "seen.png", seen)
        write_image(tmp_path / "difference.png", np.clip(off * 8, 0, 255).astype(np.uint8))
        pytest.fail(f"{(off > TOLERANCE).mean():.1%} of the samples are off by over {TOLERANCE}; see {tmp_path}")
