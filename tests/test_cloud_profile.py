"""Height curves of clouds: what they are between their points, how types blend, how they are set (Z03)."""

import json

import numpy as np
import pytest
from shorewright.app import script
from shorewright.app.session import Session
from shorewright.level import BadInput, Settings
from shorewright.level.cloud_profile import HEIGHTS, KINDS, curve_samples, profile, profile_table
from shorewright.level.params import replace
from shorewright.level.sky_settings import curve_points

TEXT = "0,0,0.1,1,0.6,0"


def test_curves_go_through_their_points_and_never_past_them():
    """Z03: each piece stays between the two points that it joins."""
    rng = np.random.default_rng(5)
    for _ in range(50):
        count = int(rng.integers(2, 17))
        at = np.unique(np.round(rng.random(count), 3))
        if len(at) < 2:
            continue
        density = np.round(rng.random(len(at)), 3)
        curve = tuple(float(v) for v in np.stack([at, density], 1).ravel())
        samples, heights = curve_samples(curve, 4001), np.linspace(0, 1, 4001)
        for (h0, v0), (h1, v1) in zip(curve_points(curve), curve_points(curve)[1:]):
            piece = samples[(heights >= h0) & (heights <= h1)]
            assert piece.min() >= min(v0, v1) - 1e-6
            assert piece.max() <= max(v0, v1) + 1e-6
            assert np.all(np.diff(piece) * np.sign(v1 - v0) >= -1e-6)
        np.testing.assert_allclose(samples[np.round(at * 4000).astype(int)], density, atol=1e-6)


def test_the_table_holds_the_three_kinds():
    """Z03: g = 0, 0.5 and 1 are the kinds themselves, between them they are mixed; the shell's sides are bare."""
    settings = Settings()
    table = profile_table(settings)
    assert table.shape == (3, HEIGHTS)
    assert table.dtype == np.float32
    h = np.linspace(0, 1, HEIGHTS)
    for number, name in enumerate(KINDS):
        curve = curve_samples(getattr(settings.clouds, name))
        np.testing.assert_allclose(profile(table, number / 2, h), curve, atol=1e-7)
    np.testing.assert_allclose(profile(table, 0.25, h), (table[0] + table[1]) / 2, atol=1e-7)
    assert profile(table, 0.7, np.array([0.0, 1.0])).tolist() == [0.0, 0.0]
    assert profile(table, np.array([-1.0, 3.0]), 0.1).tolist() == profile(table, np.array([0.0, 1.0]), 0.1).tolist()


def test_stratus_is_flat_and_low_thunderheads_fill_the_shell():
    """Z03: the highest dense place of the default kinds rises from kind to kind."""
    table = profile_table(Settings())
    tops = [np.flatnonzero(row > 0.5).max() / (HEIGHTS - 1) for row in table]
    assert tops[0] < 0.25 < tops[1] < 0.6 < tops[2]


def test_a_curve_is_set_from_text():
    changed = replace(Settings(), "clouds.cumulus", TEXT)
    assert changed.clouds.cumulus == (0, 0, 0.1, 1, 0.6, 0)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("0,0,0.1", "2 to 16 pairs"), ("0,0,0.5,2", "from 0 to 1"), ("0.5,0,0.5,1", "heights rising"),
        ("thick", "numbers parted by commas"), ("", "numbers parted by commas"), ("0,0,nan,1", "finite"),
    ],
)  # fmt: skip
def test_what_is_no_curve_is_told(text, told):
    with pytest.raises(BadInput, match=told) as error:
        replace(Settings(), "clouds.stratus", text)
    assert "Value error" not in str(error.value)
    assert "\n" not in str(error.value)


def test_a_curve_is_a_word_of_a_script():
    """A recorded curve plays again, from JSON too."""
    with Session.new() as session:
        session.set("clouds.cumulus", (0, 0, 0.2, 1, 1, 0))
        words = session.script
    with Session.new() as again:
        assert again.run(script.parse(json.loads(script.dumps(script.parse(words))))) == 1
        assert again.level.settings.clouds.cumulus == (0, 0, 0.2, 1, 1, 0)
