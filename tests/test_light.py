"""Sky, reflection and display transform: finite, lossless where they must be, grey stays grey (L01, L02, L07)."""

import numpy as np
import pytest
from shorewright.level import Settings
from shorewright.level.params import replace
from shorewright.renderer import sky_light, sky_table
from shorewright.renderer.look import exposure_scale, look_uniforms
from shorewright.renderer.program import Shader
from shorewright.renderer.uniforms import set_uniforms

ELEVATIONS = range(-20, 91, 10)
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])

QUAD = """
#ifdef VERTEX
void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0), 0.0, 1.0); }
#endif
#ifdef FRAGMENT
out vec4 out_value;
uniform vec2 u_size;
BODY
#endif
"""


def evaluate(ctx, include: str, body: str, size=(64, 1), **uniforms) -> np.ndarray:
    """Run `vec4 value(vec2 at)` of a GLSL text over at = 0 … 1; float32 `(rows, cols, 4)`."""
    main = body + "\nvoid main() { out_value = value((gl_FragCoord.xy - 0.5) / max(u_size - 1.0, 1.0)); }"
    text = f'#include "lib/{include}.glsl"\n' + QUAD.replace("BODY", main)
    shader = Shader(ctx, "test.glsl", texts={"test.glsl": text})
    target = ctx.texture(size, 4, dtype="f4")
    frame = ctx.framebuffer([target])
    frame.use()
    ctx.disable(ctx.BLEND | ctx.DEPTH_TEST | ctx.CULL_FACE)
    set_uniforms(shader.program, {"u_size": size, **uniforms})
    shader.fullscreen()
    values = np.frombuffer(target.read(), np.float32).reshape(size[1], size[0], 4)
    ctx.detect_framebuffer(0).use()  # a framebuffer that is gone must not stay bound
    for thing in (shader, frame, target):
        thing.release()
    return values


@pytest.mark.gl
@pytest.mark.parametrize("transform", range(4), ids=("agx", "aces", "neutral", "raw"))
def test_display_is_monotone_and_keeps_grey(ctx, transform):
    """L01: brighter scene light never gives darker display light; grey stays grey; all of it in 0 … 1."""
    shown = f"display_transform(vec3(exp2(at.x * 24.0 - 14.0)), 1.0, {transform})"
    body = f"vec4 value(vec2 at) {{ return vec4({shown}, 1.0); }}"
    shown = evaluate(ctx, "display", body, (256, 1))[0, :, :3]
    assert (np.diff(shown[:, 1]) >= -1e-6).all()
    assert np.ptp(shown, axis=1).max() < 2e-3
    assert shown.min() >= 0
    assert shown.max() <= 1
    assert shown[-1, 1] > 0.97
    assert shown[0, 1] < 0.01


@pytest.mark.gl
def test_middle_grey_shows_as_middle_grey(ctx):
    body = "vec4 value(vec2 at) { return vec4(display_transform(vec3(0.18), 1.0, 0), 1.0); }"
    assert evaluate(ctx, "display", body)[0, 0, 1] == pytest.approx(0.18, abs=0.01)


@pytest.mark.gl
def test_exposure_is_the_same_on_both_sides(ctx):
    body = "vec4 value(vec2 at) { return vec4(exposure_scale(at.x * 20.0)); }"
    values = evaluate(ctx, "display", body)[0, :, 0]
    assert values == pytest.approx([exposure_scale(x) for x in np.linspace(0, 20, 64)], rel=1e-4)


@pytest.mark.gl
def test_dither_spreads_half_a_step(ctx):
    body = "vec4 value(vec2 at) { return vec4(dither(gl_FragCoord.xy), 1.0); }"
    noise = evaluate(ctx, "display", body, (64, 64))[..., :3] * 255
    assert np.abs(noise).max() <= 0.5
    assert abs(noise.mean()) < 0.02
    assert noise.std() > 0.25


@pytest.mark.parametrize("elevation", ELEVATIONS)
def test_sky_is_finite_and_bright_by_day(elevation):
    """L02: every sun elevation gives a finite sky, no channel below zero; the day is far brighter than the night."""
    table = sky_table.sky_table(elevation, 2.6)
    assert np.isfinite(table).all()
    assert table.min() >= 0
    lit = sky_light.up_irradiance(table)
    sun = sky_table.sun_illuminance(elevation, 2.6)
    assert np.isfinite(sun).all()
    assert (sun == 0).all() == (elevation < 0)
    assert (lit @ LUMINANCE > 1) == (elevation > 0)


def test_noon_has_the_known_numbers():
    """Clear noon: 80 to 115 klx from the sun, 10 to 30 klx from the sky, a blue zenith of 2 to 6 kcd/m²."""
    sun = sky_table.sun_illuminance(60, 2.6) @ LUMINANCE
    up = sky_light.up_irradiance(sky_table.sky_table(60, 2.6)) @ LUMINANCE
    zenith = sky_table.sky_table(60, 2.6)[-1, 32]
    assert 80 < sun < 115
    assert 10 < up < 30
    assert 2 < zenith @ LUMINANCE < 6
    assert zenith[2] > 1.5 * zenith[0]


def test_low_sun_is_warm():
    noon, evening = sky_table.sun_illuminance(60, 2.6), sky_table.sun_illuminance(5, 2.6)
    assert evening[0] / evening[2] > 3 * noon[0] / noon[2]


FURNACE = """
// Hemisphere integral of the reflection of a white world: at.x roughness, at.y cosine of the view.
vec4 value(vec2 at) {
    float roughness = mix(0.4, 1.0, at.x), cosine = mix(0.15, 1.0, at.y);
    vec3 n = vec3(0.0, 0.0, 1.0), v = vec3(sqrt(1.0 - cosine * cosine), 0.0, cosine);
    float mirror = 0.0, all = 0.0;
    const int RINGS = 200, STEPS = 96;
    for (int i = 0; i < RINGS; ++i) {
        float z = (float(i) + 0.5) / float(RINGS);
        for (int k = 0; k < STEPS; ++k) {
            float phi = (float(k) + 0.5) * 6.2831853 / float(STEPS);
            vec3 l = vec3(sqrt(1.0 - z * z) * vec2(cos(phi), sin(phi)), z);
            all += brdf_sun(vec3(1.0), n, v, l, roughness, vec3(0.04)).g;
            mirror += brdf_sun(vec3(0.0), n, v, l, roughness, vec3(0.04)).g;
        }
    }
    float weight = 6.2831853 / float(RINGS * STEPS);
    vec3 even = brdf_ambient(vec3(1.0), n, v, roughness, vec3(0.04), vec3(3.14159265), vec3(1.0));
    return vec4(all * weight, mirror * weight, even.g, 1.0);
}
"""


@pytest.mark.gl
def test_furnace(ctx):
    """L01: a white surface under even light stays white: 1 % ambient, and no direction gives back more than it got."""
    values = evaluate(ctx, "brdf", FURNACE, (4, 4))
    assert values[..., 2] == pytest.approx(1, abs=0.01)
    assert values[..., 0].max() < 1.045  # the fit of the mirror part is that good
    assert values[..., 0].min() > 0.9
    assert values[..., 1].min() > 0.005


@pytest.mark.gl
def test_water_goes_from_sand_through_green_to_blue(ctx):
    """L07: pale sand shines through shallow water, then green leads, then blue."""
    body = "vec4 value(vec2 at) { return vec4(water_albedo(vec3(0.45, 0.38, 0.28), at.x * 30.0, 0.8, 0.7), 1.0); }"
    uniforms = look_uniforms(Settings(), 0.0)
    albedo = evaluate(ctx, "water", body, (31, 1), **uniforms)[0, :, :3]
    assert albedo[0] == pytest.approx([0.45, 0.38, 0.28], abs=1e-3)
    shallow, deep = albedo[2], albedo[-1]
    assert shallow[1] > shallow[0]
    assert shallow[1] > shallow[2]
    assert deep[2] > deep[1] > 3 * deep[0]
    assert (np.diff(albedo.sum(1)) < 0).all()


def test_every_uniform_is_finite():
    for elevation in (-20, 0, 90):
        settings = replace(Settings(), "light.sun_elevation_deg", float(elevation))
        for name, value in look_uniforms(settings, 604_800.0).items():
            assert np.isfinite(value).all(), name
