"""A session's folder: save, save as, open, lock, dirty (T08)."""

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.invariants import broken
from shorewright.app.session import Session
from shorewright.io import read_level
from shorewright.level import BadInput, Grid
from shorewright.level.objects import Camera


@pytest.fixture
def folder(tmp_path):
    """A saved beach."""
    with Session(make_beach(), spill_root=tmp_path) as session:
        session.save(tmp_path / "beach.shore")
    return tmp_path / "beach.shore"


def test_saving_and_opening_is_identity(folder):
    """What was sculpted, set and placed comes back bit for bit."""
    with Session.open(folder) as session:
        session.drag("raise", (60, 60), (90, 70))
        session.set("sea.swell_m", 1.5)
        session.place(Camera(id="mine", x=1, y=2))
        session.save()
        kept = session.level
    with Session.open(folder) as session:
        assert np.array_equal(session.level.height, kept.height)
        assert session.level.settings == kept.settings
        assert session.level.objects == kept.objects
        assert broken(session) == []


def test_dirty_follows_undo(folder):
    """Undoing back to the saved state makes it clean; a saved state in mid-history counts too."""
    with Session.open(folder) as session:
        assert not session.dirty
        session.drag("raise", (60, 60))
        assert session.dirty
        session.undo()
        assert not session.dirty
        session.redo()
        session.save()
        assert not session.dirty
        session.undo()
        assert session.dirty
        session.redo()
        assert not session.dirty
        session.set("sea.swell_m", 1.0, merge=True)
        session.save()
        session.set("sea.swell_m", 1.1, merge=True)  # merged into the step that was saved
        assert session.dirty


def test_an_open_stroke_is_dirty_and_saved_as_a_step(folder):
    with Session.open(folder) as session:
        session.stroke_begin(60, 60)
        assert session.dirty
        session.save()
        assert [step.label for step in session.journal.done] == ["Raise"]
        assert np.array_equal(read_level(folder).height, session.level.height)


def test_a_level_open_elsewhere_is_refused(folder):
    """T08: two editors on one level would lose one's work; readers are welcome."""
    with Session.open(folder):
        with pytest.raises(BadInput, match="beach"):
            Session.open(folder)
        read_level(folder)
    Session.open(folder).close()


def test_save_as_moves_on_to_the_new_folder(folder, tmp_path):
    with Session.open(folder) as session:
        session.drag("raise", (60, 60))
        session.save(tmp_path / "other.shore")
        assert session.path == tmp_path / "other.shore"
        Session.open(folder).close()  # the old one is free again
        with pytest.raises(BadInput):
            Session.open(tmp_path / "other.shore")
    assert not np.array_equal(read_level(folder).height, read_level(tmp_path / "other.shore").height)


def test_save_as_never_overwrites_unasked(folder, tmp_path):
    with Session.new(Grid(20, 20), spill_root=tmp_path) as session:
        with pytest.raises(BadInput, match="exists"):
            session.save(folder)
        assert read_level(folder).grid != session.level.grid
        session.save(folder, overwrite=True)
        assert read_level(folder).grid == session.level.grid


def test_a_save_that_fails_keeps_the_session(folder, tmp_path):
    """The session stays where it was, dirty, and saves later."""
    with Session.open(folder) as session:
        session.drag("raise", (60, 60))
        with pytest.raises(BadInput):
            session.save(tmp_path / "nowhere" / "deep" / "other.shore")
        assert session.path == folder
        assert session.dirty
        session.save()
        assert not session.dirty


def test_save_after_resize_and_crop(folder):
    with Session.open(folder) as session:
        session.drag("raise", (60, 60))
        session.resize(samples=300)
        session.crop(10, 10, 100, 90)
        session.save()
        kept = session.level
    again = read_level(folder)
    assert again.grid == kept.grid
    assert np.array_equal(again.height, kept.height)


def test_an_import_goes_under_what_was_sculpted(folder, tmp_path):
    """Re-import keeps the artist's work (design, the level), and can be undone."""
    np.savez(tmp_path / "new.npz", height=np.flipud(make_beach(slope=0.09).height))
    with Session.open(folder) as session:
        session.drag("raise", (60, 60), size_m=10, strength=3)
        sculpt = session.level.layers["height"].sculpt.copy()
        before = session.level.height.copy()
        session.import_height(tmp_path / "new.npz", cell_m=1.0, rows="north-first")
        assert np.array_equal(session.level.layers["height"].sculpt, sculpt)
        assert np.allclose(session.level.height, make_beach(slope=0.09).height + sculpt, atol=1e-5)
        session.undo()
        assert np.array_equal(session.level.height, before)


def test_new_levels_have_cameras_and_open_dirty(tmp_path):
    """A new beach is something to play on: water, sand, the three cameras (D40)."""
    with Session.new(spill_root=tmp_path) as session:
        assert session.dirty
        assert {"play", "beach", "survey"} <= set(session.level.objects)
        assert session.level.height.min() < -5 < 2 < session.level.height.max()
        assert session.camera.id == "play"
