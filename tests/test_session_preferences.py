"""Preferences survive a restart and never stop one (T08)."""

import json

import pytest
from shorewright.app.preferences import MOST_RECENT, Preferences, default_path, load


def test_they_come_back(tmp_path):
    path = tmp_path / "deep" / "preferences.json"
    kept = Preferences(ui_scale=1.5, quality="low")
    kept.remember(tmp_path / "a.shore")
    assert kept.save(path)
    assert load(path) == kept
    assert [entry.name for entry in path.parent.iterdir()] == ["preferences.json"]


def test_recent_levels_are_newest_first_and_exist(tmp_path):
    kept = Preferences()
    for n in range(MOST_RECENT + 3):
        kept.remember(tmp_path / f"{n}.shore")
    kept.remember(tmp_path / "5.shore")
    assert len(kept.recent) == MOST_RECENT
    assert kept.recent[0].endswith("5.shore")
    assert len(set(kept.recent)) == MOST_RECENT
    assert kept.recent_levels() == []
    (tmp_path / "5.shore").mkdir()
    (tmp_path / "5.shore" / "level.json").write_text("{}")
    assert kept.recent_levels() == [tmp_path / "5.shore"]


@pytest.mark.parametrize("content", [b"", b"{", b"\xff", b"[]", b"3", b'{"recent": 5}', b"[" * 100_000])
def test_a_damaged_file_costs_the_preferences_only(tmp_path, content):
    path = tmp_path / "preferences.json"
    path.write_bytes(content)
    assert load(path) == Preferences()


def test_one_bad_value_costs_that_value(tmp_path):
    """A hand-edited or newer file keeps what can be used."""
    path = tmp_path / "preferences.json"
    path.write_text(json.dumps({"ui_scale": 99, "quality": "high", "from_the_future": True}))
    assert load(path) == Preferences(quality="high")


def test_a_disk_that_refuses_is_no_error(tmp_path):
    (tmp_path / "file").write_text("")
    assert not Preferences().save(tmp_path / "file" / "preferences.json")


def test_the_users_folder_is_the_systems(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    assert tmp_path in default_path().parents
