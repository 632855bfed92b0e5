"""Computes ephemeris_sun.csv and ephemeris_sun_events.csv beside this file with Skyfield and JPL's DE421.

    pip install skyfield==1.55 skyfield-data==7.0.0
    python tests/reference/ephemeris_sun.py

Independent of the library in code and in ephemeris (numerical integration instead of a series). Before 1972 the time
given is read as UT1, from 1972 on as UTC. Altitude and azimuth are airless and topocentric on WGS84, polar motion zero.
"""

import pathlib
import random

from skyfield import almanac
from skyfield.api import Loader, wgs84
from skyfield_data import get_skyfield_data_path

HERE = pathlib.Path(__file__).resolve().parent
load = Loader(get_skyfield_data_path(), verbose=False)
timescale = load.timescale(builtin=True)
bodies = load("de421.bsp")
earth, sun = bodies["earth"], bodies["sun"]

PLACES = [
    (55.7047, 13.191, 50.0),
    (-33.9249, 18.4241, 25.0),
    (19.8207, -155.4681, 4205.0),
    (-77.8419, 166.6863, 10.0),
    (0.0, 0.0, 0.0),
    (78.2232, 15.6469, 0.0),
    (-0.1807, -78.4678, 2850.0),
    (40.7128, -74.006, 60000.0),
]
YEARS = [1900, 1918, 1937, 1950, 1965, 1971, 1974, 1983, 1992, 1999, 2005, 2013, 2020, 2026, 2035, 2050]


def positions():
    random.seed(2005)
    yield "latitude_deg,longitude_deg,elevation_m,time,jd_tt,jd_ut1,altitude_deg,azimuth_deg,distance_au"
    for count in range(48):
        latitude, longitude, elevation = PLACES[count % len(PLACES)]
        year, month, day = YEARS[count % 16 if count < 32 else (5 * count + 3) % 16], random.randint(1, 12), random.randint(1, 28)
        hour, minute = random.randint(0, 23), random.randint(0, 59)
        scale = timescale.ut1 if year < 1972 else timescale.utc
        time = scale(year, month, day, hour, minute)
        place = wgs84.latlon(latitude, longitude, elevation)
        altitude, azimuth, distance = (earth + place).at(time).observe(sun).apparent().altaz()
        yield (
            f"{latitude},{longitude},{elevation},{year}-{month:02}-{day:02}T{hour:02}:{minute:02}:00Z,{time.tt:.9f},{time.ut1:.9f},"
            f"{altitude.degrees:.7f},{azimuth.degrees:.7f},{distance.au:.9f}"
        )


DAYS = [
    (55.7047, 13.191, "2005-06-21T12:00:00+02:00", 2005, 6, 21, 2),
    (55.7047, 13.191, "2005-12-21T12:00:00+01:00", 2005, 12, 21, 1),
    (-33.9249, 18.4241, "2018-03-20T03:00:00+02:00", 2018, 3, 20, 2),
    (40.7128, -74.006, "1999-08-11T23:00:00-04:00", 1999, 8, 11, -4),
    (69.6492, 18.9553, "2013-11-30T12:00:00+01:00", 2013, 11, 30, 1),
    (0.0, 179.5, "2020-09-01T12:00:00+12:00", 2020, 9, 1, 12),
]
NAMES = [
    "astronomical_dawn", "nautical_dawn", "civil_dawn", "sunrise", "solar_noon", "sunset", "civil_dusk", "nautical_dusk", "astronomical_dusk",
]


def events():
    yield "latitude_deg,longitude_deg,day," + ",".join(NAMES)
    for latitude, longitude, text, year, month, day, offset in DAYS:
        place = wgs84.latlon(latitude, longitude)
        noon_clock = timescale.utc(year, month, day, 12 - offset)
        times, kinds = almanac.find_discrete(noon_clock - 0.5, noon_clock + 0.5, almanac.meridian_transits(bodies, sun, place))
        noon = [time for time, kind in zip(times, kinds) if kind == 1][0]
        found = {"solar_noon": noon}
        phases = almanac.dark_twilight_day(bodies, place)
        before = int(phases(noon - 0.5))
        for time, phase in zip(*almanac.find_discrete(noon - 0.5, noon + 0.5, phases)):
            name = NAMES[phase - 1] if phase > before else NAMES[9 - before]
            found[name] = time
            before = phase
        yield f"{latitude},{longitude},{text}," + ",".join(found[name].utc_iso() if name in found else "" for name in NAMES)


for name, rows in (("ephemeris_sun.csv", positions()), ("ephemeris_sun_events.csv", events())):
    with open(HERE / name, "w", encoding="ascii", newline="\n") as file:
        file.writelines(row + "\n" for row in rows)
