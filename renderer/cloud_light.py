"""The light that reaches clouds in volume (Z17), and how it goes on while a live picture remembers them (Z16)."""

from __future__ import annotations

import math

import numpy as np

from .sky_light import SkyLight

UNDER_CLOUD = 0.6  # of the light that the ground gives back: part of it lies in their shadow
SUN_SHARE, SKY_SHARE = 1 / (4 * math.pi), 0.5  # of sunlight that a cloud sends each way, of light from above and below


def light_uniforms(sky: SkyLight) -> dict:
    """The sun on the clouds, and the light from above and from below, as radiance."""
    c = sky.harmonics
    up = c[0] * 0.282095 + c[6] * 0.630784
    below = (up - c[2] * 0.488603) * (1.0 if sky.even else UNDER_CLOUD)
    return {
        "u_cloud_sun": tuple(float(v) for v in sky.disc),
        "u_cloud_above": tuple(float(v) for v in sky.above),
        "u_cloud_below": tuple(float(v) for v in np.maximum(below, 0.0) / np.pi),
    }


def on_clouds(sky: SkyLight) -> np.ndarray:
    """About what clouds give back of sun, sky and ground, `(3,)`: remembered light goes on with it as a day does.

    They are lit by a sum that differs from pixel to pixel; its mean takes away the step between parts of an image.
    """
    sun, above, below = map(np.array, light_uniforms(sky).values())
    return sun * SUN_SHARE + (above + below) * SKY_SHARE + 1e-12
