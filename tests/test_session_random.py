"""Everything a session can do, in random order: undo is the way back, redo the way forth, a script the same again."""

import contextlib
import tempfile
from pathlib import Path

import numpy as np
from coasts import make_beach
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule
from shorewright.app.actions import ACTIONS
from shorewright.app.invariants import broken
from shorewright.app.session import Session
from shorewright.brushes import BRUSHES
from shorewright.io.images import write_image
from shorewright.level import BadInput, Settings
from shorewright.level.params import describe

ROWS = {row.name: row for row in describe(Settings)}
part = st.floats(0, 1, width=32)
places = st.lists(st.tuples(st.floats(-20, 100), st.floats(-20, 90), part), min_size=1, max_size=4)
hands = st.fixed_dictionaries({"size_m": st.floats(0.3, 30), "falloff": part, "opacity": part})
# What an action does is tested here through the session; a file dialog has nobody to answer it.
KEYS = [name for name in ACTIONS if name not in ("undo", "redo", "abort", "save", "save_as")]


def value_of(row, share):
    """A value of a setting's kind, `share` of the way through its range."""
    match row.kind:
        case "bool":
            return share > 0.5
        case "choice":
            return row.choices[int(share * 0.999 * len(row.choices))]
        case "int":
            return int(row.low + share * (row.high - row.low))
        case "text":
            return ""
        case "vector":  # a height curve
            return (0.0, share, 1.0, 1 - share)
    low, high = row.soft or (row.low, row.high)
    return low + share * (high - low)


def state(session):
    """What a level is, as bytes and values that compare."""
    level = session.level
    layers = {name: data.array.tobytes() for name, data in level.layers.items() if not data.neutral}
    return level.grid, level.height.tobytes(), layers, level.settings, dict(level.objects), dict(level.georeference)


class AnySession(RuleBasedStateMachine):
    """T08, T10: `past` and `future` hold what the level must be after each undo and redo."""

    def __init__(self):
        super().__init__()
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.ground = self.root / "ground.npz"
        np.savez(self.ground, height=np.random.default_rng(5).normal(0, 3, (50, 60)).astype(np.float32))
        self.map = write_image(self.root / "sky.png", np.random.default_rng(6).integers(0, 256, (9, 9, 3), np.uint8))
        self.session = self.fresh("spill")
        self.past, self.future = [state(self.session)], []
        self.merging = None

    def fresh(self, spill):
        level = make_beach(rows=65, cols=81, rough_m=0.05)
        return Session(level, undo_bytes=20_000, spill_root=self.root / spill)  # so little that steps go to disk

    def teardown(self):
        try:
            self.there_and_back()
        finally:
            self.session.close()
            self.folder.cleanup()

    def there_and_back(self):
        """All the way back, all the way forth, and the whole record once more from the beginning."""
        self.session.stroke_abort()
        end = state(self.session)
        with self.fresh("again") as again:
            again.run(self.session.script)
            assert state(again) == end
        for wanted in reversed(self.past[:-1]):
            assert self.session.undo()
            assert state(self.session) == wanted
        assert self.session.undo() is None
        for wanted in [*self.past[1:], *self.future]:
            assert self.session.redo()
            assert state(self.session) == wanted

    def did(self):
        """Something was done: when it left a step, there is a new state and nothing to redo."""
        if len(self.session.journal.done) != len(self.past) - 1:
            assert len(self.session.journal.done) == len(self.past)
            self.past.append(state(self.session))
            self.future.clear()
        assert state(self.session) == self.past[-1]
        self.merging = None

    @rule(brush=st.sampled_from(list(BRUSHES)), points=places, hand=hands, invert=st.booleans(), smooth=st.booleans())
    def drag(self, brush, points, hand, invert, smooth):
        self.release()
        self.session.drag(brush, *points, invert=invert, smooth=smooth, **hand)
        self.did()

    @rule(y=st.floats(1, 60), way=st.floats(-8, 8), radius=st.floats(3, 40), by_hand=st.booleans())
    def shape(self, y, way, radius, by_hand):
        """T07: a crest dragged, or said by a line; often refused."""
        self.release()
        self.session.set_front("radius_m", radius)
        with contextlib.suppress(BadInput):
            if by_hand:
                self.session.front_begin(40.0, y)
                self.session.stroke_move(40.0, y + way)
                self.session.stroke_end()
            else:
                self.session.shape_front([(30.0, y), (50.0, y + 0.3 * way)])
        self.did()

    @rule(brush=st.sampled_from(list(BRUSHES)), points=places, invert=st.booleans())
    def press(self, brush, points, invert):
        self.release()
        self.session.pick_brush(brush)
        self.session.stroke_begin(*points[0], invert=invert)
        for point in points[1:]:
            self.session.stroke_move(*point)

    @precondition(lambda self: self.session.stroke)
    @rule()
    def release(self):
        if self.session.stroke:
            self.session.stroke_end()
            self.did()

    @precondition(lambda self: self.session.stroke)
    @rule(by=st.sampled_from(["abort", "undo"]))
    def escape(self, by):
        ACTIONS[by].run(self.session)
        self.did()

    @rule(name=st.sampled_from(list(ROWS)), share=part)
    def change(self, name, share):
        self.release()
        self.session.set(name, value_of(ROWS[name], share))
        self.did()

    @rule(
        opacity=part, extent_m=st.floats(300, 70_000), x=st.floats(-1e5, 1e5), swizzle=st.sampled_from(["", "b,-,1-r"])
    )
    def sky(self, opacity, extent_m, x, swizzle):
        """A weather map over the painted sky."""
        self.release()
        where = {"extent_m": extent_m, "at": (x, -x / 2), "opacity": opacity}
        self.session.weather_import(self.map, swizzle=swizzle, **where)
        self.did()

    @rule(name=st.sampled_from(["sea.swell_m", "level.sea_level_m"]), shares=st.lists(part, min_size=1, max_size=4))
    def slide(self, name, shares):
        """A slider drag is one step."""
        self.release()
        for share in shares:
            self.session.set(name, value_of(ROWS[name], share), merge=True)
        self.session.seal()
        self.did()

    @rule(name=st.sampled_from(["a", "b"]), kind=st.sampled_from(["camera", "sea_seed", "disturbance"]), x=part, y=part)
    def place(self, name, kind, x, y):
        self.release()
        self.session.place({"id": name, "kind": kind, "x": 80 * x, "y": 64 * y})
        self.did()

    @precondition(lambda self: self.session.level.objects)
    @rule(at=part)
    def remove(self, at):
        self.release()
        names = sorted(self.session.level.objects)
        self.session.remove(names[int(at * 0.999 * len(names))])
        self.did()

    @rule(samples=st.integers(20, 140))
    def resize(self, samples):
        self.release()
        self.session.resize(samples=samples)
        self.did()

    @rule(west=part, south=part, wide=part, high=part)
    def crop(self, west, south, wide, high):
        self.release()
        east_m, north_m = self.session.level.grid.extent_m
        west_m, south_m = west * east_m / 3, south * north_m / 3
        self.session.crop(west_m, south_m, west_m + (1 + wide) * east_m / 3, south_m + (1 + high) * north_m / 3)
        self.did()

    @rule(cell_m=st.sampled_from([0.5, 1.0, 2.0]))
    def other_ground(self, cell_m):
        self.release()
        self.session.import_height(self.ground, cell_m=cell_m, rows="north-first")
        self.did()

    @rule(name=st.sampled_from(KEYS))
    def press_a_key(self, name):
        """An action of the menus leaves one step or none."""
        self.release()
        if ACTIONS[name].enabled(self.session):
            with contextlib.suppress(BadInput):  # what has no direction can't be turned
                ACTIONS[name].run(self.session)
        self.did()

    @rule()
    def undo(self):
        self.release()
        if self.session.undo() is None:
            assert len(self.past) == 1
            return
        self.future.insert(0, self.past.pop())
        assert state(self.session) == self.past[-1]

    @precondition(lambda self: self.future)
    @rule()
    def redo(self):
        self.release()
        if self.future:
            assert self.session.redo()
            self.past.append(self.future.pop(0))
            assert state(self.session) == self.past[-1]
        else:
            assert self.session.redo() is None

    @rule()
    def save_and_look(self):
        """What is on the disk is what is in memory; saving again writes the same bytes."""
        from shorewright.io import check, read_level

        self.release()
        path = self.session.save(None if self.session.path else self.root / "a.shore")
        assert not self.session.dirty
        assert check(path) == []
        with Session(read_level(path), spill_root=self.root / "read") as read:
            assert state(read) == self.past[-1]
        files = {file: file.read_bytes() for file in path.rglob("*.*")}
        self.session.save()
        assert {file: file.read_bytes() for file in path.rglob("*.*")} == files

    @invariant()
    def nothing_is_broken(self):
        assert broken(self.session) == []


AnySession.TestCase.settings = settings(
    max_examples=20, stateful_step_count=20, deadline=None, suppress_health_check=list(HealthCheck)
)
TestAnySession = AnySession.TestCase
