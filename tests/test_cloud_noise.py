"""The noises of clouds: they tile, use their range, come again by seed; curl has no divergence (Z01)."""

import numpy as np
import pytest
from shorewright.level.cloud_noise import CLOUD_NOISES, SHAPE_CELLS, curl_field, perlin_slice


@pytest.fixture(scope="module")
def noises():
    return {name: make(7) for name, make in CLOUD_NOISES.items()}


@pytest.mark.parametrize("name", CLOUD_NOISES)
def test_noise_has_no_seam(noises, name):
    """Z01: from the last sample to the first it changes as much as inside, on every axis and channel (0.9 to 1.1)."""
    values = noises[name].astype(np.float64)
    for axis in range(values.ndim - 1):
        steps = np.abs(np.roll(values, -1, axis) - values)
        edge = np.take(steps, -1, axis).reshape(-1, values.shape[-1]).mean(0)
        inside = np.take(steps, range(values.shape[axis] - 1), axis)
        means = inside.reshape(*inside.shape[: values.ndim - 1], -1).mean(
            tuple(a for a in range(values.ndim - 1) if a != axis)
        )
        # what single planes inside vary by is no seam
        low, high = means.min(0), means.max(0)
        ratio = edge / means.mean(0)
        assert ((ratio > 0.9) & (ratio < 1.1) | ((edge >= 0.97 * low) & (edge <= 1.03 * high))).all(), (axis, ratio)


@pytest.mark.parametrize("name", CLOUD_NOISES)
def test_noise_uses_its_range_and_comes_again(noises, name):
    values = noises[name]
    assert values.dtype == np.uint8
    low, high = np.percentile(values.reshape(-1, values.shape[-1]), (1, 99), axis=0)
    assert (high - low >= 0.6 * 255).all()
    assert np.array_equal(values, CLOUD_NOISES[name](7))
    assert not np.array_equal(values, CLOUD_NOISES[name](8))


def test_octaves_double(noises):
    """Each Worley channel of the shape has its strongest waves at about twice the frequency of the one before."""
    peaks = []
    for channel in (1, 2, 3):
        values = noises["u_cloud_shape"][..., channel].astype(np.float64)
        power = np.abs(np.fft.fftn(values - values.mean())) ** 2
        k = np.fft.fftfreq(128, 1 / 128)
        radius = np.sqrt(k[:, None, None] ** 2 + k[None, :, None] ** 2 + k[None, None, :] ** 2).round().astype(int)
        spectrum = np.bincount(radius.ravel(), power.ravel())[:64]
        peaks.append(int(spectrum.argmax()))
    assert [p / q for p, q in zip(peaks[1:], peaks[:-1], strict=True)] == pytest.approx([2, 2], rel=0.3)
    assert peaks[0] == pytest.approx(SHAPE_CELLS[0], abs=2)


def test_worley_dilates_perlin(noises):
    """Perlin-Worley holds its Worley fBm: nowhere lower but for the stretch to the full range (Z01, Z21)."""
    shape = noises["u_cloud_shape"].astype(np.float64)
    from scipy.stats import spearmanr

    some = slice(None, None, 9)
    assert spearmanr(shape[some, some, some, 0].ravel(), shape[some, some, some, 1].ravel()).statistic > 0.5
    slice_of = shape[int(0.37 * 128), ..., 0].ravel()
    assert spearmanr(slice_of, perlin_slice(7).ravel()).statistic > 0.3


def test_curl_has_no_divergence():
    """Z01: central differences, against the root mean square of the gradient, under 1e-2 on the torus."""
    field = curl_field(7)
    east, north = field[..., 0], field[..., 1]

    def along(values, axis):
        return (np.roll(values, -1, axis) - np.roll(values, 1, axis)) / 2

    divergence = along(east, 1) + along(north, 0)
    gradient = np.sqrt(np.mean([along(v, a) ** 2 for v in (east, north) for a in (0, 1)]))
    assert np.abs(divergence).max() < 1e-2 * gradient
