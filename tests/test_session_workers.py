"""Workers and the undo store: one request waits, older are dropped; nothing is lost when the disk refuses (T08)."""

import threading

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app.session import Session
from shorewright.app.spill import FileStore
from shorewright.app.workers import Worker


@pytest.fixture
def gate():
    event = threading.Event()
    yield event
    event.set()


def test_one_waits_and_older_ones_are_dropped(gate):
    """The first runs, of all that were asked meanwhile only the last does."""
    done = []

    def work(number):
        gate.wait(10)
        done.append(number)
        return number

    worker = Worker(work)
    worker.ask(1, 1)
    while not worker._running:
        pass
    for number in (2, 3, 4):
        worker.ask(number, number)
    assert worker.busy
    assert worker.take() is None
    gate.set()
    assert worker.settle(10)
    assert done == [1, 4]
    result = worker.take()
    assert (result.revision, result.value, result.error) == (4, 4, None)
    assert worker.take() is None
    worker.close()


def test_an_exception_is_a_result():
    worker = Worker(lambda: 1 / 0)
    worker.ask(7)
    assert worker.settle(10)
    result = worker.take()
    assert (result.revision, type(result.error)) == (7, ZeroDivisionError)
    worker.close()


def test_a_closed_worker_takes_nothing():
    worker = Worker(lambda: 1)
    worker.close()
    worker.ask(1)
    assert not worker.busy


def test_another_process_does_the_same():
    """What holds Python's lock goes into a process: arrays there and back, exceptions too."""
    worker = Worker(np.linalg.inv, process=True)
    matrix = np.array([[2.0, 0.0], [0.0, 4.0]])
    worker.ask(1, matrix)
    assert worker.settle(60)
    assert np.array_equal(worker.take().value, [[0.5, 0], [0, 0.25]])
    worker.ask(2, np.zeros((2, 2)))
    assert worker.settle(60)
    assert isinstance(worker.take().error, np.linalg.LinAlgError)
    worker.close()


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
