"""The measuring instruments of the tests, measured themselves."""

import analysis
import numpy as np
import pytest
from scene_geometry import angle_between_azimuths_deg, load_scene, pixel_rays

CAMERA = load_scene()["top_camera"]


@pytest.mark.parametrize("rows", ["centre", "corner"])
def test_all_pixels_together_make_the_sphere(rows):
    assert 64 * analysis.pixel_solid_angles(32, 64, rows).sum() == pytest.approx(4.0 * np.pi, rel=1e-12)


@pytest.mark.parametrize("rows", ["centre", "corner"])
@pytest.mark.parametrize("height", [31, 32])
def test_a_uniform_sky_gives_pi(rows, height):
    assert analysis.horizontal_irradiance(np.ones((height, 64, 3)), rows) == pytest.approx(np.full(3, np.pi), rel=1e-12)


@pytest.mark.parametrize("rows", ["centre", "corner"])
def test_a_sky_like_the_cosine_gives_two_thirds_of_pi(rows):
    pixels = np.maximum(analysis.pixel_directions(256, 512, rows)[..., 2:], 0.0).repeat(3, axis=2)
    assert analysis.horizontal_irradiance(pixels, rows) == pytest.approx(np.full(3, 2.0 / 3.0 * np.pi), rel=1e-4)


@pytest.mark.parametrize(("u", "direction"), [(0.25, [0, 1, 0]), (0.5, [1, 0, 0]), (0.75, [0, -1, 0])])
def test_columns_are_north_east_south(u, direction):
    directions = analysis.pixel_directions(513, 512, "corner")[256]
    column = int(u * 512)
    between = 0.5 * (directions[column - 1] + directions[column])
    np.testing.assert_allclose(between, direction, atol=1e-4)


def painted_shadow(azimuth_deg, noise=0.05):
    """A picture of a lit plane with a straight shadow as wide as one and a half pixels."""
    origins, _ = pixel_rays(CAMERA)
    east, north = origins[..., 0], origins[..., 1]
    sine, cosine = np.sin(np.radians(azimuth_deg)), np.cos(np.radians(azimuth_deg))
    along, across = east * sine + north * cosine, east * cosine - north * sine
    covered = np.clip((0.03 + 0.02 - np.abs(across)) / 0.04, 0.0, 1.0) * ((along > 0.0) & (along < 2.4))
    light = (1.0 - 0.7 * covered) * np.random.default_rng(1).normal(1.0, noise, east.shape)
    return np.repeat(light[..., None], 3, axis=2)


@pytest.mark.parametrize("azimuth_deg", [0.0, 33.3, 90.0, 181.0, 271.5, 359.0])
def test_a_painted_shadow_is_found_where_it_was_painted(azimuth_deg):
    found = analysis.shadow_azimuth_deg(painted_shadow(azimuth_deg), CAMERA)
    assert angle_between_azimuths_deg(found, azimuth_deg) < 0.15


def test_the_shadow_check_complains_about_one_degree():
    picture = painted_shadow(121.0)
    analysis.check_shadow(picture, CAMERA, 301.0)
    with pytest.raises(AssertionError, match="deg off"):
        analysis.check_shadow(picture, CAMERA, 300.0)


def test_no_shadow_and_two_shadows_are_refused():
    with pytest.raises(analysis.NoShadow):
        analysis.shadow_azimuth_deg(np.ones((200, 200, 3)), CAMERA)
    with pytest.raises(analysis.NoShadow):
        analysis.shadow_azimuth_deg(painted_shadow(10.0) * painted_shadow(80.0), CAMERA)


def test_the_relative_difference_is_in_units_of_the_mean():
    first = np.full((4, 4, 3), 2.0)
    assert analysis.relative_rms(first, first * 1.02, np.ones((4, 4), bool)) == pytest.approx(np.full(3, 0.02 / 1.01))


def test_halving_keeps_the_mean_and_only_whole_blocks():
    picture = np.arange(4.0 * 6.0 * 3.0).reshape(4, 6, 3)
    mask = np.ones((4, 6), bool)
    mask[0, 0] = False
    small, small_mask = analysis.halved(picture, mask)
    assert small.shape == (2, 3, 3) and small.mean() == picture.mean()
    np.testing.assert_allclose(small[0, 0], picture[:2, :2].mean(axis=(0, 1)))
    assert not small_mask[0, 0] and small_mask.sum() == 5
