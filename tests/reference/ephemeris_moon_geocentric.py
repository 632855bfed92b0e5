"""Computes ephemeris_moon_geocentric.csv beside this file from JPL's DE421: position and orientation of the Moon.

    pip install numpy==2.2.6 jplephem==2.24 de421==2008.1
    python tests/reference/ephemeris_moon_geocentric.py

Columns: Julian date (TDB), geocentric x, y, z of the Moon's centre without light time [km, ICRS], longitude and latitude below which the centre of the
Earth stands, in DE421's mean Earth frame [degrees]. DE421 integrates Euler angles of the Moon's principal axes; its mean Earth frame
is turned from them by 67.92, 78.56 and 0.30 arcseconds about z, y and x (Williams, Boggs & Folkner 2008, JPL IOM 335-JW,DB,WF-20080314-001).
"""

import pathlib

import de421
import numpy as np
from jplephem.ephem import Ephemeris

HERE = pathlib.Path(__file__).resolve().parent
ARCSECOND = np.pi / 648000


def turn(axis: int, angle: float) -> np.ndarray:
    """Matrix that gives components along axes turned by `angle` about axis 0, 1 or 2."""
    c, s = np.cos(angle), np.sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = s, -s
    return matrix


TO_MEAN_EARTH = turn(0, -0.30 * ARCSECOND) @ turn(1, -78.56 * ARCSECOND) @ turn(2, -67.92 * ARCSECOND)
ephemeris = Ephemeris(de421)
with open(HERE / "ephemeris_moon_geocentric.csv", "w", encoding="ascii", newline="\n") as file:
    file.write("jd_tdb,x_km,y_km,z_km,sub_earth_longitude_deg,sub_earth_latitude_deg\n")
    for count in range(160):
        date = round(2415100.0 + 341.71828 * count, 4)
        moon = np.ravel(ephemeris.position("moon", date))
        phi, theta, psi = np.ravel(ephemeris.position("librations", date))
        to_principal = turn(2, psi) @ turn(0, theta) @ turn(2, phi)
        x, y, z = TO_MEAN_EARTH @ to_principal @ -moon
        longitude, latitude = np.degrees([np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))])
        file.write(f"{date:.4f},{moon[0]:.4f},{moon[1]:.4f},{moon[2]:.4f},{longitude:.5f},{latitude:.5f}\n")
