"""TEMPORARY"""

from dataclasses import dataclass

import numpy as np
import skfmm
from scipy import ndimage


@dataclass
class TT:
    seconds: object
    reached: object
    plane: object
    c: object


def k_of(w, h):
    a = w * w * h / 9.81
    k = a / np.sqrt(np.tanh(a)) / h
    for _ in range(3):
        t = np.tanh(k * h)
        k -= (9.81 * k * t - w * w) / (9.81 * t + 9.81 * k * h * (1 - t * t))
    return k


def solve(depth, cell, P, heading, least_depth_m=0.3):
    w = 2 * np.pi / P
    e, n = np.sin(np.radians(heading)), np.cos(np.radians(heading))
    pad = max(depth.shape) // 2
    d = np.pad(depth.astype(float), pad, mode="edge")
    ref = max(depth[0].max(), depth[-1].max(), depth[:, 0].max(), depth[:, -1].max(), 1)
    c = w / k_of(w, np.maximum(d, least_depth_m))
    cref = w / k_of(w, ref)
    y, x = np.mgrid[0 : d.shape[0], 0 : d.shape[1]]
    X = (x - pad) * cell
    Y = (y - pad) * cell
    pl = (e * X + n * Y) / cref
    deep = d > 0.95 * ref
    t0 = pl[deep].min() + 3 * cell / cref
    phi = (pl - t0) * cref
    try:
        T = skfmm.travel_time(np.ma.MaskedArray(phi, (d <= 0)), c, dx=cell, order=1)
        m = np.ma.getmaskarray(T)
        T = np.where(m, 1e9, np.ma.filled(T, 1e9))
    except ValueError:
        T = np.full(d.shape, 1e9)
    T = np.where(phi < 0, -T, T) + t0
    ok = np.abs(T) < 1e8
    T = T[pad:-pad, pad:-pad]
    ok = ok[pad:-pad, pad:-pad]
    if not ok.any():
        return TT(pl[pad:-pad, pad:-pad].astype("f4"), ok, (e / cref, n / cref), c[pad:-pad, pad:-pad])
    r, cc = ndimage.distance_transform_edt(~ok, return_distances=False, return_indices=True)
    return TT(T[r, cc].astype("f4"), ok, (e / cref, n / cref), c[pad:-pad, pad:-pad])
