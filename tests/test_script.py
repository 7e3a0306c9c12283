"""Scripts: JSON that people write, checked with the number of the action that is wrong (T10)."""

import json

import pytest
from shorewright.app import script
from shorewright.level import BadInput

ALL = [
    {"do": "stroke", "brush": "raise", "params": {"size_m": 8}, "points": [[40, 52], [60, 55, 0.5]], "invert": True},
    {"do": "set", "name": "sea.swell_m", "value": 1.2},
    {"do": "set", "name": "sea.on", "value": False},
    {"do": "set", "name": "light.display", "value": "agx"},
    {"do": "time", "t": 12.5},
    {"do": "pause"},
    {"do": "run"},
    {"do": "step", "steps": -3},
    {"do": "undo"},
    {"do": "redo"},
    {"do": "place", "object": {"id": "a", "kind": "camera", "x": 1, "y": 2}},
    {"do": "remove", "id": "a"},
    {"do": "resize", "samples": 100},
    {"do": "set_all", "label": "Loop", "values": {"time.loop_start_s": 1.5, "time.loop_end_s": 9}},
    {"do": "crop", "west_m": 0, "south_m": 0, "east_m": 9, "north_m": 9},
    {"do": "import", "path": "coast.png", "flags": {"height_range": [0, 9]}},
]


def test_every_action_survives_json():
    """T10: what a script says is what comes back from its own text."""
    parsed = script.parse({"version": 1, "actions": ALL})
    assert len(parsed.actions) == len(ALL)
    again = script.parse(json.loads(script.dumps(parsed)))
    assert again == parsed
    for given, kept in zip(ALL, parsed.dump()["actions"]):
        assert {key: kept[key] for key in given if key not in ("points", "object")} == {
            key: given[key] for key in given if key not in ("points", "object")
        }


def test_values_keep_their_kind():
    """A number stays a number and a switch a switch."""
    parsed = script.parse({"version": 1, "actions": ALL}).actions
    assert parsed[1].value == 1.2
    assert parsed[2].value is False
    assert parsed[3].value == "agx"
    assert parsed[0].points == [(40, 52), (60, 55, 0.5)]


BAD = [
    ({"do": "stroke", "points": [[1, 2]]}, "brush"),
    ({"do": "stroke", "brush": "raise", "points": []}, "points"),
    ({"do": "stroke", "brush": "raise", "points": [[1]]}, "points"),
    ({"do": "stroke", "brush": "raise", "points": [[1, 2, 3]]}, "points"),
    ({"do": "stroke", "brush": "raise", "points": [[1, float("nan")]]}, "points"),
    ({"do": "stroke", "brush": "raise", "points": [[1, 2]], "colour": 3}, "colour"),
    ({"do": "set", "name": "sea.swell_m"}, "value"),
    ({"do": "set", "name": "sea.swell_m", "value": [1]}, "value"),
    ({"do": "time", "t": -1}, "t"),
    ({"do": "time", "t": float("inf")}, "t"),
    ({"do": "step", "steps": 1e9}, "steps"),
    ({"do": "paint"}, "one of"),
    ({"brush": "raise"}, "one of"),
    ("undo", "object"),
    ({"do": "place", "object": {"id": "a b", "kind": "camera"}}, "object"),
    ({"do": "place", "object": {"id": "a", "kind": "whale"}}, "object"),
    ({"do": "undo", "times": 2}, "times"),
]


@pytest.mark.parametrize(("action", "told"), BAD, ids=[str(n) for n in range(len(BAD))])
def test_the_wrong_action_is_named_by_its_number(action, told):
    """T10: one sentence with the number, from 1, and the word that is wrong."""
    with pytest.raises(BadInput) as caught:
        script.parse({"version": 1, "actions": [{"do": "pause"}, action]}, "waves.json")
    sentence = str(caught.value)
    assert "waves.json, action 2" in sentence
    assert told in sentence.partition("action 2")[2]
    assert "\n" not in sentence


@pytest.mark.parametrize(
    "raw", [[], {}, {"actions": []}, {"version": 2, "actions": []}, {"version": 1, "actions": {}}, None, {"version": 1}]
)
def test_what_is_no_script_is_refused(raw):
    with pytest.raises(BadInput):
        script.parse(raw)


def test_a_stray_word_beside_the_actions_is_refused():
    with pytest.raises(BadInput, match="action"):
        script.parse({"version": 1, "actions": [], "brushes": []})


@pytest.mark.parametrize(
    ("content", "told"),
    [(b"{", "JSON"), (b"\xff\xfe\x00", "UTF-8"), (b"[" * 100_000, "JSON"), (b"", "JSON"), (None, "exist")],
    ids=["cut", "binary", "deep", "empty", "missing"],
)
def test_bad_files_are_one_sentence(tmp_path, content, told):
    path = tmp_path / "script.json"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(BadInput, match=told) as caught:
        script.load(path)
    assert "\n" not in str(caught.value)
