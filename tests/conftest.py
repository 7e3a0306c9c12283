"""Fixtures that every room shares: one OpenGL context, two small levels, the folder of real files."""

import gc
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from coasts import make_beach
from hypothesis import HealthCheck, settings

# What macOS offers: everything must work there (design, GL 4.1). Set before the first context is made.
os.environ.setdefault("MESA_GL_VERSION_OVERRIDE", "4.1FC")
os.environ.setdefault("MESA_GLSL_VERSION_OVERRIDE", "410")
# Processes that share the work draw with a thread each.
os.environ.setdefault("LP_NUM_THREADS", "1" if "PYTEST_XDIST_WORKER" in os.environ else "2")

# No test may fail by timing, and a failure must come again the next time.
settings.register_profile("steady", deadline=None, derandomize=True, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("steady")

TESTS = Path(__file__).parent
DATA = TESTS.parents[1] / "shared" / "data"


# The slowest files begin: two processes share the files, and one that begins last is waited for.
FIRST = ("test_window_weather", "test_goldens", "test_window_panels", "test_window", "test_shaping_coasts",
         "test_window_fronts", "test_sample_levels", "test_window_time", "test_renderer_surface", "test_views",
         "test_slow_map", "test_renderer", "test_shots", "test_clients_meshes")  # fmt: skip


def pytest_collection_modifyitems(items) -> None:
    """Files in the order of FIRST, then as they were; tests within a file stay as written."""
    items.sort(key=lambda item: FIRST.index(item.path.stem) if item.path.stem in FIRST else len(FIRST))


def pytest_xdist_auto_num_workers(config) -> int:
    """Processes that `make test` shares its work among: each has OpenGL, textures and levels of its own in memory."""
    return min(os.cpu_count() or 1, 4)


@pytest.fixture(scope="session", autouse=True)
def own_cache(tmp_path_factory):
    """What is kept between starts goes to a folder of this run: no test reads or writes the user's."""
    before = os.environ.get("SHOREWRIGHT_CACHE")
    base = tmp_path_factory.getbasetemp()
    made = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "made"  # all processes share one
    made.mkdir(exist_ok=True)
    os.environ["SHOREWRIGHT_CACHE"] = str(made)
    yield
    if before is None:
        del os.environ["SHOREWRIGHT_CACHE"]
    else:
        os.environ["SHOREWRIGHT_CACHE"] = before


@pytest.fixture(scope="session")
def ctx():
    """One OpenGL 4.1 context for all tests; without one they skip, unless SHOREWRIGHT_EXPECT_GL demands it."""
    import moderngl

    try:
        context = moderngl.create_standalone_context(require=410, backend="egl")
    except Exception as error:
        if os.environ.get("SHOREWRIGHT_EXPECT_GL"):
            raise
        pytest.skip(f"no OpenGL 4.1 here: {error}")
    yield context
    gc.collect()
    context.release()


@pytest.fixture(scope="module")
def renderer(ctx):
    """A renderer of that context, one a module."""
    from shorewright.renderer import Renderer

    made = Renderer(ctx)
    yield made
    made.release()


@pytest.fixture(scope="session")
def data_dir():
    """The folder of real files beside the project; tests that need it skip where it is missing."""
    if not DATA.is_dir():
        pytest.skip("the folder of real files (../shared/data) is not beside the project")
    return DATA


@pytest.fixture
def beach_level():
    return make_beach()


@pytest.fixture
def flat_level():
    from shorewright.level import Grid, Level

    return Level(Grid(300, 260), np.full((300, 260), 2.0, np.float32))


@pytest.fixture(scope="session")
def display():
    """A display of its own; without Xvfb these tests skip, unless SHOREWRIGHT_EXPECT_GL demands it."""
    if shutil.which("Xvfb") is None:
        if os.environ.get("SHOREWRIGHT_EXPECT_GL"):
            pytest.fail("Xvfb is missing, and SHOREWRIGHT_EXPECT_GL demands the window")
        pytest.skip("Xvfb is missing, so no window can be opened")
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp", "-noreset"]
    server = subprocess.Popen(command, pass_fds=(write,), stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as answer:
        number = answer.readline().strip()
    yield f":{number}"
    server.terminate()
    server.wait(timeout=20)


@pytest.fixture(scope="session")
def shader_cache():
    """Where OpenGL's driver keeps compiled shaders: one folder a run, for a window's folders begin empty."""
    return Path(os.environ["SHOREWRIGHT_CACHE"]) / "shaders"


@pytest.fixture
def drive(display, shader_cache, tmp_path):
    """`drive(scenario)` runs it on a level in a temporary folder and returns its record; files go nowhere else."""
    from shorewright import io
    from shorewright.level.framing import cameras

    level = make_beach(rows=193, cols=225, slope=0.05)
    for camera in cameras(level):
        level.put_object(camera.id, camera)
    path = tmp_path / "beach.shore"
    io.write_level(level, path)

    def run(scenario: str, code: int = 0, by: str = "window_drive.py") -> dict:
        record = tmp_path / f"{scenario}.json"
        places = {f"XDG_{kind}_HOME": str(tmp_path / kind.lower()) for kind in ("STATE", "CONFIG", "CACHE")}
        shaders = {name: str(shader_cache) for name in ("MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR")}
        env = {**os.environ, **places, **shaders, "DISPLAY": display, "LIBGL_ALWAYS_SOFTWARE": "1"}
        env.pop("WAYLAND_DISPLAY", None)
        done = subprocess.run(
            [sys.executable, str(TESTS / by), scenario, str(path), str(record)],
            env=env, capture_output=True, text=True, timeout=600, cwd=TESTS,
        )  # fmt: skip
        assert done.returncode == code, done.stderr[-4000:]
        assert record.exists(), done.stderr[-4000:]
        return json.loads(record.read_text())

    run.path, run.state = path, tmp_path / "state"
    return run
