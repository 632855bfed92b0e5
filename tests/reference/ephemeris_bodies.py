"""Computes ephemeris_bodies.csv, ephemeris_rise_and_set.csv and ephemeris_moon_phases.csv beside this file with Skyfield and JPL's DE421.

    pip install skyfield==1.55 skyfield-data==7.0.0
    python tests/reference/ephemeris_bodies.py

Independent of the library in code and in ephemeris (numerical integration instead of series). Before 1972 the time
given is read as UT1, from 1972 on as UTC. Altitude and azimuth are airless and topocentric on WGS84, polar motion zero. Skyfield's magnitudes (Mallama &
Hilton 2018, Mars without face and season) count the distance from the Sun from the barycentre: here from the Sun.
"""

import pathlib
import random

import numpy as np
from skyfield import almanac, magnitudelib
from skyfield.api import Loader, wgs84
from skyfield_data import get_skyfield_data_path

HERE = pathlib.Path(__file__).resolve().parent
load = Loader(get_skyfield_data_path(), verbose=False)
timescale = load.timescale(builtin=True)
kernel = load("de421.bsp")
earth, sun = kernel["earth"], kernel["sun"]
BODIES = {"Moon": kernel["moon"], "Mercury": kernel["mercury"], "Venus": kernel["venus"]}
BODIES |= {name: kernel[f"{name.lower()} barycenter"] for name in ["Mars", "Jupiter", "Saturn", "Uranus", "Neptune"]}
POLES = {"Saturn": magnitudelib._SATURN_POLE, "Uranus": magnitudelib._URANUS_POLE}
PLACES = [
    (55.7047, 13.191, 50.0),
    (-33.9249, 18.4241, 25.0),
    (19.8207, -155.4681, 4205.0),
    (-77.8419, 166.6863, 10.0),
    (78.2232, 15.6469, 0.0),
    (-0.1807, -78.4678, 2850.0),
]
YEARS = [1900, 1918, 1937, 1950, 1965, 1971, 1974, 1983, 1992, 1999, 2005, 2013, 2020, 2026, 2035, 2050]


def magnitude(name, time, seen):
    sent = timescale.tdb_jd(time.tdb - seen.light_time)
    from_sun = BODIES[name].at(sent).xyz.au - sun.at(sent).xyz.au
    to_planet = seen.xyz.au
    angle = lambda a, b: np.degrees(np.arccos(a @ b / np.linalg.norm(a) / np.linalg.norm(b)))
    numbers = [np.linalg.norm(from_sun), np.linalg.norm(to_planet), angle(from_sun, to_planet)]
    if name in POLES:
        numbers += [angle(POLES[name], from_sun) - 90, angle(POLES[name], to_planet) - 90]
    if name == "Neptune":
        numbers.append(time.J)
    return float(getattr(magnitudelib, f"_{name.lower()}_magnitude")(*numbers)) if name != "Moon" else None


def positions():
    random.seed(1900)
    yield "body,latitude_deg,longitude_deg,elevation_m,jd_tt,jd_ut1,altitude_deg,azimuth_deg,distance_au,phase_angle_deg,magnitude"
    for count in range(64):
        latitude, longitude, elevation = PLACES[count % len(PLACES)]
        year, month, day = YEARS[count % 16], random.randint(1, 12), random.randint(1, 28)
        scale = timescale.ut1 if year < 1972 else timescale.utc
        time = scale(year, month, day, random.randint(0, 23), random.randint(0, 59))
        place = earth + wgs84.latlon(latitude, longitude, elevation)
        for name, body in BODIES.items():
            seen = place.at(time).observe(body)
            altitude, azimuth, distance = seen.apparent().altaz()
            value = magnitude(name, time, seen)
            # Without year of a phase function Skyfield has no magnitude of Neptune near quadrature before 2000.
            text = "" if value is None or np.isnan(value) else f"{value:.4f}"
            yield (
                f"{name},{latitude},{longitude},{elevation},{time.tt:.9f},{time.ut1:.9f},{altitude.degrees:.7f},{azimuth.degrees:.7f},"
                f"{distance.au:.9f},{seen.phase_angle(sun).degrees:.5f},{text}"
            )


DAYS = [
    (55.7047, 13.191, "2005-06-21T12:00:00+02:00", 2005, 6, 21, 2),
    (55.7047, 13.191, "2005-12-14T12:00:00+01:00", 2005, 12, 14, 1),
    (-33.9249, 18.4241, "2018-03-20T03:00:00+02:00", 2018, 3, 20, 2),
    (40.7128, -74.006, "1999-08-11T23:00:00-04:00", 1999, 8, 11, -4),
    (69.6492, 18.9553, "2013-11-30T12:00:00+01:00", 2013, 11, 30, 1),
    (0.0, 179.5, "2020-09-01T12:00:00+12:00", 2020, 9, 1, 12),
]


def events():
    yield "body,latitude_deg,longitude_deg,day,rise,transit,set"
    for latitude, longitude, text, year, month, day, offset in DAYS:
        place = wgs84.latlon(latitude, longitude)
        start = timescale.utc(year, month, day, -offset)
        for name, body in BODIES.items():

            def is_up(time):
                altitude, _, distance = (earth + place).at(time).observe(body).apparent().altaz()
                radius = np.degrees(np.arcsin(1737.4 / distance.km)) if name == "Moon" else 0.0
                return altitude.degrees + 34 / 60 + radius >= 0

            is_up.step_days = 0.01
            times, states = almanac.find_discrete(start, start + 1, is_up)
            transits, kinds = almanac.find_discrete(start, start + 1, almanac.meridian_transits(kernel, body, place))
            first = lambda moments: moments[0].utc_iso() if len(moments) else ""
            select = lambda moments, wanted: [moment for moment, state in zip(moments, wanted) if state]
            rises, sets = select(times, states), select(times, 1 - np.array(states, int))
            yield f"{name},{latitude},{longitude},{text},{first(rises)},{first(select(transits, kinds))},{first(sets)}"


def phases():
    yield "time,new,first_quarter,full,last_quarter"
    for year, month in [(1974, 3), (1983, 6), (1999, 8), (2005, 1), (2018, 1), (2026, 11)]:
        start = timescale.utc(year, month, 2)
        times, kinds = almanac.find_discrete(start, start + 31, almanac.moon_phases(kernel))
        first = {}
        for time, kind in zip(times, kinds):
            first.setdefault(int(kind), time.utc_iso())
        yield ",".join([start.utc_iso()] + [first[kind] for kind in range(4)])


for name, rows in (("bodies", positions()), ("rise_and_set", events()), ("moon_phases", phases())):
    with open(HERE / f"ephemeris_{name}.csv", "w", encoding="ascii", newline="\n") as file:
        file.writelines(row + "\n" for row in rows)
