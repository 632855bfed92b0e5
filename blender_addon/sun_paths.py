# SPDX-License-Identifier: GPL-3.0-or-later
"""The ways of the Sun over a place as curves on a unit sphere: x = east, y = north, z = up. Nothing here touches bpy.

Curves follow the thesis's Sun (within 0.02 degrees, less than a line is wide) as refraction shows it. Clock times are those of one offset
from universal time, that of the moment that is shown: a year's curves do not jump where clocks are set forward or back.
"""

import datetime
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import skyprobe

DAY_S = 86400.0
# Airless altitude of the Sun's centre when its upper limb appears, as almanacs count [degrees].
RISE_ALTITUDE_DEG = -50.0 / 60.0
STEPS_OF_DAY = 288
STEPS_OF_YEAR = 73


@dataclass(frozen=True)
class Mark:
    """A named point of a curve."""

    text: str
    direction: np.ndarray  # (3,)


@dataclass(frozen=True)
class Day:
    """The way of the Sun over a local date."""

    path: np.ndarray  # from midnight to midnight, (N, 3)
    hours: tuple  # a Mark for each full hour of the clock
    rise: Mark | None
    set: Mark | None


@lru_cache(maxsize=2)
def _sky(latitude, longitude, elevation_m):
    """Return a sky that is asked for positions only: its time does not matter, and any clear air bends light alike."""
    place = {"latitude": latitude, "longitude": longitude, "elevation_m": elevation_m}
    return skyprobe.Sky(**place, time="2000-01-01T12:00:00+00:00", atmosphere=_air(), sun_model="thesis")


@lru_cache(maxsize=1)
def _air():
    return skyprobe.Atmosphere(preset="clear", quality="draft")


@lru_cache(maxsize=4)
def day(place, date, offset_s):
    """Return the Day of the datetime.date `date` at `place` (latitude, longitude [degrees], elevation [m]), by a clock `offset_s` ahead of UTC."""
    times = _midnight(date, offset_s) + np.linspace(0.0, DAY_S, STEPS_OF_DAY + 1)
    positions = _sky(*place).positions("Sun", times)
    path = directions(positions)
    hours = tuple(Mark(str(hour), path[hour * STEPS_OF_DAY // 24]) for hour in range(24))
    rise, fall = (_crossing(positions, sign) for sign in (1.0, -1.0))
    return Day(path, hours, rise, fall)


@lru_cache(maxsize=4)
def seasons(place, year, offset_s):
    """Return a Mark at noon and the path of each day on which the Sun turns, in June, March and December of `year`."""
    found = []
    for text, date in (("21 Jun", (6, 21)), ("20 Mar, 22 Sep", (3, 20)), ("21 Dec", (12, 21))):
        path = day(place, datetime.date(year, *date), offset_s).path
        found.append((Mark(text, path[np.argmax(path[:, 2])]), path))
    return tuple(found)


@lru_cache(maxsize=4)
def analemmas(place, year, offset_s):
    """Return the curve for each full hour of the clock: where the Sun stands then through `year`, closed, (24, N, 3)."""
    start = _midnight(datetime.date(year, 1, 1), offset_s)
    days = np.round(np.linspace(0.0, 365.0, STEPS_OF_YEAR + 1)) * DAY_S
    hours = np.arange(24)
    times = start + hours[:, None] * 3600.0 + days
    curves = directions(_sky(*place).positions("Sun", times.ravel())).reshape(24, -1, 3)
    # A year is not a whole number of days: the ends lie a quarter of a day's way apart, half a line's width.
    curves[:, -1] = curves[:, 0]
    return curves


def sun_and_moon(place, moment):
    """Return the directions of Sun and Moon, (3,) each, at the datetime `moment`."""
    sky, times = _sky(*place), [moment.timestamp()]
    return tuple(directions(sky.positions(name, times))[0] for name in ("Sun", "Moon"))


def directions(positions):
    """Return the unit vectors, (N, 3), of rows of skyprobe.Sky.positions, as refraction shows them."""
    azimuth, altitude = np.radians(positions[:, 1]), np.radians(positions[:, 2])
    return np.stack([np.cos(altitude) * np.sin(azimuth), np.cos(altitude) * np.cos(azimuth), np.sin(altitude)], axis=1)


def above_horizon(curve):
    """Return the ends of the lines, (2 M, 3), between neighbours of `curve`, (N, 3) or several (K, N, 3), cut off at the horizon."""
    first, second = (part.reshape(-1, 3) for part in (curve[..., :-1, :], curve[..., 1:, :]))
    seen = (first[:, 2] > 0.0) | (second[:, 2] > 0.0)
    first, second = first[seen], second[seen]
    # The share of a line after which it meets the horizon, of those that do.
    rise = second[:, 2] - first[:, 2]
    share = (-first[:, 2] / np.where(rise == 0.0, 1.0, rise))[:, None]
    meeting = first + share * (second - first)
    ends = np.stack([np.where(first[:, 2:] < 0.0, meeting, first), np.where(second[:, 2:] < 0.0, meeting, second)], axis=1)
    return ends.reshape(-1, 3)


def dashes_below_horizon(curve):
    """Return the ends of dashes, (2 M, 3), along the part of `curve` below the horizon: every other step."""
    steps = np.arange(0, len(curve) - 1, 2)
    steps = steps[(curve[steps, 2] < 0.0) & (curve[steps + 1, 2] < 0.0)]
    return curve[np.stack([steps, steps + 1], axis=1).ravel()]


def _midnight(date, offset_s):
    """Return when `date` begins [s since 1970]."""
    return datetime.datetime.combine(date, datetime.time(), datetime.timezone.utc).timestamp() - offset_s


def _crossing(positions, sign):
    """Return the Mark of sunrise (`sign` 1) or sunset (-1) among the `positions` of a day, or None."""
    height = sign * (positions[:, 0] - RISE_ALTITUDE_DEG)
    (steps,) = np.nonzero((height[:-1] < 0.0) & (height[1:] >= 0.0))
    if len(steps) == 0:
        return None
    step = steps[0]
    share = height[step] / (height[step] - height[step + 1])
    minutes = round((step + share) * 24.0 * 60.0 / STEPS_OF_DAY)
    # The azimuth may pass north between two steps; unit vectors do not care.
    first, second = directions(np.c_[positions[step : step + 2, :2], np.zeros(2)])
    direction = first + share * (second - first)
    return Mark(f"{minutes // 60 % 24:02d}:{minutes % 60:02d}", direction / np.linalg.norm(direction))
