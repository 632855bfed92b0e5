"""Twilight: illuminance by the Sun's altitude, and the zenith's brightness, against published values."""

import numpy as np
import skyprobe as sp
from common import markdown, rms
from figures import plt, save

# Illuminance of Sun and clear sky on a level surface [lx]: log10 E = sum of l_i x^i, x = altitude / 90 deg (Janiczek & DeYoung, US Naval Observatory Circular 171,
# 1987; Seidelmann, Explanatory Supplement, 1992, section 9.3).
ILLUMINANCE = [
    (20, 90, (3.74, 3.97, -4.07, 1.47)),
    (5, 20, (3.05, 13.28, -45.98, 64.33)),
    (-0.8, 5, (2.88, 22.26, -207.64, 1034.30)),
    (-5, -0.8, (2.88, 21.81, -258.11, -858.36)),
    (-12, -5, (2.70, 12.17, -431.69, -1899.83)),
    (-18, -12, (13.84, 262.72, 1447.42, 2797.93)),
]
# AMS Glossary of Meteorology, civil and astronomical twilight [lx]; those at -18 degrees contain starlight and airglow.
GLOSSARY = {-6: "2-3.5", -12: "0.008", -18: "0.0006"}
# Patat, Ugolnikov & Postylyakov, A&A 455 (2006), table 1: zenith brightness a0 + a1 (z - 95) + a2 (z - 95)^2 [mag arcsec-2] for Sun zenith angles
# of 95 to 105 degrees, scatter of the data; zenith night sky of Patat, A&A 400 (2003).
PARANAL = {"B": (11.84, 1.411, -0.041, 0.12, 22.6), "V": (11.84, 1.518, -0.057, 0.18, 21.6)}
# Bessell, Castelli & Plez, A&A 333 (1998), table A2: effective wavelength [nm], flux of magnitude 0 [W m-2 nm-1]; full width of the band [nm].
BANDS = {"B": (438.0, 6.32e-11, 94.0), "V": (545.0, 3.631e-11, 85.0)}
ARCSEC2 = (np.pi / 180 / 3600) ** 2


def published_lux(altitude_deg: float) -> float:
    for low, high, terms in ILLUMINANCE:
        if low <= altitude_deg <= high:
            return 10 ** np.polyval(terms[::-1], altitude_deg / 90)
    return np.nan


def magnitude(sky: sp.Sky, band: str) -> float:
    """Surface brightness of the zenith in a Gaussian band [mag arcsec-2]."""
    centre, zero, width = BANDS[band]
    wavelengths = np.arange(max(380.0, centre - width), centre + width, 5.0)
    weights = np.exp(-4 * np.log(2) * ((wavelengths - centre) / width) ** 2)
    radiance = np.average(sky.spectral_radiance([[0.0, 0.0, 1.0]], wavelengths)[0], weights=weights)
    return float(-2.5 * np.log10(radiance * ARCSEC2 / zero))


def mean_difference(air: sp.Atmosphere) -> list[float]:
    """Zenith with night sky minus measurement, for each band [mag]."""
    result = []
    for band, (a0, a1, a2, _, night) in PARANAL.items():
        over = np.arange(0.0, 8.1, 2.0)
        lit = np.array([magnitude(sp.Sky.with_sun(altitude_deg=-5 - x, azimuth_deg=180.0, atmosphere=air), band) for x in over])
        total = -2.5 * np.log10(10 ** (-0.4 * lit) + 10 ** (-0.4 * night))
        result.append(float(np.mean(total - (a0 + a1 * over + a2 * over**2))))
    return result


def report() -> str:
    clear = sp.Atmosphere(preset="clear", quality="high", polarisation=True)
    hazy = sp.Atmosphere(preset="clear", turbidity=6.0, quality="standard", polarisation=True)
    altitudes = [60, 40, 20, 10, 5, 2, 0, -0.8, -2, -4, -5, -6, -8, -10, -12, -14, -16, -18]
    rows, curve = [], []
    for altitude in altitudes:
        sky = sp.Sky.with_sun(altitude_deg=altitude, azimuth_deg=180.0, atmosphere=clear)
        lux = sky.illuminance().global_horizontal_lx
        published = published_lux(altitude)
        through_haze = sp.Sky.with_sun(altitude_deg=altitude, azimuth_deg=180.0, atmosphere=hazy).illuminance().global_horizontal_lx
        curve.append((altitude, lux, published))
        rows.append([altitude, f"{lux:.3g}", f"{published:.3g}", f"{lux / published:.2f}", f"{through_haze / published:.2f}", GLOSSARY.get(altitude, "")])
    text = markdown(["Sun [deg]", "skyprobe `clear` [lx]", "Seidelmann [lx]", "ratio", "ratio at turbidity 6", "AMS Glossary [lx]"], rows) + "\n"
    # The observatory's level as the ground: 744 hPa at 2635 m, thin haze, tropical ozone.
    paranal = {"preset": "clear", "surface_pressure_hpa": 744.0, "aod550": 0.04, "ozone_du": 255.0, "ground": "desert", "polarisation": True}
    air = sp.Atmosphere(**paranal, quality="high")
    scalar = sp.Atmosphere(**paranal | {"polarisation": False}, quality="high")
    rows, points = [], []
    for zenith in np.arange(95.0, 105.1, 1.0):
        row: list[object] = [f"{90 - zenith:g}"]
        skies = [sp.Sky.with_sun(altitude_deg=90 - zenith, azimuth_deg=180.0, atmosphere=one) for one in (air, scalar)]
        for band, (a0, a1, a2, scatter, night) in PARANAL.items():
            measured = a0 + a1 * (zenith - 95) + a2 * (zenith - 95) ** 2
            lit, plain = (magnitude(sky, band) for sky in skies)
            total = -2.5 * np.log10(10 ** (-0.4 * lit) + 10 ** (-0.4 * night))
            points.append((zenith, band, measured, total, lit, scatter))
            row += [f"{measured:.2f}", f"{lit:.2f}", f"{total - measured:+.2f}", f"{lit - plain:+.3f}"]
        rows.append(row)
    header = ["Sun [deg]"]
    for band in PARANAL:
        header += [f"{band} measured", f"{band} skyprobe", "with night sky - measured", "polarised - scalar"]
    text += markdown(header, rows) + "\n"
    for band in PARANAL:
        difference = np.array([total - measured for _, name, measured, total, _, _ in points if name == band])
        text += f"{band}: mean {difference.mean():+.2f} mag, rms {rms(difference):.2f} mag; scatter of the measurements {PARANAL[band][3]:.2f} mag.\n"
    variants = [
        ("as above", {}),
        ("ozone 200 DU", {"ozone_du": 200.0}),
        ("no ozone", {"ozone_du": 0.0}),
        ("aerosol optical depth 0.02", {"aod550": 0.02}),
        ("stratospheric aerosol of optical depth 0.005 added", {"stratospheric_aod550": 0.005}),
        ("1013 hPa", {"surface_pressure_hpa": 1013.25}),
    ]
    rows = [[name, *(f"{value:+.2f}" for value in mean_difference(sp.Atmosphere(**paranal | change, quality="standard")))] for name, change in variants]
    text += "\n" + markdown(["mean difference, Sun -5 to -13 deg [mag]", *PARANAL], rows)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.4))
    altitude, lux, published = np.array(curve).T
    left.semilogy(altitude, lux, "C0.-", label="skyprobe, clear (no night sky)")
    left.semilogy(altitude, published, "k--", label="Seidelmann 1992")
    left.errorbar([-6, -12, -18], [2.65, 0.008, 6e-4], [[0.65, 0, 0], [0.85, 0, 0]], fmt="r_", label="AMS Glossary")
    left.set(xlabel="Sun altitude [deg]", ylabel="illuminance [lx]", xlim=(-19, 25))
    left.legend()
    for color, band in (("C0", "B"), ("C2", "V")):
        zenith, measured, total, lit, scatter = np.array([(z, m, t, o, s) for z, name, m, t, o, s in points if name == band]).T
        right.fill_between(90 - zenith, measured - scatter, measured + scatter, color=color, alpha=0.25, label=f"{band}, Paranal (Patat et al. 2006)")
        right.plot(90 - zenith, total, color + ".-", label=f"{band}, skyprobe + night sky")
        right.plot(90 - zenith, lit, color + ":", lw=1)
    right.invert_yaxis()
    right.set(xlabel="Sun altitude [deg]", ylabel="zenith [mag arcsec-2]")
    right.legend()
    return text + "\n" + save(figure, "twilight.png")
