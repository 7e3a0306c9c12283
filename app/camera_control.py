"""Moving the editor's camera: orbit, pan, zoom, fly, frame. Pure maths on frozen `Camera` objects, no window.

Angles in degrees, lengths in metres, pointer movements in pixels (x right, y down).
"""

from __future__ import annotations

import math
from collections.abc import Collection

import numpy as np

from ..level import Level
from ..level.objects import Camera
from ..level.pick import ground_at
from ..renderer.camera import axes, camera_matrices

TURN_DEG_PER_PX = 0.25
ZOOM_PER_NOTCH = 0.84
CLOSEST_M = 0.4  # zooming stops this far from what it goes to
PITCH_DEG = (-89.5, 80.0)
FARTHEST_M = 60_000.0
FLY_KEYS = {"w": (0, 0, 1), "s": (0, 0, -1), "d": (1, 0, 0), "a": (-1, 0, 0), "e": (0, 1, 0), "q": (0, -1, 0)}


def moved(camera: Camera, position, yaw_deg: float | None = None, pitch_deg: float | None = None) -> Camera:
    """The same camera elsewhere; angles are wrapped and clamped, the place is kept within `FARTHEST_M`."""
    x, y, z = (float(min(max(v, -FARTHEST_M), FARTHEST_M)) for v in position)
    yaw_deg = camera.yaw_deg if yaw_deg is None else yaw_deg
    pitch_deg = camera.pitch_deg if pitch_deg is None else pitch_deg
    pitch_deg = min(max(pitch_deg, PITCH_DEG[0]), PITCH_DEG[1])
    return camera.model_copy(update={"x": x, "y": y, "z": z, "yaw_deg": yaw_deg % 360 % 360, "pitch_deg": pitch_deg})


def place(camera: Camera) -> np.ndarray:
    """Where a camera stands, (3,) metres."""
    return np.array([camera.x, camera.y, camera.z])


def turn(camera: Camera, dx_px: float, dy_px: float) -> Camera:
    """Look around: the picture follows the pointer's way, the camera stays where it is."""
    yaw, pitch = camera.yaw_deg + dx_px * TURN_DEG_PER_PX, camera.pitch_deg - dy_px * TURN_DEG_PER_PX
    return moved(camera, place(camera), yaw, pitch)


def orbit(camera: Camera, pivot, dx_px: float, dy_px: float) -> Camera:
    """Go round a world point (3,) that stays where it is in the picture; the horizon stays level."""
    turned = turn(camera, dx_px, dy_px)
    local = np.stack(axes(camera)) @ (np.asarray(pivot, np.float64) - place(camera))
    return moved(turned, np.asarray(pivot, np.float64) - np.stack(axes(turned)).T @ local)


def pan(camera: Camera, pivot, dx_px: float, dy_px: float, size: tuple[int, int]) -> Camera:
    """Slide so that a world point (3,) follows the pointer across a picture of `size` (width, height)."""
    right, up, forward = axes(camera)
    depth = max(float((np.asarray(pivot) - place(camera)) @ forward), CLOSEST_M)
    metres_per_px = 2 * depth * math.tan(math.radians(camera.fov_deg) / 2) / max(size[1], 1)
    return moved(camera, place(camera) + (up * dy_px - right * dx_px) * metres_per_px)


def zoom(camera: Camera, point, notches: float) -> Camera:
    """Go towards (or, negative, away from) a world point (3,), which keeps its place in the picture."""
    way = np.asarray(point, np.float64) - place(camera)
    distance = float(np.linalg.norm(way))
    if distance < 1e-6:
        return camera
    left = max(distance * ZOOM_PER_NOTCH**notches, CLOSEST_M if notches > 0 else 0.0)
    left = max(left, CLOSEST_M) if distance > CLOSEST_M else left
    return moved(camera, np.asarray(point) - way / distance * left)


def fly(camera: Camera, keys: Collection[str], seconds: float, speed_mps: float) -> Camera:
    """Move for some seconds with keys held: w a s d along the view, q and e straight down and up."""
    held = [FLY_KEYS[key] for key in keys if key in FLY_KEYS]
    if not held or seconds <= 0:
        return camera
    right, _, forward = axes(camera)
    side, rise, ahead = np.sum(held, axis=0)
    way = right * side + forward * ahead + np.array([0.0, 0.0, 1.0]) * rise
    length = float(np.linalg.norm(way))
    return camera if length < 1e-9 else moved(camera, place(camera) + way / length * speed_mps * seconds)


def fly_speed_mps(level: Level, camera: Camera, preferred_mps: float = 15.0) -> float:
    """A speed that suits how high the camera stands over ground or sea: slow at the swash, `preferred` at 16 m."""
    ground = max(float(ground_at(level, camera.x, camera.y)), level.sea_level_m)
    return min(max(abs(camera.z - ground) / 16, 0.25), max(level.grid.extent_m) / 32 + 0.25) * preferred_mps


def above_ground(level: Level, camera: Camera, clearance_m: float = 0.35) -> Camera:
    """The same camera lifted out of the ground (not out of the water: one may dive)."""
    floor = float(ground_at(level, camera.x, camera.y)) + clearance_m
    return camera if camera.z >= floor else moved(camera, (camera.x, camera.y, floor))


def pivot_ahead(level: Level, camera: Camera, point=None) -> np.ndarray:
    """What to turn about, (3,): a picked point, else where the view meets the sea's plane, else a spot ahead."""
    if point is not None:
        return np.asarray(point, np.float64)
    _, _, forward = axes(camera)
    reach = max(level.grid.extent_m)
    distance = reach / 2
    if forward[2] < -1e-3:
        distance = (level.sea_level_m - camera.z) / forward[2]
    return place(camera) + forward * min(max(distance, 2.0), reach)


def between(start: Camera, end: Camera, part: float) -> Camera:
    """A camera on the way from one to another, `part` 0 … 1, eased at both ends; yaw goes the short way."""
    part = min(max(part, 0.0), 1.0)
    part = part * part * (3 - 2 * part)
    yaw = start.yaw_deg + ((end.yaw_deg - start.yaw_deg + 180) % 360 - 180) * part
    pitch = start.pitch_deg + (end.pitch_deg - start.pitch_deg) * part
    fov = start.fov_deg + (end.fov_deg - start.fov_deg) * part
    camera = moved(end, place(start) + (place(end) - place(start)) * part, yaw, pitch)
    return camera.model_copy(update={"fov_deg": fov})


def to_screen(camera: Camera, size: tuple[int, int], points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pixels (n, 2) of world points (n, 3) in a picture of `size`, and which of them lie before the camera (n,)."""
    matrices = camera_matrices(camera, size)
    eye = (np.asarray(points, np.float64) - matrices.position) @ matrices.view.T
    depth = -eye[:, 2]
    ahead = depth > matrices.near_m
    safe = np.where(ahead, depth, 1.0)
    clip = eye[:, :2] * np.array([matrices.projection[0, 0], matrices.projection[1, 1]]) / safe[:, None]
    return (np.stack([clip[:, 0], -clip[:, 1]], axis=1) * 0.5 + 0.5) * np.array(size, np.float64), ahead
