"""Light along parts of lines of sight: `Sky.segment`."""

import numpy as np
import pytest
import skyprobe as sp

WAVELENGTHS_NM = np.array([450.0, 550.0, 650.0])


@pytest.fixture(scope="module")
def sky():
    return sp.Sky.with_sun(altitude_deg=35.0, azimuth_deg=120.0, atmosphere=sp.Atmosphere(visibility_km=20.0, quality="draft"))


def directions(*angles_deg):
    altitudes, azimuths = np.radians(np.array(angles_deg)).T
    return np.stack([np.cos(altitudes) * np.sin(azimuths), np.cos(altitudes) * np.cos(azimuths), np.sin(altitudes)], axis=-1)


def test_the_end_of_the_line_is_the_sky(sky):
    towards = directions((90, 0), (30, 10), (1, 200), (12, 300))
    transmittance, radiance = sky.segment(towards, [0.0, np.inf, 2e7], WAVELENGTHS_NM)
    assert transmittance.shape == radiance.shape == (4, 3, 3)
    assert np.all(radiance[:, 0] == 0.0) and np.all(transmittance[:, 0] == 1.0)
    assert np.allclose(radiance[:, 1], sky.spectral_radiance(towards, WAVELENGTHS_NM), rtol=1e-5)
    assert np.array_equal(radiance[:, 1], radiance[:, 2])


def test_distances_may_come_in_any_order_and_do_not_disturb_one_another(sky):
    towards = directions((0.5, 40), (5, 250))
    distances = np.array([3e3, 50.0, 80e3, 3e3])
    together = sky.segment(towards, distances, WAVELENGTHS_NM)
    for index, distance in enumerate(distances):
        alone = sky.segment(towards, distance, WAVELENGTHS_NM)
        for one, other in zip(together, alone, strict=True):
            assert np.allclose(one[:, index], other[:, 0], rtol=1e-6)
    by_distance = np.argsort(distances)
    assert np.all(np.diff(together[0][:, by_distance], axis=1) <= 0) and np.all(np.diff(together[1][:, by_distance], axis=1) >= 0)


def test_a_dark_hill_at_the_visibility_keeps_two_hundredths_of_its_contrast(sky):
    transmittance, radiance = sky.segment(directions((0, 300)), [20e3], [550.0])
    # The haze thins out above a line that leaves the curved ground by 31 m.
    assert transmittance[0, 0, 0] == pytest.approx(0.02, rel=0.05)
    horizon = sky.spectral_radiance(directions((0, 300)), [550.0])
    assert 0.9 < radiance[0, 0, 0] / horizon[0, 0] < 1.05


def test_transmittances_of_two_parts_multiply():
    air = sp.Atmosphere(quality="draft")
    up = [[0.0, 0.0, 1.0]]
    low, high = (sp.Sky.with_sun(altitude_deg=50.0, azimuth_deg=0.0, elevation_m=height, atmosphere=air) for height in (0.0, 3000.0))
    first, _ = low.segment(up, [3000.0, 9000.0], WAVELENGTHS_NM)
    second, _ = high.segment(up, [6000.0], WAVELENGTHS_NM)
    assert np.allclose(first[0, 0] * second[0, 0], first[0, 1], rtol=1e-6)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (([[0, 0, 2.0]], [1.0], [550.0]), "directions"),
        (([[0, 0, 1.0]], [1.0, -1.0], [550.0]), r"distances_m\[1\] = -1"),
        (([[0, 0, 1.0]], [np.nan], [550.0]), r"distances_m\[0\] = NaN"),
        (([[0, 0, 1.0]], [1.0], [200.0]), "wavelengths_nm"),
    ],
)
def test_bad_input_is_named(sky, arguments, message):
    with pytest.raises(sp.InputError, match=message):
        sky.segment(*arguments)
