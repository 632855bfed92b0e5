"""Rebuilds data/cie1931.csv from PyPI colour-science (needs numpy, scipy, colour-science)."""

import colour

from packages import write_table

cmf = colour.MSDS_CMFS["CIE 1931 2 Degree Standard Observer"]
rows = [(int(w), *cmf[w]) for w in cmf.wavelengths if 360 <= w <= 830]
print("integral of ybar:", sum(row[2] for row in rows))
write_table(
    "cie1931.csv",
    [
        "CIE 1931 2 degree colour matching functions, 1 nm (CIE 018:2019), dimensionless.",
        "Extracted from PyPI colour-science 0.4.7 (BSD-3-Clause).",
    ],
    "wavelength_nm,xbar,ybar,zbar",
    rows,
    ["{:d}"] + ["{:.10g}"] * 3,
)
