"""The standard spectra of ASTM G173 (SMARTS 2.9.2) from its air: direct with 2.9 degrees around the Sun, and global on a plane tilted by 37 degrees."""

import numpy as np
import pvlib
import skyprobe as sp
from common import around, directions, markdown, own_table, rms
from pvlib.spectrum import get_reference_spectra

ZENITH_DEG = 48.19
TILT_DEG = 37.0
# US Standard Atmosphere 1976; rural aerosol of Shettle & Fenn (1979) of optical depth 0.084 at 500 nm, 0.0764 at 550 nm; single scattering albedo 0.95 to 0.93 at 46 % humidity;
# ozone 343.8 DU; light sandy soil (inputs as SMARTS prints them for the standard's run, its example 6).
AIR = {"aod550": 0.0764, "single_scattering_albedo": 0.94, "ozone_du": 343.8, "ground": "soil"}
# Its Angstrom exponents in this air up to 550 nm and beyond: fits to its spectral extinction. (The mean exponent that it prints, 1.198, it does not use.)
EXPONENTS = (0.99, 1.27)
BANDS_NM = np.arange(400.0, 741.0, 10.0)
# Centres of the 10-nm bands in which the air absorbs what the solver does not have: water vapour 590-600, 650, 700-740; oxygen 630 (gamma), 690 (B).
ABSORBED = {590: "H2O", 600: "H2O", 630: "O2 gamma", 650: "H2O", 690: "O2 B", 700: "H2O", 710: "H2O", 720: "H2O", 730: "H2O", 740: "H2O"}


def band_means(spectrum) -> np.ndarray:
    """Means over the 10-nm bands."""
    fine = np.arange(BANDS_NM[0] - 5, BANDS_NM[-1] + 5.01, 0.1)
    values = np.interp(fine, spectrum.index, spectrum.to_numpy())
    return np.array([values[np.abs(fine - band) <= 5].mean() for band in BANDS_NM])


# SMARTS's ratio of diffuse irradiance on this plane to that on the horizontal: an isotropic sky's, and the anisotropic one of Gueymard (1987, Solar Energy 38, 385) for this Sun and plane.
ISOTROPIC = 0.5 * (1 + np.cos(np.radians(TILT_DEG)))
ANISOTROPIC = 1.242


def compute(**changes) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Direct and global tilted irradiance, and the latter with the sky's part transposed as SMARTS does, per unit of the Sun's irradiance outside the air."""
    given = {"preset": "clear", "aerosol": "continental_clean", "quality": "high", "polarisation": True} | AIR | changes
    exponents = (given["angstrom_exponent"],) if "angstrom_exponent" in given else EXPONENTS
    below, above = (spectra(sp.Atmosphere(**given | {"angstrom_exponent": exponent})) for exponent in (exponents[0], exponents[-1]))
    return tuple(np.where(BANDS_NM <= 550, *pair) for pair in zip(below, above, strict=True))


def spectra(air) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What `compute` returns, in one air."""
    sky = sp.Sky.with_sun(altitude_deg=90 - ZENITH_DEG, azimuth_deg=180.0, atmosphere=air)
    sun = np.array(sky.sun.direction)
    plane = directions(90 - TILT_DEG, 180.0)[0]
    beam = sky.irradiance(BANDS_NM).direct_normal
    look, angle = around(sun, [0, 0.27, 1, 2.9, 6, 15, 40, 70, 90, 180], 8, 96)
    radiance = sky.spectral_radiance(look, BANDS_NM)
    near = look @ sun > np.cos(np.radians(2.9))
    direct = beam + (angle[near] * (look[near] @ sun)) @ radiance[near]
    on_plane = (angle * np.maximum(0.0, look @ plane))[:, None] * radiance
    tilted = beam * (sun @ plane) + on_plane.sum(axis=0)
    ground = on_plane[look[:, 2] < 0].sum(axis=0)
    horizontal = (angle * np.maximum(0.0, look[:, 2])) @ radiance
    as_smarts = beam * (sun @ plane) + smarts_ratio() * horizontal + ground
    table = own_table("solar_spectrum.csv")
    outside = np.array([np.mean(table["irradiance"][np.abs(table["wavelength_nm"] - band) <= 5]) for band in BANDS_NM])
    return direct / outside, tilted / outside, as_smarts / outside


def smarts_ratio() -> np.ndarray:
    """SMARTS's ratio of tilted to horizontal diffuse irradiance by band: isotropic where aerosol scatters less than half as much as the air, anisotropic where more than 1.5 times, between them linear."""
    micrometres = BANDS_NM / 1000
    # Its Rayleigh optical depth at 1013 hPa (Gueymard 2001).
    rayleigh = 1 / (117.3405 * micrometres**4 - 1.5107 * micrometres**2 + 0.017535 - 8.7743e-4 / micrometres**2)
    aerosol = AIR["single_scattering_albedo"] * AIR["aod550"] * (BANDS_NM / 550) ** -np.where(BANDS_NM <= 550, *EXPONENTS)
    share = np.clip(aerosol / rayleigh - 0.5, 0, 1)
    return ISOTROPIC + share * (ANISOTROPIC - ISOTROPIC)


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
    direct, tilted, as_smarts = compute()
    table = own_table("solar_spectrum.csv")
    own = np.array([np.mean(table["irradiance"][np.abs(table["wavelength_nm"] - band) <= 5]) for band in BANDS_NM])
    error_direct, error_global = direct * outside / given_direct - 1, tilted * outside / given_global - 1
    error_smarts = as_smarts * outside / given_global - 1
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
                f"{100 * error_smarts[i]:+.1f} %",
                f"{100 * (own[i] / outside[i] - 1):+.1f} %",
                why,
            ]
        )
    text = "Relative to the standard's own spectrum outside the air:\n\n" + markdown(
        ["bands", "direct, rms", "direct, largest", "global, rms", "global, largest", "global transposed as SMARTS, rms", "largest"],
        [
            [name, *(f"{100 * of(error[which]):.2f} %" for error in (error_direct, error_global, error_smarts) for of in (rms, lambda e: np.abs(e).max()))]
            for name, which in (("kept", kept), ("all", np.ones_like(kept)))
        ],
    )
    ratio = smarts_ratio()
    text += f"\nDiffuse irradiance on the plane over that on the horizontal in SMARTS: {ratio[0]:.3f} at 400, {ratio[15]:.3f} at 550, {ratio[28]:.3f} at 680 nm.\n"
    own_error = direct * own / given_direct - 1, tilted * own / given_global - 1
    text += f"\nWith the library's spectrum of the Sun (ASTM E490) as it is: direct {100 * rms(own_error[0][kept]):.2f} % rms, largest "
    text += f"{100 * np.abs(own_error[0][kept]).max():.2f} %; global {100 * rms(own_error[1][kept]):.2f} % rms, largest {100 * np.abs(own_error[1][kept]).max():.2f} %. "
    text += transposed(tilted, kept)
    rough = []
    for name, changes in (
        ("ground `desert` instead of `soil`", {"ground": "desert"}),
        ("single scattering albedo 0.97", {"single_scattering_albedo": 0.97}),
        ("Angstrom exponent 1.198", {"angstrom_exponent": 1.198}),
        ("Henyey-Greenstein 0.65 instead of Mie", {"asymmetry": 0.65}),
    ):
        other = compute(quality="standard", **changes)
        rough.append([name, *(f"{100 * np.mean((now / before - 1)[kept]):+.2f} %" for now, before in zip(other[:2], (direct, tilted), strict=True))])
    text += markdown(["what the standard leaves open: mean change", "direct", "global"], rough) + "\n"
    table = markdown(["nm", "G173 direct", "skyprobe", "G173 global", "skyprobe", "transposed as SMARTS", "E490 against G173 outside", "left out"], rows)
    text += f"<details><summary>All bands [W m-2 nm-1]</summary>\n\n{table}\n</details>\n"
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2))
    left.plot(BANDS_NM, given_direct, "k-", label="G173 direct")
    left.plot(BANDS_NM, given_global, "k--", label="G173 global, 37 deg")
    left.plot(BANDS_NM, direct * outside, "C0.", label="skyprobe direct")
    left.plot(BANDS_NM, tilted * outside, "C1.", label="skyprobe global")
    left.set(xlabel="wavelength [nm]", ylabel="irradiance [W m-2 nm-1]", ylim=(0, None))
    left.legend()
    for error, name in ((error_direct, "direct"), (error_global, "global"), (error_smarts, "global, transposed as SMARTS")):
        (line,) = right.plot(BANDS_NM[kept], 100 * error[kept], ".-", label=name)
        right.plot(BANDS_NM[~kept], 100 * error[~kept], "x", color=line.get_color(), ms=4)
    right.axhspan(-3, 3, color="0.9", zorder=0)
    right.set(xlabel="wavelength [nm]", ylabel="skyprobe / G173 - 1 [%]", title="crosses: bands of water and oxygen")
    right.legend()
    return text + "\n" + save(figure, "standard_spectrum.png")
