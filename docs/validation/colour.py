"""Chromaticity of the clear sky against the CIE daylight locus, and the blue hour with and without ozone."""

import numpy as np
import skyprobe as sp
from common import directions, markdown, to_xyz
from figures import plt, save

WAVELENGTHS_NM = np.linspace(380.0, 740.0, 73)
LOOK = {
    "zenith": (90, 0),
    "45 deg, Sun's side": (45, 0),
    "45 deg, side": (45, 90),
    "45 deg, opposite": (45, 180),
    "10 deg, side": (10, 90),
    "10 deg, opposite": (10, 180),
}
SUNS_DEG = [60, 40, 20, 10, 5, 2, 0, -2, -4, -6, -8, -10]


def locus(temperature: np.ndarray) -> np.ndarray:
    """CIE 015: xy of daylight of 4000 to 25000 K."""
    t = np.asarray(temperature, float)
    x = np.where(t <= 7000, -4.6070e9 / t**3 + 2.9678e6 / t**2 + 0.09911e3 / t + 0.244063, -2.0064e9 / t**3 + 1.9018e6 / t**2 + 0.24748e3 / t + 0.237040)
    return np.stack([x, -3.0 * x**2 + 2.870 * x - 0.275], axis=-1)


def uv(xy: np.ndarray) -> np.ndarray:
    """CIE 1960 uv."""
    x, y = np.moveaxis(np.asarray(xy), -1, 0)
    return np.stack([4 * x, 6 * y], axis=-1) / (-2 * x + 12 * y + 3)[..., None]


# Bluer than 25 000 K the locus is continued along its parabola to x = 0.235 (a black body ends at 0.240): its formula ends, skies do not.
NEAREST = np.concatenate([locus(1e6 / np.linspace(250, 40, 400)), [[x, -3 * x * x + 2.870 * x - 0.275] for x in np.linspace(0.2498, 0.235, 60)]])


def distance(xy: np.ndarray) -> float:
    """Signed distance from the locus in CIE 1960 uv, positive on the green side; NaN for what is bluer than the end of the locus."""
    here, line = uv(xy), uv(NEAREST)
    nearest = np.argmin(np.linalg.norm(line - here, axis=1))
    if nearest == len(line) - 1:
        return float("nan")
    return float(np.copysign(np.linalg.norm(line[nearest] - here), here[1] - line[nearest][1]))


def chromaticity(air: sp.Atmosphere, altitude_deg: float) -> np.ndarray:
    """xy in the directions of LOOK."""
    sky = sp.Sky.with_sun(altitude_deg=altitude_deg, azimuth_deg=0.0, atmosphere=air)
    height, azimuth = np.array(list(LOOK.values())).T
    xyz = to_xyz(sky.spectral_radiance(directions(height, azimuth), WAVELENGTHS_NM), WAVELENGTHS_NM)
    return xyz[:, :2] / xyz.sum(axis=1, keepdims=True)


def report() -> str:
    airs = {ozone: sp.Atmosphere(preset="clear", ozone_du=ozone, quality="high", polarisation=True) for ozone in (300.0, 0.0)}
    found = {ozone: np.array([chromaticity(air, sun) for sun in SUNS_DEG]) for ozone, air in airs.items()}
    clear = found[300.0]
    rows = []
    for sun, xy in zip(SUNS_DEG, clear, strict=True):
        rows.append([sun, *(f"{x:.3f} {y:.3f} ({1000 * distance([x, y]):+.0f})".replace("(+nan)", "(bluer)") for x, y in xy)])
    text = "x y (distance from the locus in 1000 uv):\n\n" + markdown(["Sun [deg]", *LOOK], rows) + "\n"
    day = np.abs([distance(xy) for sun, each in zip(SUNS_DEG, clear, strict=True) if sun >= 5 for xy in each])
    text += f"Sun 5 degrees and higher: mean distance {1000 * np.nanmean(day):.1f}, largest {1000 * np.nanmax(day):.1f} (1000 uv).\n\n"
    rows = []
    for sun in (20, 0, -4, -6, -8):
        i = SUNS_DEG.index(sun)
        rows.append([sun, *("{:.3f} {:.3f}".format(*found[ozone][i, 0]) for ozone in (300.0, 0.0))])
    text += markdown(["zenith, Sun [deg]", "300 DU: x y", "no ozone: x y"], rows)
    figure, axes = plt.subplots(figsize=(5.2, 4.2))
    line = locus(np.linspace(4000, 25000, 200))
    axes.plot(*line.T, "k-", lw=1, label="CIE daylight, 4000-25000 K")
    for marker, (name, xy) in zip("osv^Dx", zip(LOOK, clear.transpose(1, 0, 2), strict=True), strict=True):
        dots = axes.scatter(*xy.T, c=SUNS_DEG, cmap="plasma", marker=marker, s=16, vmin=-10, vmax=60, label=name)
    axes.plot(*found[0.0][:, 0].T, "-", color="0.5", lw=0.8, label="zenith without ozone")
    axes.annotate("no ozone, Sun -6", found[0.0][SUNS_DEG.index(-6), 0], fontsize=7)
    axes.set(xlabel="x", ylabel="y")
    figure.colorbar(dots, label="Sun altitude [deg]")
    axes.legend()
    return text + "\n" + save(figure, "colour.png")
