"""The undo store: steps past the budget come back from disk; nothing is lost when the disk refuses (T08)."""

import numpy as np
from coasts import make_beach
from shorewright.app.session import Session
from shorewright.app.spill import FileStore


def strokes(session, count=12):
    for n in range(count):
        session.drag("raise", (20 + 9 * n, 20), (20 + 9 * n, 110), size_m=6)


def test_steps_past_the_budget_come_back_from_disk(tmp_path):
    """T08: a small budget, many strokes, and every one of them can be undone and redone."""
    with Session(make_beach(), undo_bytes=4_000, spill_root=tmp_path) as session:
        first = session.level.height.copy()
        strokes(session)
        last = session.level.height.copy()
        assert any(step.spilled for step in session.journal.done)
        assert list(tmp_path.glob("undo-*/step*"))
        while session.undo():
            pass
        assert np.array_equal(session.level.height, first)
        while session.redo():
            pass
        assert np.array_equal(session.level.height, last)
    assert not list(tmp_path.glob("undo-*"))


def test_a_disk_that_refuses_costs_memory_not_undo(tmp_path, caplog):
    (tmp_path / "file").write_text("no folder")
    with Session(make_beach(), undo_bytes=4_000, spill_root=tmp_path / "file") as session:
        first = session.level.height.copy()
        strokes(session)
        while session.undo():
            pass
        assert np.array_equal(session.level.height, first)
    assert "memory" in caplog.text


def test_folders_of_dead_editors_are_swept(tmp_path):
    dead = tmp_path / "undo-dead"
    dead.mkdir()
    (dead / "step1").write_bytes(b"x")
    living = FileStore(tmp_path)
    living.put("a", b"1")
    other = FileStore(tmp_path)
    other.put("b", b"2")
    assert not dead.exists()
    assert living.get("a") == b"1"
    living.drop("a")
    living.close()
    other.close()
