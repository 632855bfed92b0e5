"""Skies of Kider et al. (2014): with fixed air, with the haze fitted to each scan, and with the named hazes."""

import numpy as np
import skyprobe as sp
from common import markdown, own_table, rms
from figures import plt, save
from kider import CENTRES_NM, SCANS, Haze, Scan, air, sunlight
from scipy.interpolate import CubicSpline
from scipy.optimize import lsq_linear, minimize_scalar

DISORT = [11.3, 6.9, 8.3, 13.1, 7.8, 8.4, 19.7, 12.9]
# Bruneton (2016), table 2: over 15 scans, of which eight are here.
OTHERS = "Preetham 88.1, O'Neal 49.5, Hosek 41.5, Nishita 18.3, Haber 14.7, Bruneton 11.3"
ANGLES_DEG = np.concatenate([np.arange(0, 5, 0.25), np.arange(5, 30, 1.0), np.arange(30, 181, 3.0)])

# ln beta, alpha, single scattering albedo, and two Henyey-Greenstein lobes: their asymmetries and the weight of the first.
NAMES = ["AOD 550", "alpha", "albedo", "g1", "g2", "weight of g1"]
START = np.array([np.log(0.05), 1.0, 0.85, 0.80, 0.40, 0.55])
LOW = np.array([np.log(0.01), -0.3, 0.6, 0.5, -0.3, 0.02])
HIGH = np.array([np.log(0.20), 2.8, 1.0, 0.96, 0.7, 0.98])
STEP = np.array([0.1, 0.1, -0.05, 0.02, 0.04, 0.05])


def lobe(g: float) -> np.ndarray:
    return (1 - g * g) / (1 + g * g - 2 * g * np.cos(np.radians(ANGLES_DEG))) ** 1.5


def fitted_air(p: np.ndarray, quality: str) -> sp.Atmosphere:
    phase = sp.Phase.tabulated(ANGLES_DEG, p[5] * lobe(p[3]) + (1 - p[5]) * lobe(p[4]))
    return air(Haze(beta=float(np.exp(p[0])), alpha=p[1], albedo=p[2]), phase, quality=quality, cache=False)


def fit(scan: Scan, start_left: np.ndarray, jacobian: np.ndarray, applications: int = 9) -> np.ndarray:
    """Least squares from START: steps of a bounded linear problem whose Jacobian is mended by Broyden's rule, each step one draft solve."""
    p, left, jacobian, trust = START.copy(), start_left, jacobian.copy(), 1.0
    reach = 6 * np.abs(STEP)
    for _ in range(applications):
        bounds = np.maximum(LOW - p, -trust * reach) - 1e-9, np.minimum(HIGH - p, trust * reach) + 1e-9
        step = lsq_linear(jacobian, -left, bounds=bounds).x
        if np.all(np.abs(step) < 0.02 * np.abs(STEP)):
            break
        tried = scan.compare(fitted_air(np.clip(p + step, LOW, HIGH), "draft"))[1].ravel()
        jacobian += np.outer(tried - left - jacobian @ step, step) / (step @ step)
        if tried @ tried < left @ left:
            p, left = np.clip(p + step, LOW, HIGH), tried
        else:
            trust *= 0.4
    return p


def fit_all(scans: list[Scan]) -> list[np.ndarray]:
    """The hazes of all scans; one set of solves gives every scan's first Jacobian."""
    base = fitted_air(START, "draft")
    beside = [fitted_air(START + step, "draft") for step in np.diag(STEP)]
    results = []
    for scan in scans:
        left = scan.compare(base)[1].ravel()
        jacobian = np.stack([(scan.compare(near)[1].ravel() - left) / step for near, step in zip(beside, STEP, strict=True)], axis=1)
        results.append(fit(scan, left, jacobian))
    return results


def named_hazes(scans: list[Scan]) -> tuple[list[list[str]], float]:
    """Best type and amount for each scan, with draft solves; bands from 383.5 nm because the presets begin at 380 nm."""
    bands = CENTRES_NM > 383.5
    wavelengths = CENTRES_NM[bands]
    table = own_table("solar_spectrum.csv")
    ten = [np.mean(table["irradiance"][np.abs(table["wavelength_nm"] - w) <= 5]) for w in wavelengths]
    scale = 1000 * sunlight()[bands] / ten
    depths = np.array([0.02, 0.05, 0.10, 0.18])
    types = ["continental_clean", "continental_average", "continental_polluted", "urban", "maritime_clean", "desert", "antarctic"]
    best = {scan.name: (np.inf, "", 0.0) for scan in scans}
    for name in types:
        airs = [sp.Atmosphere(preset="clear", aerosol=name, aod550=d, ground="grass", quality="draft", polarisation=True) for d in depths]
        for scan in scans:
            skies = [scan.sky(one) for one in airs]
            measured = scan.radiance[:, bands]

            def spline(offset: float) -> CubicSpline:
                look = scan.look(offset)
                return CubicSpline(depths, np.log([scale * sky.spectral_radiance(look, wavelengths) for sky in skies]))

            def left(depth: float, offset: float) -> float:
                return rms(np.exp(spline(offset)(depth)) - measured)

            offset = -13.0
            for _ in range(2):
                over_depth = spline(offset)
                found = minimize_scalar(lambda d: rms(np.exp(over_depth(d)) - measured), bounds=(0.01, 0.25), method="bounded")
                offset = minimize_scalar(lambda o: left(found.x, o), bounds=(-20, -8), method="bounded", options={"xatol": 0.1}).x
            best[scan.name] = min(best[scan.name], (left(found.x, offset), name, found.x))
    rows = [[name, f"{error:.1f}", f"`{kind}`", f"{depth:.3f}"] for name, (error, kind, depth) in best.items()]
    return rows, rms([error for error, _, _ in best.values()])


def plot(scans: list[Scan], fixed: list[np.ndarray], fitted: list[np.ndarray]) -> str:
    figure, axes = plt.subplots(2, 8, figsize=(14, 4), subplot_kw={"projection": "polar"})
    green = np.abs(CENTRES_NM - 550) < 30
    for row, lefts in zip(axes, (fixed, fitted), strict=True):
        for panel, scan, left in zip(row, scans, lefts, strict=True):
            relative = 100 * left[:, green].sum(axis=1) / scan.radiance[:, green].sum(axis=1)
            dots = panel.scatter(np.radians(scan.azimuth_deg), 90 - scan.altitude_deg, c=relative, cmap="RdBu_r", vmin=-20, vmax=20, s=16)
            panel.set(theta_zero_location="N", theta_direction=-1, xticks=[], yticks=[], title=scan.name)
    axes[0, 0].set_ylabel("fixed", labelpad=20)
    axes[1, 0].set_ylabel("fitted", labelpad=20)
    figure.colorbar(dots, ax=axes, label="model / measured - 1 at 550 nm [%]", shrink=0.7)
    return save(figure, "measured_skies.png")


def report() -> str:
    scans = [Scan(name) for name in SCANS]
    polarised, scalar = air(Haze()), air(Haze(), polarisation=False)
    fixed = [scan.compare(polarised) for scan in scans]
    flat = [scan.compare(scalar)[1] for scan in scans]
    hazes = fit_all(scans)
    fitted = [scan.compare(fitted_air(p, "high"))[1] for scan, p in zip(scans, hazes, strict=True)]
    rows = []
    for scan, disort, (offset, left), plain, p, best in zip(scans, DISORT, fixed, flat, hazes, fitted, strict=True):
        shown = [f"{np.exp(p[0]) * 0.55 ** -p[1]:.3f}", *(f"{value:.2f}" for value in p[1:])]
        rows.append([scan.name, disort, f"{rms(plain):.1f}", f"{rms(left):.1f}", f"{offset:.1f}", f"{rms(best):.1f}", *shown])
    total = [rms([rms(left) for left in lefts]) for lefts in (flat, [left for _, left in fixed], fitted)]
    rows.append(["**all**", f"{rms(DISORT):.1f}", f"{total[0]:.2f}", f"**{total[1]:.2f}**", "", f"**{total[2]:.2f}**", *[""] * 6])
    header = ["scan", "DISORT, flat, scalar", "scalar", "polarised", "azimuth offset [deg]", "haze fitted", *NAMES]
    named, all_named = named_hazes(scans)
    text = markdown(header, rows) + f"\nOther models (15 scans, Bruneton 2016): {OTHERS}.\n\n"
    text += markdown(["scan", "RMSE", "type", "AOD 550"], [*named, ["**all**", f"**{all_named:.2f}**", "", ""]])
    return text + "\n" + plot(scans, [left for _, left in fixed], fitted)
