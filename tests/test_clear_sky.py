"""Daylight of a clear day against pvlib: illuminance of the horizontal plane, broadband irradiance times a luminous efficacy.

Bird's clear-sky model (Bird & Hulstrom 1981, SERI/TR-642-761) is the one in pvlib that takes the same description of the air as
skyprobe: aerosol optical depth at two wavelengths, asymmetry, ozone, pressure, albedo of the ground. What skyprobe does not know, water vapour, which
absorbs in the infrared only, is that of the US Standard Atmosphere 1976.

The luminous efficacy is the middle of the 105-115 lm/W that clear daylight has, for all altitudes of the Sun alike, so that nothing is tuned;
pvlib's spectral model (spectrl2; Bird & Riordan 1986, SERI/TR-215-2436) then gives illuminance itself, without an efficacy.
"""

from __future__ import annotations

import csv
import pathlib

import numpy
import pytest
from pvlib import atmosphere, clearsky, spectrum

import skyprobe

SUN_ALTITUDES_DEG = [60.0, 30.0, 10.0]
LUMINOUS_EFFICACY = 110.0
TOLERANCE = 0.10

# Of skyprobe's continental clean aerosol, relative to 550 nm (data/aerosol_particles.bin), and its albedo.
AOD550 = 0.1
RELATIVE_EXTINCTION = {380.0: 1.545, 500.0: 1.1306}
ANGSTROM_EXPONENT = 1.28
SINGLE_SCATTERING_ALBEDO = 0.978
ASYMMETRY = 0.71
GROUND_ALBEDO = 0.2
OZONE_DU = 300.0
PRESSURE_PA = 101325.0
WATER_VAPOUR_CM = 1.42
# Solar constant at 1 au, where the Sun of `Sky.with_sun` stands [W m-2].
SOLAR_CONSTANT = 1361.0
# A day on which the Earth is at 1 au.
DAY_OF_YEAR = 94


@pytest.fixture(scope="module")
def air() -> skyprobe.Atmosphere:
    return skyprobe.Atmosphere(
        preset="clear", aerosol="continental_clean", aod550=AOD550, ozone_du=OZONE_DU, ground=GROUND_ALBEDO, quality="draft"
    )


def illuminance(air: skyprobe.Atmosphere, sun_altitude_deg: float) -> skyprobe.Illuminance:
    return skyprobe.Sky.with_sun(altitude_deg=sun_altitude_deg, azimuth_deg=180.0, atmosphere=air).illuminance()


def broadband_irradiance(sun_altitude_deg: float) -> float:
    """Global horizontal irradiance by Bird's model [W m-2]."""
    zenith = 90.0 - sun_altitude_deg
    result = clearsky.bird(
        zenith,
        atmosphere.get_relative_airmass(zenith, "kastenyoung1989"),
        aod380=AOD550 * RELATIVE_EXTINCTION[380.0],
        aod500=AOD550 * RELATIVE_EXTINCTION[500.0],
        precipitable_water=WATER_VAPOUR_CM,
        ozone=OZONE_DU / 1000.0,
        pressure=PRESSURE_PA,
        dni_extra=SOLAR_CONSTANT,
        asymmetry=ASYMMETRY,
        albedo=GROUND_ALBEDO,
    )
    return float(result["ghi"])


def spectral_illuminance(sun_altitude_deg: float) -> tuple[float, float]:
    """Direct and global illuminance of the horizontal plane by spectrl2 [lx]."""
    zenith = 90.0 - sun_altitude_deg
    result = spectrum.spectrl2(
        apparent_zenith=zenith,
        aoi=zenith,
        surface_tilt=0.0,
        ground_albedo=GROUND_ALBEDO,
        surface_pressure=PRESSURE_PA,
        relative_airmass=atmosphere.get_relative_airmass(zenith, "kastenyoung1989"),
        precipitable_water=WATER_VAPOUR_CM,
        ozone=OZONE_DU / 1000.0,
        aerosol_turbidity_500nm=AOD550 * RELATIVE_EXTINCTION[500.0],
        dayofyear=DAY_OF_YEAR,
        scattering_albedo_400nm=SINGLE_SCATTERING_ALBEDO,
        alpha=ANGSTROM_EXPONENT,
        aerosol_asymmetry_factor=ASYMMETRY,
    )
    path = pathlib.Path(__file__).parents[1] / "data" / "cie1931.csv"
    rows = csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#"))
    observer = numpy.array([(float(row["wavelength_nm"]), float(row["ybar"])) for row in rows])
    ybar = observer[:, 1]

    def luminous(values: numpy.ndarray) -> float:
        spectral = numpy.interp(observer[:, 0], result["wavelength"], numpy.ravel(values))
        return float(683.0 * numpy.trapezoid(spectral * ybar, observer[:, 0]))

    return luminous(result["poa_direct"]), luminous(result["poa_global"])


@pytest.mark.parametrize("sun_altitude_deg", SUN_ALTITUDES_DEG)
def test_illuminance_is_that_of_clear_daylight(air: skyprobe.Atmosphere, sun_altitude_deg: float) -> None:
    found = illuminance(air, sun_altitude_deg).global_horizontal_lx
    irradiance = broadband_irradiance(sun_altitude_deg)
    expected = LUMINOUS_EFFICACY * irradiance
    print(f"Sun at {sun_altitude_deg:.0f}: {found:.0f} lx, {irradiance:.1f} W/m2: {found / irradiance:.1f} lm/W, {found / expected - 1:+.1%}")
    assert found == pytest.approx(expected, rel=TOLERANCE)


@pytest.mark.parametrize("sun_altitude_deg", SUN_ALTITUDES_DEG)
def test_illuminance_is_that_of_the_spectral_model(air: skyprobe.Atmosphere, sun_altitude_deg: float) -> None:
    found = illuminance(air, sun_altitude_deg)
    direct, whole = spectral_illuminance(sun_altitude_deg)
    print(
        f"Sun at {sun_altitude_deg:.0f}: direct {found.direct_horizontal_lx:.0f} lx, {found.direct_horizontal_lx / direct - 1:+.1%}; "
        f"global {found.global_horizontal_lx:.0f} lx, {found.global_horizontal_lx / whole - 1:+.1%}"
    )
    assert found.global_horizontal_lx == pytest.approx(whole, rel=TOLERANCE)
    assert found.direct_horizontal_lx == pytest.approx(direct, rel=TOLERANCE)
