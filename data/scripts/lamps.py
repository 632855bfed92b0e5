"""Rebuilds data/lamps.csv: spectra of street lamps, CIE 015:2018, as PyPI colour-science carries them."""

import colour
import numpy as np
from packages import write_table

LAMPS = {"HP1": "high pressure sodium", "LED-B3": "white LED, 4103 K"}
WAVELENGTHS = range(380, 781, 5)


def main():
    columns = []
    for name in LAMPS:
        spectrum = colour.SDS_ILLUMINANTS[name]
        values = np.interp(WAVELENGTHS, spectrum.wavelengths, spectrum.values)
        columns.append(values / values.max())
    write_table(
        "lamps.csv",
        ["Relative spectral power of street lamps, CIE 015:2018, as PyPI colour-science 0.4.7 carries it (BSD-3-Clause), largest value 1."]
        + [f"{name}: {what}." for name, what in LAMPS.items()],
        "wavelength_nm,sodium,led",
        list(zip(WAVELENGTHS, *columns, strict=True)),
        ["{:d}", "{:.4f}", "{:.4f}"],
    )


if __name__ == "__main__":
    main()
