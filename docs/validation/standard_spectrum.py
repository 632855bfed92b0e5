"""The standard spectra of ASTM G173 (SMARTS 2.9.2) from its air: direct with 2.9 degrees around the Sun, and global on a plane tilted by 37 degrees."""

import numpy as np
import pvlib
import skyprobe as sp
from common import around, directions, markdown, own_table, rms
from pvlib.spectrum import get_reference_spectra

ZENITH_DEG = 48.19
TILT_DEG = 37.0
# US Standard Atmosphere 1976; rural aerosol of Shettle & Fenn (1979): SMARTS prints alpha 0.964 below and 1.431 above 500 nm, mean 1.198, AOD 0.084 at 500 nm,
# 0.0764 at 550 nm; single scattering albedo 0.94 at 46 % humidity; ozone 343.8 DU; light sandy soil.
AIR = {"aod550": 0.0764, "angstrom_exponent": 1.198, "single_scattering_albedo": 0.94, "ozone_du": 343.8, "ground": "soil"}
BANDS_NM = np.arange(400.0, 741.0, 10.0)
# Centres of the 10-nm bands in which the air absorbs what the solver does not have: water vapour 590-600, 650, 700-740; oxygen 630 (gamma), 690 (B).
ABSORBED = {590: "H2O", 600: "H2O", 630: "O2 gamma", 650: "H2O", 690: "O2 B", 700: "H2O", 710: "H2O", 720: "H2O", 730: "H2O", 740: "H2O"}


def band_means(spectrum) -> np.ndarray:
    """Means over the 10-nm bands."""
    fine = np.arange(BANDS_NM[0] - 5, BANDS_NM[-1] + 5.01, 0.1)
    values = np.interp(fine, spectrum.index, spectrum.to_numpy())
    return np.array([values[np.abs(fine - band) <= 5].mean() for band in BANDS_NM])


def compute(**changes) -> tuple[np.ndarray, np.ndarray]:
    """Direct and global tilted irradiance per unit of the Sun's irradiance outside the air."""
    air = sp.Atmosphere(**{"preset": "clear", "aerosol": "continental_clean", "quality": "high", "polarisation": True} | AIR | changes)
    sky = sp.Sky.with_sun(altitude_deg=90 - ZENITH_DEG, azimuth_deg=180.0, atmosphere=air)
    sun = np.array(sky.sun.direction)
    plane = directions(90 - TILT_DEG, 180.0)[0]
    beam = sky.irradiance(BANDS_NM).direct_normal
    look, angle = around(sun, [0, 0.27, 1, 2.9, 6, 15, 40, 70, 90, 180], 8, 96)
    radiance = sky.spectral_radiance(look, BANDS_NM)
    near = look @ sun > np.cos(np.radians(2.9))
    direct = beam + (angle[near] * (look[near] @ sun)) @ radiance[near]
    tilted = beam * (sun @ plane) + (angle * np.maximum(0.0, look @ plane)) @ radiance
    table = own_table("solar_spectrum.csv")
    outside = np.array([np.mean(table["irradiance"][np.abs(table["wavelength_nm"] - band) <= 5]) for band in BANDS_NM])
    return direct / outside, tilted / outside


def transposed(tilted: np.ndarray, kept: np.ndarray) -> str:
    """The diffuse light of the tilted plane beside that of SPECTRL2 (Bird & Riordan 1986) in the same air, relative to the global irradiance."""
    result = pvlib.spectrum.spectrl2(
        apparent_zenith=ZENITH_DEG,
        aoi=ZENITH_DEG - TILT_DEG,
        surface_tilt=TILT_DEG,
        ground_albedo=0.15,
        surface_pressure=101325.0,
        relative_airmass=1.5,
        precipitable_water=1.416,
        ozone=0.3438,
        aerosol_turbidity_500nm=0.084,
        dayofyear=94,
        alpha=1.198,
        scattering_albedo_400nm=0.94,
    )
    sun, theirs = (np.interp(BANDS_NM, result["wavelength"], np.ravel(result[key])) for key in ("dni_extra", "poa_global"))
    error = (tilted / (theirs / sun) - 1)[kept]
    return (
        f"Global irradiance of the same plane against SPECTRL2 in the same air: mean {100 * error.mean():+.2f} %, rms {100 * rms(error):.2f} %, "
        f"largest {100 * np.abs(error).max():.2f} %.\n\n"
    )


def report() -> str:
    from figures import plt, save

    spectra = get_reference_spectra()
    outside, given_global, given_direct = (band_means(spectra[name]) for name in ("extraterrestrial", "global", "direct"))
    direct, tilted = compute()
    table = own_table("solar_spectrum.csv")
    own = np.array([np.mean(table["irradiance"][np.abs(table["wavelength_nm"] - band) <= 5]) for band in BANDS_NM])
    error_direct, error_global = direct * outside / given_direct - 1, tilted * outside / given_global - 1
    kept = np.array([int(band) not in ABSORBED for band in BANDS_NM])
    rows = []
    for i, band in enumerate(BANDS_NM):
        why = ABSORBED.get(int(band), "")
        rows.append(
            [
                f"{band:.0f}",
                f"{given_direct[i]:.3f}",
                f"{100 * error_direct[i]:+.1f} %",
                f"{given_global[i]:.3f}",
                f"{100 * error_global[i]:+.1f} %",
                f"{100 * (own[i] / outside[i] - 1):+.1f} %",
                why,
            ]
        )
    text = "Relative to the standard's own spectrum outside the air:\n\n" + markdown(
        ["bands", "direct, rms", "direct, largest", "global, rms", "global, largest"],
        [
            [
                "kept",
                f"{100 * rms(error_direct[kept]):.2f} %",
                f"{100 * np.abs(error_direct[kept]).max():.2f} %",
                f"{100 * rms(error_global[kept]):.2f} %",
                f"{100 * np.abs(error_global[kept]).max():.2f} %",
            ],
            [
                "all",
                f"{100 * rms(error_direct):.2f} %",
                f"{100 * np.abs(error_direct).max():.2f} %",
                f"{100 * rms(error_global):.2f} %",
                f"{100 * np.abs(error_global).max():.2f} %",
            ],
        ],
    )
    own_error = direct * own / given_direct - 1, tilted * own / given_global - 1
    text += f"\nWith the library's spectrum of the Sun (ASTM E490) as it is: direct {100 * rms(own_error[0][kept]):.2f} % rms, largest "
    text += f"{100 * np.abs(own_error[0][kept]).max():.2f} %; global {100 * rms(own_error[1][kept]):.2f} % rms, largest {100 * np.abs(own_error[1][kept]).max():.2f} %. "
    text += transposed(tilted, kept)
    rough = []
    for name, changes in (
        ("ground `desert` instead of `soil`", {"ground": "desert"}),
        ("single scattering albedo 0.97", {"single_scattering_albedo": 0.97}),
        ("Angstrom exponent 0.964", {"angstrom_exponent": 0.964}),
        ("Henyey-Greenstein 0.65 instead of Mie", {"asymmetry": 0.65}),
    ):
        other = compute(quality="standard", **changes)
        rough.append([name, *(f"{100 * np.mean((now / before - 1)[kept]):+.2f} %" for now, before in zip(other, (direct, tilted), strict=True))])
    text += markdown(["what the standard leaves open: mean change", "direct", "global"], rough) + "\n"
    table = markdown(["nm", "G173 direct", "skyprobe", "G173 global", "skyprobe", "E490 against G173 outside", "left out"], rows)
    text += f"<details><summary>All bands [W m-2 nm-1]</summary>\n\n{table}\n</details>\n"
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2))
    left.plot(BANDS_NM, given_direct, "k-", label="G173 direct")
    left.plot(BANDS_NM, given_global, "k--", label="G173 global, 37 deg")
    left.plot(BANDS_NM, direct * outside, "C0.", label="skyprobe direct")
    left.plot(BANDS_NM, tilted * outside, "C1.", label="skyprobe global")
    left.set(xlabel="wavelength [nm]", ylabel="irradiance [W m-2 nm-1]", ylim=(0, None))
    left.legend()
    for error, name in ((error_direct, "direct"), (error_global, "global")):
        (line,) = right.plot(BANDS_NM[kept], 100 * error[kept], ".-", label=name)
        right.plot(BANDS_NM[~kept], 100 * error[~kept], "x", color=line.get_color(), ms=4)
    right.axhspan(-3, 3, color="0.9", zorder=0)
    right.set(xlabel="wavelength [nm]", ylabel="skyprobe / G173 - 1 [%]", title="crosses: bands of water and oxygen")
    right.legend()
    return text + "\n" + save(figure, "standard_spectrum.png")
