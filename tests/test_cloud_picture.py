"""The window's picture of clouds: a sixteenth while something moves, all of them once it stands still (Z16)."""

import pytest
from scenes import camera, coast
from shorewright.app import picture as pictures
from shorewright.app import status_bar
from shorewright.app.editor import Editor
from shorewright.app.preferences import Preferences
from shorewright.app.session import Session
from shorewright.renderer import TIERS

pytestmark = pytest.mark.gl
SIZE = (128, 72)
ALL, PART = 64 * 36, 16 * 9


class Windowed:
    """A context with a window's framebuffer."""

    def __init__(self, ctx) -> None:
        self.ctx, self.screen = ctx, ctx.simple_framebuffer((8, 8))

    def __getattr__(self, name: str):
        return getattr(self.ctx, name)


@pytest.fixture
def editor(tmp_path):
    level = coast(side=33)
    level.set("clouds.on", True)
    session = Session(level, spill_root=tmp_path)
    made = Editor(session, Preferences(), tmp_path / "preferences.json")
    made.quality = "medium"
    session.clock.paused = True
    yield made
    session.close()


def test_a_picture_that_stands_still_gets_all_of_its_clouds_and_then_rests(ctx, editor, monkeypatch):
    """Z16: live pictures march a sixteenth; then one whole march, and nothing is drawn any more."""
    clock = [100.0]
    monkeypatch.setattr(pictures.time, "monotonic", lambda: clock[0])
    monkeypatch.setattr(pictures, "LONGEST_SAMPLE_S", 0.0)  # no samples are gathered
    monkeypatch.setattr(pictures, "LONGEST_STILL_S", 1e9)
    picture = pictures.Picture(Windowed(ctx))
    monkeypatch.setattr(picture.governor, "note", lambda seconds: None)  # all at full size
    picture.show(editor, SIZE)
    picture.show(editor, SIZE)
    for step in range(3):
        editor.session.camera = camera(x=10.0 + step, pitch=20.0)
        picture.show(editor, SIZE)
        assert picture.renderer.stats["clouds_marched"] >= PART
        picture.renderer.generated.settle(TIERS["medium"]) if step == 0 else None
    assert picture.renderer.stats["clouds_marched"] < ALL / 4
    assert picture.waiting
    assert not picture._settled(editor, SIZE)
    told = status_bar._speed(editor, picture)
    assert f" of {ALL} rays" in told
    clock[0] += 1.0
    picture.show(editor, SIZE)
    assert picture.renderer.stats["clouds_marched"] == ALL
    draws = picture.draws
    clock[0] += 1.0
    for _ in range(5):
        picture.show(editor, SIZE)
    assert picture.draws == draws
    assert not picture.waiting
    picture.release()
