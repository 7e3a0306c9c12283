"""Cameras as matrices: float64, camera-relative (the view matrix only turns), far plane at infinity.

Depth is the ordinary one (near −1, infinity +1 in clip space, GL 4.1 has no glClipControl); what reads depth uses the
linear eye depth of the G-buffer instead.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..level import Level
from ..level.objects import Camera
from ..level.pick import pick_ray

NEAR_M = 0.1
INFINITY = 2.0**-20  # keeps points at infinity just inside the far plane


@dataclass(frozen=True)
class Matrices:
    """`view` (3, 3) turns world to eye (x right, y up, z back); `projection` (4, 4); `position` (3,) world metres."""

    view: np.ndarray
    projection: np.ndarray
    position: np.ndarray
    near_m: float
    ray_centre: np.ndarray  # world direction of the picture's centre, one metre of eye depth long
    ray_x: np.ndarray  # what to add to it for one unit of clip-space x
    ray_y: np.ndarray

    @property
    def view_projection(self) -> np.ndarray:
        """Clip from camera-relative world positions, (4, 4)."""
        turn = np.eye(4)
        turn[:3, :3] = self.view
        return self.projection @ turn

    @property
    def planes(self) -> np.ndarray:
        """Near, left, right, bottom, top as (5, 4): a camera-relative point p is inside where `p·n + d ≥ 0`."""
        m = self.view_projection
        planes = np.stack([m[3] + m[2], m[3] + m[0], m[3] - m[0], m[3] + m[1], m[3] - m[1]])
        return planes / np.linalg.norm(planes[:, :3], axis=1, keepdims=True)

    def ray(self, px: float, py: float, size: tuple[int, int]) -> np.ndarray:
        """World direction through a pixel position, (0, 0) the top left corner of the picture; unit length."""
        x, y = 2 * px / size[0] - 1, 1 - 2 * py / size[1]
        ray = self.ray_centre + x * self.ray_x + y * self.ray_y
        return ray / np.linalg.norm(ray)


def axes(camera: Camera) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Right, up and forward of a camera, unit vectors in world axes."""
    yaw, pitch = math.radians(camera.yaw_deg), math.radians(camera.pitch_deg)
    right = np.array([math.cos(yaw), -math.sin(yaw), 0.0])
    forward = np.array([math.sin(yaw) * math.cos(pitch), math.cos(yaw) * math.cos(pitch), math.sin(pitch)])
    return right, np.cross(right, forward), forward


def camera_matrices(
    camera: Camera, size: tuple[int, int], near_m: float = NEAR_M, jitter: tuple[float, float] = (0.0, 0.0)
) -> Matrices:
    """Matrices for a picture of `size` (width, height); `jitter` moves it by parts of a pixel, right and up."""
    right, up, forward = axes(camera)
    tan_y = math.tan(math.radians(camera.fov_deg) / 2)
    tan_x = tan_y * size[0] / size[1]
    offset = 2 * jitter[0] / size[0], 2 * jitter[1] / size[1]
    projection = np.zeros((4, 4))
    projection[0, 0], projection[1, 1] = 1 / tan_x, 1 / tan_y
    projection[0, 2], projection[1, 2] = -offset[0], -offset[1]
    projection[2, 2], projection[2, 3] = INFINITY - 1, (INFINITY - 2) * near_m
    projection[3, 2] = -1.0
    return Matrices(
        view=np.stack([right, up, -forward]),
        projection=projection,
        position=np.array([camera.x, camera.y, camera.z]),
        near_m=near_m,
        ray_centre=forward - offset[0] * tan_x * right - offset[1] * tan_y * up,
        ray_x=tan_x * right,
        ray_y=tan_y * up,
    )


def jitter(index: int, samples: int) -> tuple[float, float]:
    """Where sample `index` of a picture stands from its pixel's middle, in pixels, mean 0 (R2, M. Roberts, 2018)."""
    if samples <= 1:
        return 0.0, 0.0
    points = np.arange(samples)[:, None] * (0.7548776662466927, 0.5698402909980532) % 1.0
    x, y = points[index] - points.mean(axis=0)
    return float(x), float(y)


def pick(level: Level, camera: Camera, size: tuple[int, int], px: float, py: float):
    """The ground point (x, y, z) under a pixel position, None where the ray misses the level."""
    matrices = camera_matrices(camera, size)
    return pick_ray(level, matrices.position, matrices.ray(px, py, size))
