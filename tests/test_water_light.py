"""Colour of water from what lives in it, light through crests, brightness of foam (L07)."""

import numpy as np
import pytest
from scenes import coast
from shorewright.level.objects import Camera
from shorewright.level.settings import Settings, Water
from shorewright.level.water_optics import PURE_ABSORPTION, absorption, backscatter
from shorewright.renderer import render
from shorewright.renderer.look import look_uniforms
from test_light import LUMINANCE, evaluate

PURE = Water(plankton=0.0, silt=0.0, scatter=0.0)


def test_pure_water_has_the_measured_coefficients():
    """L07: Pope & Fry 1997 at 650, 550, 450 nm; scattering is half of Morel's (1974) and bluest."""
    assert absorption(PURE) == pytest.approx([0.34, 0.0565, 0.0092])
    assert backscatter(PURE) == pytest.approx([0.000464, 0.000954, 0.00227], rel=0.01)


@pytest.mark.parametrize("name", ["plankton", "silt"])
def test_more_in_the_water_takes_more_light_and_gives_more_back(name):
    """L07: every colour, monotone, from nothing to far beyond nature, and finite."""
    rows = [PURE.model_copy(update={name: value}) for value in (0.0, 0.01, 0.1, 1.0, 10.0, 100.0)]
    absorbed, back = (np.array([what(row) for row in rows]) for what in (absorption, backscatter))
    assert (np.diff(absorbed, axis=0) > 0).all()
    assert (np.diff(back, axis=0) > 0).all()
    assert np.isfinite(absorbed).all()


def test_plankton_turns_blue_water_green():
    """L07: with little in it blue light goes farthest, at a green coast green does (Morel 1991)."""
    clear, green = absorption(Water(plankton=0.05, silt=0.0)), absorption(Water(plankton=2.0, silt=0.0))
    assert clear[2] < clear[1] < clear[0]
    assert green[1] < green[2]
    assert absorption(Water(absorb_red=0.3))[0] - absorption(Water())[0] == pytest.approx(0.3)
    assert (absorption(Water()) >= PURE_ABSORPTION).all()


CREST = """
// at.x height of the face 0 … 1, at.y half a turn of the sun round the eye; the face looks at the eye
vec4 value(vec2 at) {
    vec3 eye = normalize(vec3(1.0, 0.0, 0.15)), normal = normalize(vec3(0.5, 0.0, 1.0));
    float turn = at.y * 3.14159265;
    vec3 sun = normalize(vec3(-cos(turn), sin(turn), 0.2));
    return vec4(water_crest_light(at.x, normal, eye, sun), 1.0);
}
"""


@pytest.mark.gl
def test_crest_light_glows_against_the_sun_on_raised_faces_alone(ctx):
    """L07: most into the sun, none with it behind, none on flat water; green; at most half comes out."""
    light = evaluate(ctx, "water", CREST, (9, 9), **look_uniforms(Settings(), 0.0), u_water_crest_light=1.0)[..., :3]
    assert (light[:, 0] == 0).all()
    assert (light[5:] == 0).all()
    assert (np.diff(light[0, 1:, 1]) > 0).all()
    assert (np.diff(light[:5, -1, 1]) <= 0).all()
    peak = light[0, -1]
    assert peak[1] > 1.3 * peak[0]
    assert 0.02 < peak @ LUMINANCE < 0.2
    uniforms = look_uniforms(Settings(), 0.0)
    assert evaluate(ctx, "water", CREST, (9, 9), **uniforms, u_water_crest_light=100.0)[..., :3].max() <= 0.5
    assert evaluate(ctx, "water", CREST, (9, 9), **uniforms, u_water_crest_light=0.0)[..., :3].max() == 0


@pytest.mark.gl
def test_the_picture_gains_the_crest_light_of_its_view(renderer):
    """L07: against the sun the knob adds light where the view says so; turned round, nothing."""
    level = coast()
    level.set("light.sun_elevation_deg", 12.0)
    level.set("light.sun_azimuth_deg", 180.0)
    level.set("fog.on", False)
    kept = Camera(id="c", x=128, y=112, z=2.5, yaw_deg=180, pitch_deg=-4, fov_deg=60)
    for yaw, glows in ((180.0, True), (0.0, False)):
        place = kept.model_copy(update={"yaw_deg": yaw, "y": 112.0 if glows else 60.0})
        shots = []
        for knob in (0.0, 1.0):
            level.set("water.crest_light", knob)
            shots.append(render(level, place, (96, 54), 4.0, "hdr", linear=True, renderer=renderer).astype(float))
        share = render(level, place, (96, 54), 4.0, "crest_light", linear=True, renderer=renderer)[..., 1]
        gain = (shots[1] - shots[0])[..., 1]
        if glows:
            assert share.max() > 0.01
            assert gain[share > 0.01].min() > 0
            assert np.abs(gain[share == 0]).max() < 1e-3
        else:
            assert share.max() == 0
            assert np.abs(gain).max() < 1e-3


FOAM = "vec4 value(vec2 at) { return vec4(foam_albedo(Foam(1.0, 0.9, 1.0, at.x, at.y)), 1.0); }"


@pytest.mark.gl
def test_full_foam_is_as_bright_as_measured(ctx, renderer):
    """L07: albedo of thick foam 0.6 to 0.8, whatever its age and relief (Koepke 1984), in the albedo view too."""
    shade = evaluate(ctx, "foam", FOAM, (5, 5))[..., :3] @ LUMINANCE
    assert shade.min() > 0.59
    assert shade.max() < 0.81
    level, place = coast(), Camera(id="c", x=128, y=110, z=25, yaw_deg=0, pitch_deg=-50, fov_deg=60)
    shoot = {"size": (160, 90), "linear": True, "renderer": renderer}
    found = 0
    for time_s in (2.0, 4.0, 6.0):
        foam = render(level, place, time_s=time_s, view="foam", **shoot)[..., 0]
        sea = render(level, place, time_s=time_s, view="material", **shoot)[..., 2] > 0.6
        albedo = render(level, place, time_s=time_s, view="albedo", **shoot) @ LUMINANCE
        full = sea & (foam > 0.97)
        found += full.sum()
        assert ((albedo[full] > 0.55) & (albedo[full] < 0.82)).all()
    assert found > 20
