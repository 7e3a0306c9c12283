"""Two settings or views beside each other (D42)."""

import copy

import numpy as np
import pytest
from scenes import camera, coast
from shorewright.app.commands.pictures import compared
from shorewright.level import BadInput
from shorewright.renderer.offscreen import compare, render

SIZE = (96, 54)


@pytest.mark.gl
@pytest.mark.parametrize("words", [["light.shadows=false", "shore.on=false"], ["view:albedo"], ["hide:water"]])
def test_each_half_is_the_picture_of_its_own(words, renderer):
    """D42: bit for bit, beside the line."""
    level = coast()
    shoot = {"size": SIZE, "time_s": 3.0, "renderer": renderer}
    other, look = compared(level, words, None)
    both = compare(level, other, camera(), look, **shoot)
    left, right = render(level, camera(), **shoot), render(other, camera(), **{**shoot, **look})
    assert np.array_equal(both[:, :47], left[:, :47])
    assert np.array_equal(both[:, 49:], right[:, 49:])
    assert (both[:, 47:49] == 255).all()
    assert not np.array_equal(left, right)


def test_the_level_keeps_its_settings():
    """D42: the other side has settings of its own."""
    level = coast()
    before = copy.copy(level.settings)
    other, _ = compared(level, ["sea.swell_m=2"], None)
    assert other.settings.sea.swell_m == 2
    assert level.settings == before
    with pytest.raises(BadInput):
        compared(level, ["view:nothing"], None)
