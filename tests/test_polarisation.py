"""Polarised light as Python shows it: the pattern of the clear sky, the filter, and what decides how finely it is gathered."""

from __future__ import annotations

import pathlib

import numpy
import pytest

import skyprobe as sp

GREEN = [550.0]


@pytest.fixture(scope="module")
def pure() -> sp.Atmosphere:
    return sp.Atmosphere(preset="pure", quality="draft")


@pytest.fixture(scope="module")
def sky(pure: sp.Atmosphere) -> sp.Sky:
    return sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=pure)


@pytest.fixture(scope="module")
def scalar_sky() -> sp.Sky:
    return sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=sp.Atmosphere(quality="draft", polarisation=False))


def direction(altitude_deg: float, azimuth_deg: float) -> numpy.ndarray:
    altitude, azimuth = numpy.radians(altitude_deg), numpy.radians(azimuth_deg)
    return numpy.array([numpy.cos(altitude) * numpy.sin(azimuth), numpy.cos(altitude) * numpy.cos(azimuth), numpy.sin(altitude)])


def test_intensity_is_the_radiance_and_the_pattern_is_symmetric_about_the_sun(sky: sp.Sky) -> None:
    looks = [(altitude, azimuth) for altitude in (10.0, 45.0, 80.0) for azimuth in (30.0, 75.0, 140.0)]
    left = sky.stokes([direction(a, 180.0 - b) for a, b in looks], [450.0, 500.5])
    right = sky.stokes([direction(a, 180.0 + b) for a, b in looks], [450.0, 500.5])
    assert left.shape == (9, 2, 3) and left.dtype == numpy.float64
    radiance = sky.spectral_radiance([direction(a, 180.0 - b) for a, b in looks], [450.0, 500.5])
    numpy.testing.assert_allclose(left[..., 0], radiance, rtol=1e-12)
    # The mirror image of a vibration leans the other way.
    numpy.testing.assert_allclose(right, left * [1.0, 1.0, -1.0], rtol=1e-4, atol=1e-4 * radiance.max())
    assert (numpy.hypot(left[..., 1], left[..., 2]) < left[..., 0]).all()


def test_at_right_angles_to_the_sun_clean_air_is_polarised_strongly_across_the_scattering_plane(sky: sp.Sky) -> None:
    sun = numpy.array(sky.sun.direction)
    across = numpy.cross(sun, [0.0, 0.0, 1.0])
    across /= numpy.linalg.norm(across)
    over = numpy.cross(across, sun)
    turns = numpy.radians([-70.0, -40.0, 0.0, 25.0, 60.0])
    looks = numpy.cos(turns)[:, None] * (over if over[2] > 0 else -over) + numpy.sin(turns)[:, None] * across
    i, q, u = sky.stokes(looks, GREEN)[:, 0].T
    degree = numpy.hypot(q, u) / i
    # Single scattering by air gives 0.94 (depolarisation); multiple scattering and the ground take the rest.
    assert (degree > 0.6).all() and (degree < 0.9).all(), degree
    assert (degree > 0.7).any(), degree
    angle = numpy.arctan2(u, q) / 2.0
    for look, vibration in zip(looks, angle, strict=True):
        azimuth, altitude = numpy.arctan2(look[0], look[1]), numpy.arcsin(look[2])
        up = numpy.array([-numpy.sin(altitude) * numpy.sin(azimuth), -numpy.sin(altitude) * numpy.cos(azimuth), numpy.cos(altitude)])
        right = numpy.array([numpy.cos(azimuth), -numpy.sin(azimuth), 0.0])
        electric = numpy.cos(vibration) * up + numpy.sin(vibration) * right
        normal = numpy.cross(look, sun)
        assert abs(electric @ normal) / numpy.linalg.norm(normal) > numpy.cos(numpy.radians(3.0))
    # In the Sun's vertical, opposite the Sun: the vibration is horizontal, Q negative and U nothing.
    assert q[2] / i[2] < -0.65 and abs(u[2] / i[2]) < 1e-3


def neutral_points(sky: sp.Sky, azimuth_deg: float) -> list[float]:
    """Altitudes in the vertical of `azimuth_deg` where Q changes its sign. [degrees]"""
    altitudes = numpy.arange(1.0, 89.0, 0.5)
    q = sky.stokes([direction(altitude, azimuth_deg) for altitude in altitudes], GREEN)[:, 0, 1]
    change = numpy.flatnonzero(q[:-1] * q[1:] < 0)
    return [float(altitudes[k] + 0.5 * q[k] / (q[k] - q[k + 1])) for k in change]


def test_the_neutral_points_of_arago_and_babinet_are_where_they_are_seen(pure: sp.Atmosphere) -> None:
    low = sp.Sky.with_sun(altitude_deg=5.0, azimuth_deg=180.0, atmosphere=pure)
    (babinet,) = [altitude for altitude in neutral_points(low, 180.0) if altitude > 5.0]
    assert 10.0 < babinet - 5.0 < 25.0, babinet
    (arago,) = neutral_points(low, 0.0)
    assert 15.0 < arago + 5.0 < 28.0, arago
    high = sp.Sky.with_sun(altitude_deg=40.0, azimuth_deg=180.0, atmosphere=pure)
    brewster = [altitude for altitude in neutral_points(high, 180.0) if altitude < 40.0]
    assert len(brewster) == 1 and 8.0 < 40.0 - brewster[0] < 30.0, brewster


def test_a_filter_shows_what_the_stokes_parameters_say(sky: sp.Sky) -> None:
    width = 256
    plain = sky.render(width=width, color_space="xyz", gamut="keep", sun_disc=False).pixels
    upright = sky.render(width=width, color_space="xyz", gamut="keep", sun_disc=False, polarising_filter=sp.PolarisingFilter()).pixels
    across = sp.PolarisingFilter(angle_deg=90.0)
    level = sky.render(width=width, color_space="xyz", gamut="keep", sun_disc=False, polarising_filter=across).pixels
    above = slice(1, width // 4 - 2)
    numpy.testing.assert_allclose((upright + level)[above] / 2.0, plain[above], rtol=2e-3)
    # The band at right angles to the Sun, north at 60 degrees of altitude: vibration is horizontal.
    row, column = width // 12, width // 4
    look = direction(90.0 - (row + 0.5) * 360.0 / width, (column + 0.5) * 360.0 / width - 90.0)
    i, q, _ = sky.stokes([look], [555.0])[0, 0]
    assert upright[row, column, 1] / plain[row, column, 1] == pytest.approx(1.0 + q / i, abs=0.04)
    assert upright[row, column, 1] < 0.4 * plain[row, column, 1] < 0.4 * level[row, column, 1]
    half = sky.render(width=width, color_space="xyz", gamut="keep", sun_disc=False, polarising_filter=sp.PolarisingFilter(strength=0.5))
    numpy.testing.assert_allclose(half.pixels[above], (plain + upright)[above] / 2.0, rtol=2e-3)


def test_a_held_filter_has_no_seam(sky: sp.Sky) -> None:
    held = sp.PolarisingFilter(angle_deg=20.0, held_towards_deg=(30.0, 90.0))
    pixels = sky.render(width=512, color_space="xyz", gamut="keep", sun_disc=False, polarising_filter=held).pixels[..., 1]
    upper = pixels[:124].astype(float)
    # From column to column, around the whole circle and so through both sides of the Sun's vertical.
    steps = numpy.abs(numpy.diff(upper, axis=1, append=upper[:, :1])) / upper
    # Close to the zenith and to the glass's own axis, at azimuths 90 and 270, a pixel is a large turn.
    assert steps[8:].max() < 0.08, numpy.unravel_index(steps[8:].argmax(), steps[8:].shape)
    top = upper[0]
    assert top.max() / top.min() < 1.05, "all directions at the zenith are one"
    with pytest.raises(sp.InputError, match=r"polarising_filter\.strength = 2"):
        sp.PolarisingFilter(strength=2.0)
    assert repr(held) == "PolarisingFilter(strength=1.0, angle_deg=20.0, held_towards_deg=(30.0, 90.0))"


def test_scalar_light_has_no_polarisation_to_show(scalar_sky: sp.Sky) -> None:
    with pytest.raises(sp.InputError, match="polarisation = false: must be true, to know more"):
        scalar_sky.stokes([[0.0, 0.0, 1.0]], GREEN)
    with pytest.raises(sp.InputError, match="polarisation = false: must be true, to see the sky through a polarising filter"):
        scalar_sky.render(width=64, polarising_filter=sp.PolarisingFilter())
    polarised = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=sp.Atmosphere(quality="draft"))
    zenith = [[0.0, 0.0, 1.0]]
    difference = polarised.spectral_radiance(zenith, [450.0]) / scalar_sky.spectral_radiance(zenith, [450.0]) - 1.0
    assert 0.002 < abs(difference[0, 0]) < 0.1


def test_other_models_know_neither_filter_nor_tolerance(pure: sp.Atmosphere) -> None:
    air = sp.Atmosphere(turbidity=3.0, quality="draft")
    preetham = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=air, model="preetham")
    with pytest.raises(sp.InputError, match="polarising_filter = given: must be left out for the model preetham"):
        preetham.render(width=64, polarising_filter=sp.PolarisingFilter())
    with pytest.raises(sp.InputError, match="tolerance = 0.1: must be left out for the model preetham"):
        preetham.render(width=64, tolerance=0.1)
    with pytest.raises(sp.InputError, match="model"):
        preetham.sample_map(width=64)


def test_a_tolerance_holds_in_pictures_and_the_sample_map_shows_its_price(sky: sp.Sky, tmp_path: pathlib.Path) -> None:
    def picture(tolerance: float) -> numpy.ndarray:
        return sky.render(width=256, color_space="xyz", gamut="keep", sun_disc=False, tolerance=tolerance).pixels[..., 1]

    best = picture(0.0001)
    errors = [float(numpy.sqrt(numpy.mean((picture(tolerance) / best - 1.0) ** 2))) for tolerance in (0.2, 0.01, 0.001)]
    assert errors[0] < 0.2 and errors[1] < 0.01 and errors[2] < 0.001 and errors[2] < errors[0], errors
    maps = [sky.sample_map(width=512, tolerance=tolerance) for tolerance in (0.2, 0.01, 0.0005)]
    assert maps[0].shape == (256, 512, 3) and maps[0].dtype == numpy.uint8
    points = [int((shown == 255).all(axis=2).sum()) for shown in maps]
    assert 100 < points[0] <= points[1] < points[2], points
    with pytest.raises(sp.InputError, match="tolerance = 2"):
        sky.render(width=64, tolerance=2.0)
    sky.render(width=64, polarising_filter=sp.PolarisingFilter(angle_deg=12.5), tolerance=0.05).save(tmp_path / "sky.exr")
    header = (tmp_path / "sky.exr").read_bytes()[:8000]
    assert b'"polarising_filter":{"strength":1.0,"angle_deg":12.5}' in header and b'"tolerance":0.05' in header
    assert b'"polarisation":true' in header


def test_the_light_can_be_solved_at_wavelengths_of_choice() -> None:
    air = sp.Atmosphere(quality="draft", wavelengths_nm=[360.0, 365.0, 370.0, 380.0])
    numpy.testing.assert_array_equal(air.wavelengths_nm, [360.0, 365.0, 370.0, 380.0])
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=air)
    i, q, u = sky.stokes([direction(60.0, 0.0)], [360.0, 380.0])[0].T
    assert (i > 0).all() and (q / i < -0.4).all() and (abs(u / i) < 1e-3).all()
    usual = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=sp.Atmosphere(quality="draft"))
    assert i[1] == pytest.approx(usual.spectral_radiance([direction(60.0, 0.0)], [380.0])[0, 0], rel=2e-3)
    with pytest.raises(sp.InputError, match="to make a colour"):
        sky.render(width=64)
    with pytest.raises(sp.InputError, match="wavelengths_nm = 200"):
        sp.Atmosphere(wavelengths_nm=[200.0])


def test_nothing_but_the_air_makes_the_light_be_solved_again(pure: sp.Atmosphere) -> None:
    pure.solve()
    stages: list[str] = []

    def listen(stage: str, fraction: float) -> None:
        stages.append(stage)

    place = {"latitude": 55.71, "longitude": 13.19, "elevation_m": 0.0, "time": "2005-06-21T13:00Z", "atmosphere": pure}
    changes: list[dict[str, object]] = [
        {}, {"time": "2005-12-21T15:00Z"}, {"latitude": -33.0}, {"longitude": 151.0}, {"elevation_m": 9000.0}, {"sun_model": "thesis"},
    ]  # fmt: skip
    skies = [sp.Sky(**(place | change)) for change in changes]  # type: ignore[arg-type]
    skies += [sp.Sky.with_sun(altitude_deg=altitude, azimuth_deg=10.0, atmosphere=pure) for altitude in (50.0, -5.0)]
    for sky in skies:
        sky.render(width=64, progress=listen)
        sky.render(width=64, tolerance=0.1, polarising_filter=sp.PolarisingFilter(), progress=listen)
        sky.illuminance(progress=listen)
        sky.stokes([[0.0, 0.0, 1.0]], GREEN, progress=listen)
    assert set(stages) == {"gather", "render"}
