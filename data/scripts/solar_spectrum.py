"""Rebuilds data/solar_spectrum.csv from PyPI pyspectral (needs numpy)."""

import numpy as np

from packages import unpack_from_pypi, write_table


def bin_means(wavelength, irradiance, centres):
    """Means over [c - 0.5, c + 0.5] of the piecewise linear curve, so that energy is conserved."""
    edges = np.concatenate([centres - 0.5, [centres[-1] + 0.5]])
    integral = np.concatenate([[0.0], np.cumsum(np.diff(wavelength) * (irradiance[1:] + irradiance[:-1]) / 2)])
    index = np.clip(np.searchsorted(wavelength, edges) - 1, 0, len(wavelength) - 2)
    step = edges - wavelength[index]
    slope = (irradiance[index + 1] - irradiance[index]) / (wavelength[index + 1] - wavelength[index])
    return np.diff(integral[index] + step * (irradiance[index] + slope * step / 2))


def main():
    folder = unpack_from_pypi("pyspectral==0.14.3")
    table = np.loadtxt(next(folder.rglob("e490_00a.dat")), comments="#")
    wavelength, irradiance = table[:, 0] * 1000.0, table[:, 1] / 1000.0
    print("solar constant [W m-2]:", np.trapezoid(irradiance, wavelength))
    centres = np.arange(300, 1001, dtype=float)
    means = bin_means(wavelength, irradiance, centres)
    print("10 nm mean at 400 nm [W m-2 nm-1]:", (means[96:105].sum() + (means[95] + means[105]) / 2) / 10)
    write_table(
        "solar_spectrum.csv",
        [
            "Solar irradiance outside the atmosphere at 1 au, means over 1 nm [W m-2 nm-1].",
            "ASTM E490-00a, from PyPI pyspectral 0.14.3 (Apache-2.0), integrated piecewise linearly.",
        ],
        "wavelength_nm,irradiance",
        [(int(w), e) for w, e in zip(centres, means)],
        ["{:d}", "{:.5f}"],
    )


if __name__ == "__main__":
    main()
