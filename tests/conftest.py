"""Fixtures that every room shares: one OpenGL context, two small levels, the folder of real files."""

import gc
import os
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

DATA = Path(__file__).parents[2] / "shared" / "data"


# The slowest files begin: two processes share the files, and one that begins last is waited for.
FIRST = ("test_window", "test_goldens", "test_shaping_coasts", "test_renderer_surface", "test_views", "test_slow_map",
         "test_sample_levels", "test_renderer", "test_shots")  # fmt: skip


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


@pytest.fixture
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
