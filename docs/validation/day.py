"""Irradiance over a clear day against the clear-sky models of pvlib, with the same turbidity."""

import numpy as np
import pandas
import pvlib
import skyprobe as sp
from common import markdown, rms
from figures import plt, save

PLACE = {"latitude": 55.71, "longitude": 13.19}
HEIGHT_M = 20.0
AOD550, OZONE_DU, WATER_CM = 0.10, 320.0, 1.5
ALPHA = 1.2
BANDS_NM = np.arange(380.0, 741.0, 5.0)


def spectral_model(angles: pandas.DataFrame, zenith: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """SPECTRL2 (Bird & Riordan 1986): direct normal and diffuse horizontal over the visible band [W m-2]; its own spectrum of the Sun."""
    shared = {"apparent_zenith": zenith, "aoi": zenith, "surface_tilt": 0.0, "ground_albedo": 0.1, "surface_pressure": 101325.0}
    result = pvlib.spectrum.spectrl2(
        **shared,
        relative_airmass=pvlib.atmosphere.get_relative_airmass(zenith, "kasten1966"),
        precipitable_water=WATER_CM,
        ozone=OZONE_DU / 1000,
        aerosol_turbidity_500nm=AOD550 * (500 / 550) ** -ALPHA,
        dayofyear=angles.index.dayofyear.to_numpy(),
        alpha=ALPHA,
        scattering_albedo_400nm=0.97,
    )
    return np.array(
        [
            [np.trapezoid(np.interp(BANDS_NM, result["wavelength"], values[:, i]), BANDS_NM) for i in range(len(zenith))]
            for values in (result["dni"], result["dhi"])
        ]
    )


def report() -> str:
    times = pandas.date_range("2021-06-21 04:00", "2021-06-21 20:30", freq="30min", tz="Etc/GMT-1")
    position = pvlib.solarposition.get_solarposition(times, PLACE["latitude"], PLACE["longitude"], altitude=HEIGHT_M)
    up = (position["elevation"] > 3).to_numpy()
    times, position = times[up], position[up]
    zenith = position["zenith"].to_numpy()
    air = sp.Atmosphere(
        preset="clear", aod550=AOD550, angstrom_exponent=ALPHA, single_scattering_albedo=0.95, ozone_du=OZONE_DU, ground=0.1, polarisation=True, quality="high"
    )
    rows = []
    for time in times:
        sky = sp.Sky(**PLACE, elevation_m=HEIGHT_M, time=time.isoformat(), atmosphere=air)
        light, lux = sky.irradiance(BANDS_NM), sky.illuminance()
        rows.append(
            [
                np.trapezoid(light.direct_normal, BANDS_NM),
                np.trapezoid(light.diffuse_horizontal, BANDS_NM),
                lux.direct_normal_lx,
                lux.diffuse_horizontal_lx,
                sky.sun.altitude_deg,
            ]
        )
    beam, diffuse, beam_lx, diffuse_lx, altitude = np.array(rows).T
    beam_model, diffuse_model = spectral_model(position, zenith)
    # Broad-band models: the Linke turbidity and Bird's optical depths of the same air.
    airmass = pvlib.atmosphere.get_absolute_airmass(pvlib.atmosphere.get_relative_airmass(zenith))
    broad = pvlib.atmosphere.bird_hulstrom80_aod_bb(AOD550 * (380 / 550) ** -ALPHA, AOD550 * (500 / 550) ** -ALPHA)
    turbidity = pvlib.atmosphere.kasten96_lt(airmass, WATER_CM, broad)
    extra = pvlib.irradiance.get_extra_radiation(times).to_numpy()
    ineichen = pvlib.clearsky.ineichen(zenith, airmass, np.median(turbidity), HEIGHT_M, extra)
    bird = pvlib.clearsky.bird(
        zenith, airmass, AOD550 * (380 / 550) ** -ALPHA, AOD550 * (500 / 550) ** -ALPHA, WATER_CM, OZONE_DU / 1000, 101325.0, extra, albedo=0.1
    )
    cosine = np.cos(np.radians(zenith))
    total_lx = beam_lx * cosine + diffuse_lx
    band = {
        "direct normal": (beam, beam_model),
        "diffuse horizontal": (diffuse, diffuse_model),
        "global horizontal": (beam * cosine + diffuse, beam_model * cosine + diffuse_model),
    }
    lines = []
    for name, (ours, theirs) in band.items():
        error = ours / theirs - 1
        for label, part in (("above 20 deg", altitude > 20), ("3 to 20 deg", altitude <= 20)):
            lines.append([name, label, f"{100 * error[part].mean():+.1f} %", f"{100 * rms(error[part]):.1f} %", f"{100 * np.abs(error[part]).max():.1f} %"])
    text = markdown(["380-740 nm against SPECTRL2", "Sun", "mean", "rms", "largest"], lines) + "\n"
    high = altitude > 20
    lines = []
    for name, model in (("Ineichen", ineichen), ("Bird", bird)):
        efficacy = total_lx / np.asarray(model["ghi"])
        share = diffuse_lx / total_lx, np.asarray(model["dhi"]) / np.asarray(model["ghi"])
        lines.append(
            [
                name,
                f"{efficacy[high].mean():.1f} lm/W",
                f"{efficacy[high].min():.1f}-{efficacy[high].max():.1f}",
                f"{share[0][high].mean():.3f}",
                f"{share[1][high].mean():.3f}",
            ]
        )
    text += markdown(["model, Sun above 20 deg", "illuminance / its broad-band global", "range", "diffuse share of our lux", "of its W m-2"], lines)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2))
    hour = times.hour + times.minute / 60
    for color, (name, (ours, theirs)) in zip(("C1", "C0", "k"), band.items(), strict=True):
        left.plot(hour, ours, color=color, label=name)
        left.plot(hour, theirs, ".", color=color)
    left.set(xlabel="hour, 21 June 2021, 55.7 N", ylabel="380-740 nm [W m-2]", title="lines: skyprobe, dots: SPECTRL2")
    left.legend()
    right.plot(hour, total_lx / 1000, "k", label="skyprobe, global horizontal [klx]")
    for name, model, style in (("Ineichen", ineichen, "C2--"), ("Bird", bird, "C3:")):
        right.plot(hour, 0.11 * np.asarray(model["ghi"]), style, label=f"{name}, global [W m-2] x 110 lm/W")
    right.set(xlabel="hour", ylabel="illuminance [klx]")
    right.legend()
    return text + "\n" + save(figure, "day.png")
