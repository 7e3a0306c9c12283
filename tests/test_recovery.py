"""The recovery log: a killed editor offers what it had, up to the last finished step (T08)."""

import hashlib
import io
import subprocess
import sys
import textwrap
from pathlib import Path

import numpy as np
import pytest
from coasts import make_beach
from shorewright.app import recovery, recovery_record
from shorewright.app.invariants import broken
from shorewright.app.recovery import RecoveryLog
from shorewright.app.recovery_offer import changes_of, offers
from shorewright.app.session import Session
from shorewright.io import read_level
from shorewright.level import Rect
from shorewright.level.objects import Camera
from shorewright.level.water_optics import absorption


def print_of(session):
    """A hash of all that a level is."""
    level = session.level
    parts = [level.height.tobytes(), level.settings.model_dump_json().encode(), repr(level.grid).encode()]
    parts += [data.array.tobytes() for name, data in level.layers.items() if not data.neutral]
    parts += [repr(sorted(level.objects.items())).encode(), repr(sorted(level.georeference.items())).encode()]
    return hashlib.sha256(b"".join(parts)).hexdigest()


def die(session):
    """End as a killed editor does: nothing closed, nothing saved; only locks go, as the system takes them."""
    session.recovery.settle()
    session.recovery.close(discard=False)
    if session.folder:
        session.folder.close()


@pytest.fixture
def root(tmp_path):
    return tmp_path / "state"


@pytest.fixture
def folder(tmp_path):
    with Session(make_beach(), spill_root=tmp_path) as session:
        session.place(Camera(id="play", x=10, y=10))
        session.save(tmp_path / "beach.shore")
    return tmp_path / "beach.shore"


def opened(folder, root):
    session = Session.open(folder, spill_root=folder.parent)
    session.keep_log(root)
    return session


STEPS = {
    "stroke": lambda s: s.drag("raise", (60, 60), (90, 70), size_m=9),
    "undo": lambda s: (s.drag("raise", (60, 60)), s.drag("lower", (90, 60)), s.undo()),
    "redo": lambda s: (s.drag("raise", (60, 60)), s.undo(), s.redo()),
    "all undone": lambda s: (s.drag("raise", (60, 60)), s.undo()),
    "setting": lambda s: s.set("sea.swell_m", 1.75),
    "slider": lambda s: [s.set("sea.swell_m", 1 + n / 100, merge=True) for n in range(40)],
    "objects": lambda s: (s.place(Camera(id="mine", x=3)), s.remove("play")),
    "resize": lambda s: (s.drag("raise", (60, 60)), s.resize(samples=200), s.drag("lower", (70, 60))),
    "crop": lambda s: (s.drag("raise", (60, 60)), s.crop(10, 10, 120, 100), s.drag("smooth", (40, 40))),
    "crop undone": lambda s: (s.drag("raise", (60, 60)), s.crop(10, 10, 120, 100), s.undo()),
}


@pytest.mark.parametrize("name", STEPS)
def test_the_state_after_the_last_finished_step_comes_back(folder, root, name):
    """T08: whatever was finished, undone or redone, and not a sample of the stroke that was under way."""
    session = opened(folder, root)
    STEPS[name](session)
    wanted = print_of(session)
    session.stroke_begin(30, 30)
    session.stroke_move(60, 40)
    die(session)
    (offer,) = offers(root)
    assert offer.folder == folder
    assert not offer.changed_since
    with Session.recover(offer, spill_root=root) as again:
        assert print_of(again) == wanted
        assert broken(again) == []
        assert again.dirty
        again.undo()
        assert np.array_equal(again.level.height, read_level(folder).height)


def test_recovered_work_is_in_the_log_again(folder, root):
    """Killed twice: nothing lost, and the log goes on behind what was recovered."""
    session = opened(folder, root)
    session.drag("raise", (60, 60))
    die(session)
    session = Session.recover(offers(root)[0], spill_root=root)
    session.drag("lower", (90, 80))
    wanted = print_of(session)
    die(session)
    (offer,) = offers(root)
    with Session.recover(offer, spill_root=root) as again:
        assert print_of(again) == wanted
        again.save()
        assert offers(root) == []
    assert offers(root) == []
    assert np.array_equal(read_level(folder).height, again.level.height)


def test_saved_work_is_not_offered(folder, root):
    """A save starts the log anew; a proper close removes it."""
    session = opened(folder, root)
    session.drag("raise", (60, 60))
    session.save()
    die(session)
    assert offers(root) == []
    session = opened(folder, root)
    session.drag("raise", (60, 60))
    session.close()
    assert offers(root) == []
    assert not list(root.glob("*"))


def test_steps_after_a_save_are_offered_alone(folder, root):
    session = opened(folder, root)
    session.drag("raise", (60, 60))
    session.save()
    session.drag("lower", (90, 60))
    wanted = print_of(session)
    die(session)
    (offer,) = offers(root)
    assert offer.labels == ["Lower"]
    with Session.recover(offer, spill_root=root) as again:
        assert print_of(again) == wanted


def test_killed_between_a_save_and_the_new_log(folder, root):
    """The folder has everything: nothing to offer. Killed before the save was committed: all of it."""
    session = opened(folder, root)
    session.drag("raise", (60, 60))
    session.recovery.saving()
    die(session)
    assert len(offers(root)) == 1
    session = Session.recover(offers(root)[0], spill_root=root)
    session.recovery.saving()
    session.folder.save(session.level)
    die(session)
    assert offers(root) == []


def test_a_level_that_was_never_saved(root):
    """T08: a new level has no folder to start from, so the log holds all of it."""
    session = Session(make_beach(), spill_root=root)
    session.keep_log(root)
    die(session)
    assert offers(root) == []  # nothing was done
    session = Session(make_beach(), spill_root=root)
    session.place(Camera(id="mine", x=3))
    session.keep_log(root)
    session.drag("raise", (60, 60))
    session.set("sea.swell_m", 1.5)
    wanted = print_of(session)
    die(session)
    (offer,) = offers(root)
    assert offer.folder is None
    assert "never saved" in offer.sentence
    with Session.recover(offer, spill_root=root) as again:
        assert print_of(again) == wanted
        assert again.path is None


def test_a_folder_changed_by_something_else_is_told(folder, root):
    session = opened(folder, root)
    session.drag("raise", (60, 60))
    die(session)
    with Session.open(folder, spill_root=root) as other:
        other.set("sea.swell_m", 2)
        other.save()
    (offer,) = offers(root)
    assert offer.changed_since
    assert "changed since" in offer.sentence
    offer.discard()
    assert offers(root) == []


def test_a_living_editor_is_not_offered(folder, root):
    with opened(folder, root) as session:
        session.drag("raise", (60, 60))
        session.recovery.settle()
        assert offers(root) == []


@pytest.mark.parametrize("keep", [0.2, 0.5, 0.9, 0.999])
def test_a_log_cut_short_gives_whole_records(folder, root, keep):
    """A power cut may leave half a record: it is dropped, those before it count."""
    session = opened(folder, root)
    states = [print_of(session)]
    for n in range(4):
        session.drag("raise", (30 + 25 * n, 60), size_m=8)
        states.append(print_of(session))
    die(session)
    (path,) = root.glob("*.recovery")
    path.write_bytes(path.read_bytes()[: int(path.stat().st_size * keep)])
    found = offers(root)
    if not found:
        assert keep < 0.3
        return
    assert len(found[0].labels) < 4
    with Session.recover(found[0], spill_root=root) as again:
        assert print_of(again) == states[len(found[0].labels)]


def test_a_log_with_a_flipped_bit_stops_there(folder, root):
    session = opened(folder, root)
    session.drag("raise", (40, 60))
    session.recovery.settle()
    good = print_of(session)
    (path,) = root.glob("*.recovery")
    size = path.stat().st_size
    session.drag("raise", (90, 60))
    die(session)
    data = bytearray(path.read_bytes())
    data[size + (len(data) - size) // 2] ^= 4
    path.write_bytes(data)
    with Session.recover(offers(root)[0], spill_root=root) as again:
        assert print_of(again) == good


def test_a_disk_that_refuses_is_told_and_does_not_stop_the_work(folder, tmp_path):
    (tmp_path / "file").write_text("no folder")
    with Session.open(folder, spill_root=tmp_path) as session:
        session.keep_log(tmp_path / "file" / "state")
        session.drag("raise", (60, 60))
        session.save()
        assert any("recovery" in note for note in session.notes)


def test_records_come_back_bit_for_bit():
    """Every layer, negative zero and the smallest numbers too."""
    level = make_beach()
    odd = np.array([-0.0, 1e-45, np.float32(1e-30), -7.25], np.float32)
    level.write("flow", Rect(3, 3, 5, 5), np.resize(odd, (2, 2, 2)))
    level.write("cover", Rect(0, 0, 2, 2), 0.5)
    change = recovery_record.everything(level, "all")
    data = recovery_record.encode(change)
    header, payload = recovery_record.read(io.BytesIO(data))
    again = recovery_record.decode(header, payload)
    for layer, tiles in change.tiles.items():
        for tile, values in tiles.items():
            assert again.tiles[layer][tile].tobytes() == values.tobytes()
    assert again.ground.base.tobytes() == change.ground.base.tobytes()


def test_a_log_of_an_older_version_is_brought_forward(tmp_path):
    """L07: absorption was a total in version 1 of levels, and is in logs of that time."""
    change = recovery_record.everything(make_beach(), "all")
    older = change.settings.model_dump(mode="json")
    older["water"] = {"absorb_red": 0.40, "absorb_green": 0.075, "absorb_blue": 0.045}
    header, payload = recovery_record.read(io.BytesIO(recovery_record.encode(change)))
    log = tmp_path / "log"
    start = recovery_record.framed({"kind": "start", "version": 1, "folder": None, "fingerprint": None})
    log.write_bytes(start + recovery_record.framed({**header, "settings": older}, payload))
    with open(log, "rb") as file:
        (again,) = changes_of(file)
    assert absorption(again.settings.water) == pytest.approx([0.40, 0.075, 0.045])


def test_a_log_keeps_its_order_under_load(folder, root):
    """Two hundred steps at once: the worker is behind, the last state is still the last."""
    session = opened(folder, root)
    for n in range(200):
        session.drag("raise" if n % 3 else "lower", (20 + n % 100, 30 + n % 60), size_m=3)
    wanted = print_of(session)
    die(session)
    with Session.recover(offers(root)[0], spill_root=root) as again:
        assert print_of(again) == wanted


def test_a_log_that_grew_is_folded(folder, root, monkeypatch):
    """Whole grids, again and again: the log holds the last one, and still every label."""
    monkeypatch.setattr(recovery, "FOLD_BYTES", 5_000)
    session = opened(folder, root)
    largest = 0
    for n in range(12):
        session.drag("raise", (40 + n, 40), size_m=6)
        session.resize(samples=150 + n % 2)
        session.place(Camera(id=f"camera{n}", x=n, y=n))
        session.recovery._rest()
        largest = max(largest, session.recovery.path.stat().st_size)
    assert largest < 40_000, "unfolded it is 140 kB"
    assert not session.recovery.failed
    wanted = print_of(session)
    die(session)
    (offer,) = offers(root)
    assert offer.labels[:3] == ["Raise", "Resize", "Place camera0"]
    assert len(offer.labels) == 36
    with Session.recover(offer, spill_root=root) as again:
        assert print_of(again) == wanted
        assert again.journal.done[-1].label == "Recover 36 steps"


def test_a_log_that_cannot_be_folded_stays_as_it_is(folder, root, monkeypatch, caplog):
    monkeypatch.setattr(recovery, "FOLD_BYTES", 1_000)
    monkeypatch.setattr(recovery_record, "fold", lambda changes: 1 / 0)
    session = opened(folder, root)
    session.drag("raise", (40, 40), (90, 90), size_m=9)
    session.drag("raise", (40, 90), (90, 40), size_m=9)
    wanted = print_of(session)
    die(session)
    monkeypatch.undo()
    assert "could not be folded" in caplog.text
    with Session.recover(offers(root)[0], spill_root=root) as again:
        assert print_of(again) == wanted


def work(session):
    """What a busy editor does; yields after each press, and the state after each finished step."""
    for n in range(1000):
        session.stroke_begin(20 + n % 100, 30)
        yield "pressed"  # what was finished before is on the disk by now
        session.stroke_move(30 + n % 100, 90)
        session.stroke_end()
        yield print_of(session)
        if n % 5 == 4:
            session.undo()
            yield print_of(session)


CHILD = """
    import sys
    from pathlib import Path
    from shorewright.app.session import Session
    sys.path.insert(0, {tests!r})
    from test_recovery import print_of, work

    session = Session.open({folder!r})
    session.keep_log(Path({root!r}))
    for word in work(session):
        print(word, flush=True)
"""


@pytest.mark.parametrize("lines", [1, 3, 8, 13, 24])
def test_a_killed_editor(folder, root, lines):
    """T08: a process killed outright (SIGKILL), mid-stroke or anywhere: at most the stroke in progress is lost."""
    code = textwrap.dedent(CHILD).format(folder=str(folder), root=str(root), tests=str(Path(__file__).parent))
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as child:
        said = [child.stdout.readline().strip() for _ in range(lines)]
        child.kill()
        said += child.stdout.read().split()  # what it got to say before the signal
    assert len(said) >= lines
    with Session.open(folder, spill_root=root) as twin:  # the same, unharmed; and a little further
        states = [print_of(twin), *(word for word, _ in zip(work(twin), range(len(said) + 6)) if word != "pressed")]
    last_press = len(said) - 1 - said[::-1].index("pressed")
    finished = sum(word != "pressed" for word in said[:last_press])
    found = offers(root)
    if not found:
        assert finished == 0
        return
    with Session.recover(found[0], spill_root=root) as again:
        assert print_of(again) in states[finished:]
        assert broken(again) == []


def test_logs_of_two_editors_stay_apart(root):
    """Each editor has a log of its own."""
    one, two = RecoveryLog(root), RecoveryLog(root)
    level = make_beach()
    one.start(level, None)
    two.start(level, None)
    assert one.path != two.path
    assert not one.failed
    assert not two.failed
    one.close()
    two.close()
    assert list(root.glob("*")) == []
