"""Clouds over a square, column by column, as the shaders make them: what tests hold against the map."""

import numpy as np
from shorewright.level.objects import Camera
from shorewright.renderer.passes import weather
from shorewright.renderer.passes.clouds import cloud_uniforms
from shorewright.renderer.program import Shader
from shorewright.renderer.uniforms import bind_textures, set_uniforms
from shorewright.renderer.views import find_view

PROGRAM = """
#include "lib/frame.glsl"
#ifdef VERTEX
void main() { fullscreen_triangle(); }
#endif
#ifdef FRAGMENT
#include "lib/cloud_light.glsl"
uniform float u_square_m, u_side;
out vec4 out_column;
const int STEPS = 80;

void main() {
    vec2 at = (gl_FragCoord.xy / u_side - 0.5) * u_square_m;
    float depth = 0.0, moment = 0.0, top = 0.0, step_m = (u_clouds_top_m - u_clouds_base_m) / float(STEPS);
    for (int i = 0; i < STEPS; ++i) {
        float altitude = u_clouds_base_m + (float(i) + 0.5) * step_m;
        float extinction = cloud_extinction(vec3(at, altitude - u_eye_m), altitude, 0.0, false);
        depth += extinction * step_m;
        moment += extinction * step_m * altitude;
        if (extinction > 0.004) top = altitude;
    }
    out_column = vec4(depth, moment, top, 0.0);
}
#endif
"""


def prepared(renderer, level, camera=None, time_s=0.0, view="final"):
    """A frame with its weather map made, and the values of the clouds' uniforms."""
    camera = camera or Camera(id="there", x=0.0, y=0.0, z=10.0)
    frame = renderer.prepare(level, camera, (64, 36), time_s, find_view(view), None, "medium", None)
    weather.draw(frame)
    return frame, {**cloud_uniforms(frame), **frame.uniforms}


def run(renderer, frame, values, source, size, **more):
    """What a fragment shader writes, float32 `(rows, cols, 4)`."""
    shader = Shader(renderer.ctx, "test.glsl", texts={"test.glsl": source})
    set_uniforms(shader.program, {**values, **more})
    bind_textures(shader, frame.textures)
    target = renderer.ctx.simple_framebuffer(size, 4, dtype="f4")
    target.use()
    shader.fullscreen()
    result = np.frombuffer(target.read(components=4, dtype="f4"), np.float32).reshape(size[1], size[0], 4)
    renderer.ctx.detect_framebuffer(0).use()
    target.release()
    shader.release()
    return result


def columns(renderer, level, side=96, square_m=14_000.0, time_s=0.0):
    """Optical depth, height centroid m (over columns with cloud) and top m of each column, `(side, side)` each."""
    frame, values = prepared(renderer, level, time_s=time_s)
    out = run(renderer, frame, values, PROGRAM, (side, side), u_side=float(side), u_square_m=square_m)
    depth, moment, top = out[..., 0], out[..., 1], out[..., 2]
    return depth, moment.sum() / max(depth.sum(), 1e-6), top
