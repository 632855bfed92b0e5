"""Rebuilds data/scotopic1951.csv from PyPI colour-science (needs numpy, scipy, colour-science)."""

import colour
from packages import write_table

rods = colour.SDS_LEFS["CIE 1951 Scotopic Standard Observer"]
rows = [(int(wavelength), value) for wavelength, value in zip(rods.wavelengths, rods.values, strict=True)]
print("integral of V':", sum(value for _, value in rows))
write_table(
    "scotopic1951.csv",
    [
        "CIE 1951 scotopic luminous efficiency V', 1 nm (CIE 018:2019), dimensionless.",
        "Extracted from PyPI colour-science 0.4.7 (BSD-3-Clause).",
    ],
    "wavelength_nm,efficiency",
    rows,
    ["{:d}", "{:.10g}"],
)
