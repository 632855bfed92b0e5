"""Rebuilds data/delta_t.csv and data/leap_seconds.csv from the wheel of skyfield 1.55.

    pip download --no-deps skyfield==1.55 -d DOWNLOADS
    python data/scripts/delta_t.py DOWNLOADS/skyfield-1.55-py3-none-any.whl

Needs numpy. Where each row comes from is in data/README.md.
"""

import datetime
import io
import pathlib
import sys
import zipfile

import numpy as np

FIRST_YEAR = 1000
FIRST_YEARLY = 1900
FIRST_HALF_YEARLY = 1972
DATA = pathlib.Path(__file__).resolve().parent.parent
J0_YEAR_ZERO = 1721045.0  # Julian date of the year 0 in the count of Julian years that table S15 uses


def julian_date(year, month=1, day=1):
    return datetime.date(year, month, day).toordinal() + 1721424.5


def s15_delta_t(table, jd):
    year = (jd - J0_YEAR_ZERO) / 365.25
    column = np.searchsorted(table[0], year, side="right") - 1
    start, end, cubic, square, linear, constant = table[:, column]
    t = (year - start) / (end - start)
    return constant + t * (linear + t * (square + t * cubic))


def main(wheel_path):
    wheel = zipfile.ZipFile(wheel_path)
    load = lambda name: np.load(io.BytesIO(wheel.read(f"skyfield/data/{name}")))
    s15 = load("delta_t.npz")["Table-S15.2020.txt"]
    half_yearly_jd, half_yearly = load("historic_deltat.npy")
    iers = load("iers.npz")
    daily_jd = iers["tt_jd_minus_arange"] + np.arange(len(iers["tt_jd_minus_arange"]))
    daily = iers["delta_t_1e7"] / 1e7

    rows = []
    years = list(range(FIRST_YEAR, FIRST_YEARLY, 5)) + list(range(FIRST_YEARLY, FIRST_HALF_YEARLY))
    rows += [(julian_date(year), s15_delta_t(s15, julian_date(year))) for year in years]
    near_1972 = (half_yearly_jd >= julian_date(FIRST_HALF_YEARLY)) & (half_yearly_jd < daily_jd[0])
    rows += list(zip(half_yearly_jd[near_1972], half_yearly[near_1972]))
    dates = [datetime.date.fromordinal(int(jd + 0.5) - 1721425) for jd in daily_jd]
    months = np.array([date.year * 12 + date.month for date in dates])
    rows += [(daily_jd[months == month].mean(), daily[months == month].mean()) for month in np.unique(months)]

    with open(DATA / "delta_t.csv", "w", encoding="ascii", newline="\n") as file:
        file.write("jd,delta_t_s\n")
        file.writelines(f"{jd:.2f},{delta_t:.4f}\n" for jd, delta_t in rows)

    with open(DATA / "leap_seconds.csv", "w", encoding="ascii", newline="\n") as file:
        file.write("jd_utc,tai_minus_utc_s\n")
        file.write(f"{julian_date(1972)},10\n")
        file.writelines(f"{jd},{offset:.0f}\n" for jd, offset in zip(iers["leap_dates"], iers["leap_offsets"]))


if __name__ == "__main__":
    main(sys.argv[1])
