"""Large levels go through exports and checks some rows at a time (T09): the memory of a process, by the system."""

import json
import subprocess
import sys

import pytest

SPARE_BYTES = 20_000_000  # modules that load late, pages that the allocator keeps
MEASURE = """
import json, resource, sys
import numpy as np
import OpenImageIO, scipy.ndimage, trimesh
from shorewright.io import check, export
from shorewright.level import Grid, Level
from shorewright.level.timing import map_rows

def peak():
    with open("/proc/self/clear_refs", "w") as file:
        file.write("5")
    def now():
        with open("/proc/self/status") as file:
            return next(int(line.split()[1]) for line in file if line.startswith("VmHWM"))
    begun = now()
    return lambda: (now() - begun) * 1024

side, only = int(sys.argv[1]), sys.argv[2].split(",")
north, east = np.mgrid[0:side, 0:side].astype(np.float32)
level = Level(Grid(side, side), np.float32(0.03) * north - 10 + np.sin(east / 40) + np.sin(north / 25))
del north, east
map_rows(level, 0.0, slice(0, 16))  # the waves' own maps are of one size for all large levels
written = peak()
export(level, "raw", sys.argv[3], only, "bay")
written, read = written(), peak()
findings = check(sys.argv[3])
print(json.dumps({"level": level.height.nbytes, "written": written, "read": read(), "findings": findings}))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the system tells a process' peak under Linux")
@pytest.mark.parametrize(("only", "most"), [("arrival,front_phase", 2.0), ("height,normals", 2.0)])
def test_a_large_level_takes_no_copies_of_itself(tmp_path, only, most):
    """Three floats a sample are made, written, read back and checked in fewer bytes than those: no map lies whole."""
    command = [sys.executable, "-c", MEASURE, "2049", only, str(tmp_path / "out")]
    found = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    assert found["findings"] == []
    assert found["written"] < most * found["level"] + SPARE_BYTES
    assert found["read"] < most * found["level"] + SPARE_BYTES
