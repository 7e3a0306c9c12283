"""The march through the clouds against closed forms (Z12, Z14): the shell, Beer's law, no cloud missed, no NaN."""

import numpy as np
import pytest
from cloud_columns import prepared
from coasts import make_beach
from shorewright.level import Rect
from shorewright.level.objects import Camera
from shorewright.renderer.passes import clouds, weather
from shorewright.renderer.program import Shader, shader_path
from shorewright.renderer.uniforms import bind_textures, set_uniforms
from shorewright.renderer.views import find_view

pytestmark = pytest.mark.gl
EYES_M = (2.0, 200.0, 1500.0, 1600.0, 4000.0, 4500.0)
PLANET_M = 6_371_000.0
FAN = """
#include "lib/frame.glsl"
#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif
#ifdef FRAGMENT
#include "lib/cloud_march.glsl"
uniform float u_fan;  // directions from straight down to straight up
out vec4 out_value;
void main() {
    float up = radians((gl_FragCoord.x - 0.5) / (u_fan - 1.0) * 180.0 - 90.0);
    vec3 dir = vec3(0.0, cos(up), sin(up));
    %s
}
#endif
"""
RAYS = 721


def sky_level(**settings):
    level = make_beach()
    for path, value in {"clouds.on": True, **settings}.items():
        level.set(path, value)
    return level


def fan(renderer, level, body, eye_m=30.0, texts=None, **uniforms):
    """What `body` makes of each direction of a fan, float32 `(721, 4)`, and their elevations."""
    camera = Camera(id="eye", x=0.0, y=0.0, z=eye_m + level.sea_level_m)
    frame, values = prepared(renderer, level, camera)
    shader = Shader(renderer.ctx, "fan.glsl", texts={"fan.glsl": FAN % body, **(texts or {})})
    set_uniforms(shader.program, {**values, "u_fan": float(RAYS), **uniforms})
    bind_textures(shader, frame.textures)
    target = renderer.ctx.framebuffer([renderer.ctx.texture((RAYS, 1), 4, dtype="f4")])
    target.use()
    shader.fullscreen()
    result = np.frombuffer(target.read(components=4, dtype="f4"), np.float32).reshape(RAYS, 4)
    renderer.ctx.detect_framebuffer(0).use()
    target.color_attachments[0].release()
    target.release()
    shader.release()
    return result, np.radians(np.linspace(-90, 90, RAYS))


def directions(renderer):
    """Vertical and horizontal parts of the fan's directions as the shader has them, in extended precision."""
    found, _ = fan(renderer, sky_level(), "out_value = vec4(dir, 0.0);")
    return found[:, 2].astype(np.longdouble), found[:, 1].astype(np.longdouble)


def hits(rise, eye_m, height_m):
    """Both distances to a sphere by the schoolbook formula in extended precision, NaN where it is missed."""
    radius, eye = np.longdouble(PLANET_M), np.longdouble(eye_m)
    b, c = (radius + eye) * rise, (radius + eye) ** 2 - (radius + height_m) ** 2
    with np.errstate(invalid="ignore"):
        root = np.sqrt(b * b - c)
    return -b - root, -b + root


@pytest.mark.parametrize("eye_m", EYES_M)
def test_distances_to_the_shell_are_right_to_five_centimetres(renderer, eye_m):
    """Z12: single precision at 6371 km, in all directions, from under it, in it, over it and on its sides."""
    body = "out_value = vec4(sphere_hits(dir, u_clouds_base_m), sphere_hits(dir, u_clouds_top_m));"
    (found, _), (rise, level) = fan(renderer, sky_level(), body, eye_m), directions(renderer)
    for column, height in ((0, 1500.0), (2, 4000.0)):
        near, far = hits(rise, eye_m, height)
        tangent = abs((PLANET_M + eye_m) * level - PLANET_M - height) < 1.0  # a metre from missing it
        for got, true in ((found[:, column], near), (found[:, column + 1], far)):
            there = np.isfinite(true) & ~tangent & (true >= 0) & (true < 200_000.0)
            assert np.abs(got[there] - true[there]).max(initial=0.0) < 0.05


@pytest.mark.parametrize("eye_m", EYES_M)
def test_heights_over_the_sea_are_right_to_five_centimetres(renderer, eye_m):
    """Z12: of places up to 55 km off."""
    body = "for (int i = 0; i < 4; ++i) out_value[i] = altitude_of(dir * (100.0 + 18000.0 * float(i)));"
    (found, _), (rise, level) = fan(renderer, sky_level(), body, eye_m), directions(renderer)
    for column in range(4):
        along = np.longdouble(100 + 18_000 * column)
        x, z = along * level, PLANET_M + eye_m + along * rise
        true = np.sqrt(x * x + z * z) - PLANET_M
        assert np.abs(found[:, column] - true).max() < 0.05


def slab():
    """level/clouds.glsl with a shell full of even cloud."""
    text = shader_path("level/clouds.glsl").read_text()
    for name, inside in (
        ("cloud_base", "return float(h > 0.0 && h < 1.0);"),
        ("cloud_eroded", "return u_clouds_extinction;"),
    ):
        head = text.index(f"float {name}(")
        text = text[: text.index("{", head) + 1] + "\n    " + inside + text[text.index("{", head) + 1 :]
    return text


@pytest.mark.parametrize("steps", [16.0, 64.0, 128.0])
@pytest.mark.parametrize("start", [0.0, 0.37, 1.0])
def test_even_cloud_follows_beers_law_whatever_the_steps(renderer, steps, start):
    """Z12, Z14: transmittance is exp(−σ L) to 1/255, and what the cloud sends is its source times the rest."""
    level = sky_level(**{"clouds.extinction": 0.001, "weather.coverage": 1.0, "weather.variety": 0.0})
    for name in ("cone", "far", "ambient", "beer", "powder", "rain"):
        level.set(f"cloud_terms.{name}", False)
    body = (
        f"March m = cloud_march(dir, {start}); vec2 span = shell_span(dir);"
        "out_value = vec4(m.transmittance, span.y - span.x, m.light.g, cloud_source(vec3(0.0), 2000.0, 0.5, 0.0,"
        "dot(dir, u_sun_direction), cloud_phase(dot(dir, u_sun_direction)), 0.0, true).g);"
    )
    found, up = fan(renderer, level, body, texts={"level/clouds.glsl": slab()}, u_cloud_steps=(steps, steps))
    through, length, light, source = found[np.degrees(up) > 8].T  # lower ones reach into the fading distance
    expected = np.exp(-0.001 * length)
    kept = expected > 0.006  # past that it counts as opaque
    assert np.abs(through - expected)[kept].max() < 1 / 255
    assert np.abs(light / source - (1 - expected))[kept].max() < 2 / 255


def alpha(renderer, level, camera, size=(240, 136)):
    """Opacity of the clouds' image, marched whole."""
    held = renderer.kept.pop("clouds", None)
    if held is not None:
        held.release()
    frame = renderer.prepare(level, camera, size, 0.0, find_view("final"), None, "medium", None)
    weather.draw(frame)
    clouds.draw(frame)
    light = renderer.kept["clouds"].image.textures[0]
    return 1 - np.frombuffer(light.read(), np.float16).reshape(-1, 4)[:, 3].astype(np.float32)


@pytest.mark.parametrize("coverage", [0.15, 0.4, 0.7])
def test_cheap_steps_miss_no_cloud(renderer, coverage):
    """Z14: no ray that meets cloud by full steps alone has less than half of it with cheap ones."""
    for pitch in (4.0, 20.0, 60.0):
        camera = Camera(id="eye", x=0.0, y=0.0, z=30.0, yaw_deg=10.0, pitch_deg=pitch, fov_deg=50.0)
        full, cheap = (
            alpha(renderer, sky_level(**{"weather.coverage": coverage, "cloud_terms.cheap_steps": on}), camera)
            for on in (False, True)
        )
        seen = full > 0.02
        assert seen.any()
        missed = seen & (cheap < 0.5 * full)
        assert not missed.any(), f"{missed.sum()} of {seen.sum()} rays at {pitch}°"


def test_cheap_steps_leave_full_samples_to_clouds(renderer):
    """Z14: under a clear sky there are none, and a painted cloud is still met."""
    body = "out_value = vec4(cloud_march(dir, 0.5).samples);"
    clear = {"weather.coverage": 0.0, "weather.variety": 0.0, "weather.horizon_coverage": 0.0}
    assert fan(renderer, sky_level(**clear), body)[0].max() == 0
    level = sky_level(**clear)
    level.write("weather", Rect(262, 252, 270, 260), np.float32([0.9, 0.0, 0.5, 1.0, 1.0, 1.0]))
    assert fan(renderer, level, body)[0].max() > 5


@pytest.mark.parametrize("sun_deg", [40.0, 0.0, -6.0])
def test_there_is_no_nan_wherever_the_camera_stands(renderer, sun_deg):
    """Z12: below, in, over and on the sides of the shell, in all directions, by day and after sunset."""
    level = sky_level(**{"weather.coverage": 0.8, "light.sun_elevation_deg": sun_deg})
    body = "March m = cloud_march(dir, 0.5); out_value = vec4(m.light.rg, m.transmittance, m.depth_m);"
    for eye_m in (*EYES_M, 0.0, -3.0, 12_000.0):
        found, _ = fan(renderer, level, body, eye_m)
        assert np.isfinite(found).all()
        assert ((found[:, 2] >= 0) & (found[:, 2] <= 1)).all()
        assert (found >= 0).all()
