"""Air given in full from Python, and air that is too thick for the solver."""

from __future__ import annotations

from collections.abc import Callable

import numpy
import pytest

import skyprobe as sp

DIRECTIONS = numpy.array([[0.0, 0.0, 1.0], [0.0, -0.6, 0.8], [1.0, 0.0, 0.0]])
WAVELENGTHS_NM = numpy.array([450.0, 550.0, 650.0])


def profile(altitudes_km: numpy.ndarray, wavelengths_nm: numpy.ndarray) -> list[sp.Component]:
    shape = (len(altitudes_km), len(wavelengths_nm))
    fall = numpy.exp(-altitudes_km / 8.0)[:, None]
    molecules = numpy.broadcast_to(0.0116 * fall, shape) * (550.0 / wavelengths_nm) ** 4
    zeros = numpy.zeros(shape)
    ozone = numpy.full(shape, 1e-4)
    return [
        sp.Component(scattering=molecules, absorption=zeros, phase=sp.Phase.rayleigh(depolarisation=0.0), name="molecules"),
        sp.Component(scattering=0.01 * fall * numpy.ones(shape), absorption=zeros, phase=sp.Phase.henyey_greenstein(0.7)),
        sp.Component(scattering=zeros, absorption=ozone, phase=None),
    ]


def test_an_air_given_in_full_gives_light() -> None:
    altitudes_km = numpy.linspace(0.0, 60.0, 61)
    air = sp.Atmosphere.from_profile(
        altitudes_km, WAVELENGTHS_NM, components=profile(altitudes_km, WAVELENGTHS_NM), ground_albedo=0.25,
        solar_irradiance=numpy.ones(3), planet_radius_km=6371.0, sun_angular_radius_deg=0.2664, quality="draft", polarisation=False,
    )  # fmt: skip
    numpy.testing.assert_array_equal(air.altitudes_km, altitudes_km)
    numpy.testing.assert_array_equal(air.wavelengths_nm, WAVELENGTHS_NM)
    sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, elevation_m=0, atmosphere=air)
    zenith = sky.spectral_radiance([[0.0, 0.0, 1.0]], WAVELENGTHS_NM)[0]
    assert zenith[0] > zenith[1] > zenith[2] > 0, "the sky is blue"
    # Beer's law through the column (trapezoid rule, as the profile is linear between altitudes) at an air mass near 2.
    coefficients = sum(getattr(numpy, "trapezoid")(values, altitudes_km, axis=0) for values in (
        0.0116 * numpy.exp(-altitudes_km / 8.0)[:, None] * (550.0 / WAVELENGTHS_NM) ** 4,
        0.01 * numpy.exp(-altitudes_km / 8.0)[:, None] * numpy.ones(3),
        numpy.full((61, 3), 1e-4),
    ))  # fmt: skip
    numpy.testing.assert_allclose(sky.irradiance(WAVELENGTHS_NM).direct_normal, numpy.exp(-coefficients * 1.993), rtol=5e-3)


def test_a_tabulated_phase_function_is_the_function_that_it_holds() -> None:
    altitudes_km = numpy.linspace(0.0, 60.0, 61)
    angles_deg = numpy.linspace(0.0, 180.0, 1801)
    values = (1.0 - 0.7**2) / (1.0 + 0.7**2 - 1.4 * numpy.cos(numpy.radians(angles_deg))) ** 1.5

    def radiance(phase: sp.Phase) -> numpy.ndarray:
        particles = sp.Component(
            scattering=0.05 * numpy.exp(-altitudes_km / 2.0)[:, None] * numpy.ones(3), absorption=numpy.zeros((61, 3)), phase=phase
        )
        air = sp.Atmosphere.from_profile(altitudes_km, WAVELENGTHS_NM, [particles], solar_irradiance=1.0, quality="draft")
        return sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=air).spectral_radiance(DIRECTIONS, WAVELENGTHS_NM)

    expected = radiance(sp.Phase.henyey_greenstein(0.7))
    for table in (values, numpy.tile(values, (3, 1)), 1.03 * values):
        numpy.testing.assert_allclose(radiance(sp.Phase.tabulated(angles_deg, table)), expected, rtol=1e-3)
    assert repr(sp.Phase.tabulated(angles_deg, values)) == "Phase.tabulated(<1801 angles>, <1 wavelengths>)"
    for angles, wrong, message in (
        (angles_deg[1:], values[1:], "angles = 1800 angles"),
        (angles_deg, values[1:], r"values = array of shape \(1800\)"),
        (angles_deg, -values, "values = -"),
        (angles_deg, 2.0 * values, "values = an integral over the sphere that is 100.0 % off"),
    ):
        with pytest.raises(sp.InputError, match=message):
            sp.Phase.tabulated(angles, wrong)
    with pytest.raises(sp.InputError, match="a table of 2 wavelengths"):
        radiance(sp.Phase.tabulated(angles_deg, numpy.tile(values, (2, 1))))


def test_wrong_profiles_are_named() -> None:
    altitudes_km = numpy.linspace(0.0, 60.0, 7)
    components = profile(altitudes_km, WAVELENGTHS_NM)

    def message(**changes: object) -> str:
        given = {"altitudes_km": altitudes_km, "wavelengths_nm": WAVELENGTHS_NM, "components": components, "solar_irradiance": 1.0}
        with pytest.raises(sp.InputError) as caught:
            sp.Atmosphere.from_profile(**(given | changes))  # type: ignore[arg-type]
        return str(caught.value)

    assert message(altitudes_km=altitudes_km[::-1]).startswith("altitudes_km")
    assert message(components=[]).startswith("components")
    assert message(wavelengths_nm=[500.0, 600.0]).startswith("molecules.scattering = array of shape (7, 3)")
    assert message(ground_albedo=2.0).startswith("ground_albedo = 2")
    assert message(ground_albedo=[0.1, 0.2]).startswith("ground_albedo = array of shape (2)")
    assert message(solar_irradiance=float("nan")).startswith("solar_irradiance = NaN")
    assert message(planet_radius_km=-1.0).startswith("planet_radius_km = -1")
    assert message(quality="best").startswith('quality = "best"')
    with pytest.raises(sp.InputError, match="asymmetry = 1"):
        sp.Phase.cornette_shanks(1.0)
    with pytest.raises(sp.InputError, match="depolarisation = -1"):
        sp.Phase.rayleigh([-1.0])


def test_air_too_thick_for_the_solver_is_told_as_such() -> None:
    for air in [
        sp.Atmosphere(preset="fog", aod550=50, quality="draft"),
        sp.Atmosphere(preset="desert", aod550=50, quality="draft"),
        slab(optical_depth=20.0, ground_albedo=1.0),
    ]:
        sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=air)
        works: list[Callable[[], object]] = [
            air.solve,
            sky.illuminance,
            lambda sky=sky: sky.render(width=64),  # type: ignore[misc]
            lambda sky=sky: sky.spectral_radiance([0.0, 0.0, 1.0], [550.0]),  # type: ignore[misc]
            lambda sky=sky: sky.irradiance([550.0]),  # type: ignore[misc]
        ]
        for work in works:
            with pytest.raises(sp.UnsolvedError, match="optical depth of"):
                work()


def slab(optical_depth: float, ground_albedo: float) -> sp.Atmosphere:
    """A homogeneous layer of 10 km that does not absorb."""
    wavelengths = numpy.linspace(400.0, 700.0, 8)
    scattering = numpy.full((2, 8), optical_depth / 10.0)
    component = sp.Component(scattering=scattering, absorption=numpy.zeros((2, 8)), phase=sp.Phase.rayleigh(), name="slab")
    return sp.Atmosphere.from_profile(
        [0.0, 10.0], wavelengths, [component], ground_albedo=ground_albedo, solar_irradiance=1.0, quality="draft"
    )
