"""The solved light against tables of independent codes: DISORT, Monte Carlo, Natraj, Li & Yung (2009)."""

import numpy as np
import skyprobe as sp
from common import (
    FLAT_RADIUS_KM,
    ROOT,
    column,
    directions,
    markdown,
    read_table,
    reference,
    rms,
)
from figures import plt, save

AIR = ["tau_rayleigh", "tau_aerosol", "tau_ozone", "ground_albedo"]


def airs(table: dict[str, np.ndarray], radius_km: float, **options) -> tuple[sp.Atmosphere, np.ndarray, np.ndarray]:
    """The airs that a table names side by side as wavelengths of one air, those wavelengths, and each row's air."""
    keys, air_of_row = np.unique(np.stack([table[name] for name in AIR], axis=1), axis=0, return_inverse=True)
    rayleigh, aerosol, ozone, albedo = keys.T
    z = np.arange(201) * 0.5
    none = np.zeros((len(z), len(keys)))
    haze = column(z, aerosol, np.exp(-z / 1.5))
    components = [
        sp.Component(scattering=column(z, rayleigh, np.exp(-z / 8.0)), absorption=none, phase=sp.Phase.rayleigh(depolarisation=0.0)),
        sp.Component(scattering=0.95 * haze, absorption=0.05 * haze, phase=sp.Phase.henyey_greenstein(0.7)),
        sp.Component(scattering=none, absorption=column(z, ozone, np.maximum(0.0, 1 - np.abs(z - 25) / 15)), phase=None),
    ]
    wavelengths = 400.0 + np.arange(len(keys))
    air = sp.Atmosphere.from_profile(
        z,
        wavelengths,
        components,
        solar_irradiance=1.0,
        ground_albedo=albedo,
        planet_radius_km=radius_km,
        quality="high",
        **{"polarisation": False, "sun_angular_radius_deg": np.degrees(0.00465), **options},
    )
    return air, wavelengths, np.ravel(air_of_row)


def computed(table: dict[str, np.ndarray], radius_km: float) -> np.ndarray:
    """Radiance in each row's direction and air."""
    air, wavelengths, air_of_row = airs(table, radius_km)
    result = np.empty(len(air_of_row))
    heights = table.get("observer_altitude_km", np.zeros(len(result)))
    for zenith, height in {*zip(table["sun_zenith_deg"], heights, strict=True)}:
        rows = np.flatnonzero((table["sun_zenith_deg"] == zenith) & (heights == height))
        sky = sp.Sky.with_sun(altitude_deg=90 - zenith, azimuth_deg=0.0, elevation_m=1000 * height, atmosphere=air)
        look = directions(90 - table["view_zenith_deg"][rows], table["relative_azimuth_deg"][rows])
        result[rows] = sky.spectral_radiance(look, wavelengths)[np.arange(len(rows)), air_of_row[rows]]
    return result


def by_zenith(name: str, table: dict[str, np.ndarray], error: np.ndarray, noise: np.ndarray) -> list[list[str]]:
    rows = []
    for zenith in np.unique(table["sun_zenith_deg"]):
        part = error[table["sun_zenith_deg"] == zenith]
        own = rms(noise[table["sun_zenith_deg"] == zenith])
        rows.append(
            [
                name,
                f"{zenith:g}",
                len(part),
                f"{100 * part.mean():+.2f} %",
                f"{100 * rms(part):.2f} %",
                f"{100 * np.abs(part).max():.2f} %",
                f"{100 * own:.2f} %" if own else "-",
            ]
        )
    return rows


def doubling(tau: str) -> dict[str, np.ndarray]:
    """The rows of the project's own table at one optical depth, with the signs of Natraj et al."""
    table = read_table(ROOT / "tests" / "reference" / "rayleigh_polarised.csv")
    rows = table["tau"] == float(tau)
    return {name: (-1 if name in "QU" else 1) * values[rows] for name, values in table.items()}


def polarised(name: str, tau: str, table: dict[str, np.ndarray]) -> tuple[list[object], np.ndarray]:
    """A polarised table at one optical depth, as its row of figures, and the relative errors of I."""
    table = {name: values[(table["mu"] >= 0.1)] for name, values in table.items()}
    zero = np.zeros(len(table["I"]))
    table |= {"tau_rayleigh": zero + float(tau), "tau_aerosol": zero, "tau_ozone": zero, "ground_albedo": table["albedo"]}
    intensity, scalar, degree = np.zeros((3, len(zero)))
    for result, polarisation in ((intensity, True), (scalar, False)):
        air, wavelengths, air_of_row = airs(table, FLAT_RADIUS_KM, polarisation=polarisation, sun_angular_radius_deg=0.0)
        for mu0 in np.unique(table["mu0"]):
            rows = np.flatnonzero(table["mu0"] == mu0)
            sky = sp.Sky.with_sun(altitude_deg=np.degrees(np.arcsin(mu0)), azimuth_deg=0.0, atmosphere=air)
            look = directions(np.degrees(np.arcsin(table["mu"][rows])), -table["phi_deg"][rows])
            each = np.arange(len(rows)), air_of_row[rows]
            result[rows] = np.pi * sky.spectral_radiance(look, wavelengths)[each]
            if polarisation:
                found = np.pi * sky.stokes(look, wavelengths)[each]
                # The tables have the opposite sign of Q; that of U depends on the side of the Sun.
                q, u = found[:, 1] + table["Q"][rows], np.abs(found[:, 2]) - np.abs(table["U"][rows])
                degree[rows] = np.hypot(q, u) / table["I"][rows]
    error = intensity / table["I"] - 1
    figures = [f"{100 * rms(error):.3f} %", f"{100 * np.abs(error).max():.3f} %", f"{degree.max():.4f}", f"{100 * rms(scalar / table['I'] - 1):.2f} %"]
    return [name, tau, len(error), *figures], error


def report() -> str:
    flat = read_table(reference("radiance/plane_parallel_scalar_disort.csv"))
    round_ = read_table(reference("radiance/spherical_scalar_monte_carlo.csv"))
    flat_error = computed(flat, FLAT_RADIUS_KM) / flat["radiance"] - 1
    truth = round_["single_scattering"] + round_["multiple_scattering"]
    round_error = computed(round_, 6371.0) / truth - 1
    noise = round_["standard_error"] / truth
    rows = by_zenith("DISORT, flat", flat, flat_error, np.zeros_like(flat_error)) + by_zenith("Monte Carlo, sphere", round_, round_error, noise)
    day = round_["sun_zenith_deg"] <= 94
    rows.append(
        [
            "DISORT, flat",
            "all",
            len(flat_error),
            f"{100 * flat_error.mean():+.2f} %",
            f"**{100 * rms(flat_error):.2f} %**",
            f"{100 * np.abs(flat_error).max():.2f} %",
            "-",
        ]
    )
    rows.append(
        [
            "Monte Carlo, sphere",
            "to 94",
            day.sum(),
            f"{100 * round_error[day].mean():+.2f} %",
            f"**{100 * rms(round_error[day]):.2f} %**",
            f"{100 * np.abs(round_error[day]).max():.2f} %",
            f"{100 * rms(noise[day]):.2f} %",
        ]
    )
    text = markdown(["reference", "Sun zenith", "rows", "mean", "rms", "largest", "its own standard error"], rows)
    found = [polarised("doubling", tau, doubling(tau)) for tau in ("0.02", "0.05", "0.15", "0.25", "1")]
    found += [polarised("Natraj et al.", tau, read_table(reference(f"natraj2009/downwelling_tau_{tau}.csv"))) for tau in ("0.1", "0.5")]
    found.sort(key=lambda pair: float(pair[0][1]))
    text += "\n" + markdown(
        ["polarised Rayleigh sky", "optical depth", "rows", "I, rms", "I, largest", "(Q, U) / I, largest", "scalar solution's I, rms"], [row for row, _ in found]
    )
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.2), sharey=True)
    for axes, table, error, name in ((left, flat, flat_error, "DISORT, flat"), (right, round_, round_error, "Monte Carlo, sphere")):
        for aerosol in np.unique(table["tau_aerosol"]):
            part = table["tau_aerosol"] == aerosol
            jitter = np.random.default_rng(1).uniform(-0.7, 0.7, part.sum())
            axes.plot(table["sun_zenith_deg"][part] + jitter, 100 * error[part], ".", ms=3, label=f"aerosol optical depth {aerosol:g}")
        axes.set(xlabel="Sun zenith angle [deg]", title=name, ylim=(-8, 8))
        axes.legend()
    bars = [100 * rms(noise[round_["sun_zenith_deg"] == zenith]) for zenith in np.unique(round_["sun_zenith_deg"])]
    right.errorbar(np.unique(round_["sun_zenith_deg"]), np.zeros(len(bars)), bars, fmt="none", color="k", capsize=3)
    left.set_ylabel("skyprobe / reference - 1 [%]")
    return text + "\n" + save(figure, "tables.png")
