"""What a widget shows and takes, for every declared parameter there is (D31)."""

import math

import pytest
from shorewright.app import param_widgets as widgets
from shorewright.app.panels.settings_panel import matches, sections
from shorewright.brushes import BRUSHES
from shorewright.level import Settings
from shorewright.level.params import Param, describe, get, replace

ROWS = describe(Settings)
BRUSH_ROWS = [row for brush in BRUSHES.values() for row in describe(brush.params)]
NUMBERS = [row for row in ROWS + BRUSH_ROWS if row.kind in ("float", "int")]


def name_of(row: Param) -> str:
    return row.name


@pytest.mark.parametrize("row", NUMBERS, ids=name_of)
def test_sliders_stay_inside_the_hard_range(row):
    low, high = widgets.slider_range(row)
    assert low < high
    assert row.low is None or low >= row.low
    assert row.high is None or high <= row.high
    assert math.isfinite(low)
    assert math.isfinite(high)


@pytest.mark.parametrize("row", NUMBERS, ids=name_of)
def test_the_default_can_be_read_off_its_widget(row):
    """Printed with the widget's digits, the default is still what it is, within half a percent of the bar."""
    text = widgets.format_of(row) % row.default
    assert row.unit in text
    number = float(text.split()[0].rstrip("°×"))
    low, high = widgets.slider_range(row)
    assert abs(number - row.default) <= 0.005 * (high - low) + 1e-12


@pytest.mark.parametrize("row", [row for row in ROWS if row.kind in ("float", "int")], ids=name_of)
def test_whatever_is_typed_the_level_takes_it(row):
    """A typed value is brought into the hard range, so that it is never refused."""
    for typed in (-1e30, -1.5, 0.0, 3.7, 1e30, math.inf, math.nan):
        value = row.clamp(typed)
        assert get(replace(Settings(), row.name, value), row.name) == value


@pytest.mark.parametrize("row", ROWS + BRUSH_ROWS, ids=name_of)
def test_tooltips_say_what_it_is(row):
    text = widgets.tooltip_of(row)
    assert row.doc in text
    assert "Default" in text


def test_labels_leave_the_unit_to_the_value():
    rows = {row.name: row for row in ROWS}
    assert widgets.label_of(rows["sea.swell_length_m"]) == "Swell length"
    assert widgets.label_of(rows["light.sun_azimuth_deg"]) == "Sun azimuth"
    assert widgets.label_of(rows["light.exposure_ev"]) == "Exposure"
    assert widgets.label_of(rows["shore.count"]) == "Count"


@pytest.mark.parametrize("name", sections())
def test_labels_of_a_section_differ(name):
    shown = widgets.labels(sections()[name])
    assert len(set(shown)) == len(shown)


def test_formats():
    row = Param("a.share_pct", "float", 10.0, 0, 100, None, "%", "")
    assert widgets.format_of(row) % 12.0 == "12 %"
    assert widgets.format_of(Param("n", "int", 3, 1, 8, None, "", "")) % 3 == "3"
    assert widgets.format_of(Param("d", "float", 0.0002, 0, 0.2, (0, 0.004), "1/m", "")) % 0.0002 == "0.00020 1/m"


def test_bars_fill_from_end_to_end():
    assert widgets.filled(5, 0, 10) == 0.5
    assert widgets.filled(-3, 0, 10) == 0
    assert widgets.filled(30, 0, 10) == 1
    assert widgets.filled(10, 1, 100, log=True) == pytest.approx(0.5)
    assert widgets.filled(1, 1, 1) == 0


def test_every_setting_is_in_the_panel_once():
    shown = [row.name for rows in sections().values() for row in rows]
    assert sorted(shown) == sorted(row.name for row in ROWS)


def test_the_filter_finds_by_any_word():
    rows = {row.name: row for row in ROWS}
    assert matches(rows["sea.swell_length_m"], "swell length")
    assert matches(rows["shore.interval_s"], "time between")
    assert matches(rows["fog.density"], "haze")
    assert not matches(rows["fog.density"], "swell")
    assert matches(rows["fog.density"], "")
