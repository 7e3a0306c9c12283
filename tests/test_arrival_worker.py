"""The process that solves travel times (T06, T14): same bits, latest request wins, nothing left behind."""

import multiprocessing
import os
import subprocess
import sys
import time
from dataclasses import fields
from multiprocessing.shared_memory import SharedMemory
from pathlib import Path

import numpy as np
import pytest
import swell_beds
from shorewright.app.arrival_worker import ArrivalWorker, solve_now
from shorewright.level.errors import BadInput
from shorewright.level.swell_request import Swell, SwellRequest

SWELLS = Swell(9.0, 20.0, 1.0), Swell(6.0, -10.0)


@pytest.fixture(scope="module")
def worker():
    with ArrivalWorker() as made:
        yield made


def _request(side: int = 101, **more) -> SwellRequest:
    depth, cell_m = swell_beds.rough_coast(side, 9.0)
    return SwellRequest(depth.astype(np.float32), cell_m, SWELLS, **more)


def _answer(worker, patience_s: float = 60.0):
    end = time.monotonic() + patience_s
    while time.monotonic() < end:
        found = worker.poll()
        if found is not None:
            return found
        time.sleep(0.005)
    raise AssertionError("no answer")


def _same(a, b) -> bool:
    """Whether two results are the same to the bit, in all maps and numbers."""
    if a is None or b is None:
        return a is b
    pairs = [(getattr(a, f.name), getattr(b, f.name)) for f in fields(a)]
    return all(
        (x.dtype == y.dtype and x.tobytes() == y.tobytes()) if isinstance(x, np.ndarray) else x == y for x, y in pairs
    )


def test_same_bits_as_at_once(worker):
    """T06: window and command line see the same sea: every map the same bytes."""
    request = _request(heights_side=60, speed=np.linspace(0.8, 1.2, 101 * 101, dtype=np.float32).reshape(101, 101))
    worker.ask("a", request)
    assert worker.busy
    key, found = _answer(worker)
    assert key == "a"
    assert not worker.busy
    wanted = solve_now(request)
    assert len(found) == 2
    for mine, theirs in zip(wanted, found, strict=True):
        assert _same(mine.time, theirs.time)
        assert _same(mine.heights, theirs.heights)
        assert mine.step == theirs.step == 2
    assert found[0].heights.height_m.shape == (51, 51)
    assert found[1].heights is None


def test_latest_request_wins(worker):
    """T14: of many asked during one solve only the first and the last are solved; larger ones grow the memory."""
    for key in range(6):
        worker.ask(key, _request(101 + 20 * key))
    keys = [_answer(worker), _answer(worker)]
    assert [key for key, _ in keys] == [0, 5]
    assert keys[1][1][0].time.seconds.shape == (201, 201)
    assert worker.poll() is None
    assert not worker.busy


def test_a_waiting_request_keeps_its_bed(worker):
    """T14: what is edited after asking is not in the answer."""
    request = _request()
    before = solve_now(request)[0].time.seconds
    worker.ask("busy", _request(201))
    worker.ask("waits", request)
    request.depth_m[:] = 3.0
    _answer(worker)
    key, found = _answer(worker)
    assert key == "waits"
    assert found[0].time.seconds.tobytes() == before.tobytes()


def test_forgotten_answers_never_come(worker):
    """T14: with another level open, the old level's answer is dropped, the new one's comes."""
    worker.ask("old", _request(151))
    worker.ask("old too", _request(151))
    worker.forget()
    worker.ask("new", _request())
    assert _answer(worker)[0] == "new"
    assert worker.poll() is None


def test_errors_are_sentences(worker):
    """T06: what can't be solved comes back as a sentence, and the next request is solved."""
    worker.ask("bad", _request(speed=np.ones((3, 7), np.float32)))
    key, found = _answer(worker)
    assert key == "bad"
    assert isinstance(found, BadInput)
    assert str(found).endswith(".")
    worker.ask("good", _request())
    assert not isinstance(_answer(worker)[1], BadInput)


def test_a_killed_process_is_told_and_replaced():
    """T06: if the system kills it, the request's answer says so, and the next one starts a new process."""
    with ArrivalWorker() as worker:
        worker.ask("first", _request())
        _answer(worker)
        worker.ask("killed", _request(501))
        worker._held.process.kill()
        key, found = _answer(worker)
        assert (key, type(found)) == ("killed", BadInput)
        worker.ask("again", _request())
        assert not isinstance(_answer(worker)[1], BadInput)


def test_close_leaves_nothing():
    """T06: no process and no shared memory after `close`, even in the middle of a solve; closing twice is fine."""
    worker = ArrivalWorker()
    worker.ask(0, _request())
    pid = worker._held.process.pid
    _answer(worker)
    worker.ask(1, _request(801))
    blocks = worker._held.into.name, worker._held.out.name
    worker.close()
    worker.close()
    assert not worker.busy
    for name in blocks:
        with pytest.raises(FileNotFoundError):
            SharedMemory(name)
    assert pid not in {child.pid for child in multiprocessing.active_children()}
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


USES = """
import sys, time
sys.path.insert(0, {tests!r})
from test_arrival_worker import _request, _answer
from shorewright.app.arrival_worker import ArrivalWorker
worker = ArrivalWorker()  # with no guard against a second import: the new process runs none of this
worker.ask(0, _request())
_answer(worker)
worker.ask(1, _request(401))
print(worker._held.process.pid, flush=True)
{end}
"""


@pytest.mark.parametrize("end", ["pass", "import os; os._exit(0)"])
def test_it_ends_with_its_parent(tmp_path, end):
    """T06: a program that ends without `close`, or is cut off, leaves no process; one that ends leaves no warning."""
    script = tmp_path / "uses.py"
    script.write_text(USES.format(tests=str(Path(__file__).parent), end=end))
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, timeout=60, check=True)
    if end == "pass":
        assert done.stderr == ""
    pid = int(done.stdout)
    until = time.monotonic() + 20
    while time.monotonic() < until and _alive(pid):
        time.sleep(0.02)
    assert not _alive(pid)


def _alive(pid: int) -> bool:
    """Whether a process still runs; one that ended and that nobody waited for (as init here may not) doesn't."""
    try:
        os.kill(pid, 0)
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except (ProcessLookupError, FileNotFoundError):
        return False
