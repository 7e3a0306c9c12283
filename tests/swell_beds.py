"""Beds with known answers for the tests of travel time and wave height."""

import numpy as np

# US Army Corps flume of the NTHMP benchmark problem 2, case A (see ../shared/data/README.md): still water 0.218 m deep,
# then slopes 1:53 over 4.36 m, 1:150 over 2.93 m, 1:13 over 0.90 m, a wall. Distances in metres after gauge 4.
FLUME_DEPTH_M = 0.218
FLUME_BREAKS_M = (2.40, 2.40 + 4.36, 2.40 + 4.36 + 2.93, 2.40 + 4.36 + 2.93 + 0.90)
FLUME_SLOPES = (1 / 53, 1 / 150, 1 / 13)
FLUME_GAUGES_M = (2.40, 4.58, 6.76, 8.22, 9.69, 10.14)  # gauges 5 to 10: breaks of the slope and the middles between
FLUME_MEASURED_S = (1.70, 3.15, 4.80, 6.00, 7.35, 7.90)
FLUME_ANALYTIC_S = (1.64, 3.28, 5.07, 6.26, 7.75, 8.20)


def plane_beach(side: int = 257, cell_m: float = 4.0, deep_m: float = 30.0, toe: float = 0.3, top: float = 0.95):
    """Depth (side, side): deep in the south up to `toe` of the way, then a plane slope to 0 at `top`, land beyond."""
    t = np.linspace(0, 1, side)
    profile = np.interp(t, [0, toe, top, 1], [deep_m, deep_m, 0.0, -deep_m * 0.05])
    return np.repeat(profile[:, None], side, axis=1), cell_m


def flume(cell_m: float = 0.01, cols: int = 5):
    """Depth (rows, cols) from gauge 4 northwards to the wall."""
    x = np.arange(0, FLUME_BREAKS_M[-1], cell_m)
    depth = np.full(x.shape, FLUME_DEPTH_M)
    for start, end, slope in zip(FLUME_BREAKS_M[:-1], FLUME_BREAKS_M[1:], FLUME_SLOPES, strict=True):
        depth -= slope * (np.clip(x, start, end) - start)
    return np.repeat(depth[:, None], cols, axis=1), cell_m


def rough_coast(side: int = 301, cell_m: float = 3.0):
    """A bay with a shoal, an island and a beach in the north."""
    y, x = np.mgrid[:side, :side] * cell_m
    depth = 18.0 - 18.0 * np.clip((y - 200 - 60 * np.sin(x / 130)) / 600, 0, 1.1)
    depth -= 9.0 * np.exp(-((x - 300) ** 2 + (y - 330) ** 2) / 80**2)
    depth -= 20.0 * np.exp(-((x - 620) ** 2 + (y - 450) ** 2) / 60**2)
    return depth, cell_m
