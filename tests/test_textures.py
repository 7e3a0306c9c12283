"""The generated textures tile, are seeded and keep what the shaders count on (D04, H18, L07)."""

import numpy as np
import pytest
from shorewright.level.ground_textures import ground_textures
from shorewright.level.textures import (
    equalise,
    foam_texture,
    noise_texture,
    ocean_amplitude,
    ripple_texture,
    spectral_noise,
    worley,
)

MAKERS = {"foam": foam_texture, "noise": noise_texture, "ground": ground_textures, "ripple": ripple_texture}


@pytest.mark.parametrize("name", MAKERS)
def test_the_seed_alone_decides(name):
    make = MAKERS[name].__wrapped__  # past the cache
    first = make(128, 3)
    assert np.array_equal(first, make(128, 3))
    assert not np.array_equal(first, make(128, 4))


@pytest.mark.parametrize("name", MAKERS)
def test_textures_tile(name):
    """Across the border neighbours differ no more than inside: there is no seam."""
    texture = MAKERS[name](256).astype(float)
    texture = texture.reshape(-1, 256, 256, 4)
    for axis in (1, 2):
        steps = np.abs(texture - np.roll(texture, 1, axis))
        seam = steps.take(0, axis).mean((0, 1))
        inside = steps.mean((0, 1, 2))
        assert (seam < 1.6 * inside + 1e-6).all()


@pytest.mark.parametrize("channel", [0, 1, 2])
@pytest.mark.parametrize("amount", [0.1, 0.4, 0.8])
def test_foam_covers_what_is_asked(channel, amount):
    """H18: a threshold at 1 − amount leaves `amount` of the tile, whatever the density."""
    fields = foam_texture()[..., channel] / 255
    assert (fields > 1 - amount).mean() == pytest.approx(amount, abs=0.01)


def test_thin_foam_is_lace_and_dense_foam_has_holes():
    """Lace is threads: what covers a fifth of the water is gone when worn by two texels; dense foam is not."""
    foam = foam_texture() / 255

    def worn(mask, times=2):
        for _ in range(times):
            mask = mask & np.roll(mask, 1, 0) & np.roll(mask, -1, 0) & np.roll(mask, 1, 1) & np.roll(mask, -1, 1)
        return mask.mean()

    lace, dense = foam[..., 0] > 0.8, foam[..., 2] > 0.2
    assert worn(lace) < 0.5 * lace.mean()
    assert worn(dense) > 0.6 * dense.mean()


def test_ripples_carry_their_variance_through_mip_levels():
    """L07: slope² minus the squared mean slope is what a mip level lost; the whole is 1 at every level."""
    ripple = ripple_texture().astype(float)
    assert ripple[..., 2].mean() == pytest.approx(1, rel=1e-3)
    half = ripple.reshape(16, 16, 16, 16, 4).mean((1, 3))
    kept = (half[..., 0] ** 2 + half[..., 1] ** 2).mean()
    lost = (half[..., 2] - half[..., 0] ** 2 - half[..., 1] ** 2).mean()
    assert kept + lost == pytest.approx(1, rel=1e-3)
    assert lost > 0.2
    assert np.abs(ripple[..., :2].mean((0, 1))).max() < 1e-3


def test_ripples_go_on_over_the_border_as_they_do_inside():
    """H16: an ocean's spectrum by FFT: height steps are the slopes' integral across the border too."""
    ripple = ripple_texture().astype(np.float64)
    slope, height, size = ripple[..., 0], ripple[..., 3], ripple.shape[0]
    for axis, slope in ((1, ripple[..., 0]), (0, ripple[..., 1])):
        # five-point integral of a band-limited field over one texel
        near = [np.roll(slope, n, axis) for n in (-2, -1, 0, 1)]
        step = (-near[0] + 13 * near[1] + 13 * near[2] - near[3]) / 24 / size
        wrong = np.abs(np.roll(height, -1, axis) - height - step)
        seam = wrong.take([-2, -1, 0], axis)
        assert seam.max() <= 1.2 * wrong.max()
        assert wrong.max() < 0.02 * np.abs(step).max()


def test_ripples_have_the_ocean_spectrum():
    """H16: the height's power falls as Phillips' spectrum, none at the ends of what the tile holds."""
    height = ripple_texture()[..., 3].astype(np.float64)
    size = height.shape[0]
    power = np.abs(np.fft.fft2(height)) ** 2
    ky, kx = np.meshgrid(*(np.fft.fftfreq(size, 1 / size),) * 2, indexing="ij")
    k = np.hypot(kx, ky)
    amplitude = ocean_amplitude(kx, ky, size)
    bands = [(k >= low) & (k < 1.5 * low) for low in (4.0, 6.0, 9.0, 13.5, 20.0)]
    strength = np.array([power[band].sum() / (amplitude[band] ** 2).sum() for band in bands])
    assert strength / strength.mean() == pytest.approx(np.ones(5), abs=0.4)  # few waves are long, each is drawn by lot
    falls = ocean_amplitude(np.array([20.0]), np.zeros(1), 4096) / ocean_amplitude(np.array([10.0]), np.zeros(1), 4096)
    assert np.log2(falls) == pytest.approx([-2.0], abs=0.1)
    assert power[k > 0.45 * size].max() < 1e-6 * power.max()
    along = power[(np.abs(kx) > 3 * np.abs(ky)) & (k > 4) & (k < 30)].mean()
    across = power[(np.abs(ky) > 3 * np.abs(kx)) & (k > 4) & (k < 30)].mean()
    assert along > 4 * across


def test_slopes_belong_to_the_height():
    ripple = ripple_texture().astype(float)
    height, size = ripple[..., 3], ripple.shape[0]
    east = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) * size / 2
    assert np.corrcoef(east.ravel(), ripple[..., 0].ravel())[0, 1] > 0.95


def test_noise_helpers():
    noise = spectral_noise(64, 1, 1.5)
    assert noise.std() == pytest.approx(1)
    first, second, _ = worley(64, 5, 1)
    assert (second >= first).all()
    ranks = equalise(noise)
    assert ranks.min() == 0
    assert ranks.max() == 1
    assert ranks.mean() == pytest.approx(0.5)
