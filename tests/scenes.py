"""A coast and a camera that the renderer's tests share."""

import numpy as np
from shorewright.level import Grid, Level
from shorewright.level.objects import Camera

SIZE = (128, 72)
SEA_BLUE = np.array([0.1, 0.35, 0.75], np.float32)  # the material view's colour of the sea


def coast(slope=0.08, side=257, rock=0.0):
    """A beach that rises to the north, its waves in step, with a rock of that many metres in the water."""
    y, x = np.mgrid[0:side, 0:side].astype(np.float64)
    height = (y - 0.55 * side) * slope + rock * np.exp(-((x - 150) ** 2 + (y - 120) ** 2) / 90)
    level = Level(Grid(side, side), height.astype(np.float32))
    level.set("shore.sway", 0.0)
    return level


def camera(x=128.0, y=60.0, z=30.0, yaw=10.0, pitch=-30.0, fov=50.0):
    return Camera(id="c", x=x, y=y, z=z, yaw_deg=yaw, pitch_deg=pitch, fov_deg=fov)


def is_sea(material):
    """True where the material view, linear, shows sea."""
    return np.abs(material - SEA_BLUE).max(axis=-1) < 0.01
