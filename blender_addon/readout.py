# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel tells of the sky, as text."""

import datetime
import functools
import textwrap

from skyprobe import places

from . import exposure, jobs, values

DEGREE, DASH = "\N{DEGREE SIGN}", "\N{EN DASH}"
# Letters of a line that a narrow panel has room for.
LINE = 48
POINTS = ("N", "NE", "E", "SE", "S", "SW", "W", "NW")


def lines(shown, settings):
    """Return (icon, text) of each line on the live.Readout `shown`."""
    found = []
    result, day = shown.result, shown.day
    if result is not None:
        found.append(("LIGHT_SUN", f"Sun {where(result.sun)}"))
    if day is not None:
        sun = day.sun
        found.append(("BLANK1", f"up {clock(sun.sunrise)} {DASH} {clock(sun.sunset)}, noon {clock(sun.solar_noon)}"))
        found.append(("BLANK1", f"twilight {clock(sun.civil_dawn)} {DASH} {clock(sun.civil_dusk)}"))
    if result is not None and result.moon is not None:
        found.append(("LIGHT_HEMI", f"Moon {where(result.moon)}"))
        up = "" if day is None else f", rises {clock(day.moon_rise)}, sets {clock(day.moon_set)}"
        found.append(("BLANK1", f"{result.moon_fraction:.0%} lit{up}"))
    if result is not None:
        lux = result.horizontal_lx
        found.append(("OUTLINER_OB_LIGHT", f"{amount(lux)} lx, EV {exposure.exposure_value(lux):+.1f}"))
    return found


def where(lamp):
    """Return altitude and azimuth of a jobs.Lamp in words."""
    point = POINTS[round(lamp.azimuth_deg / 45.0) % 8]
    return f"{lamp.altitude_deg:.1f}{DEGREE} high, {lamp.azimuth_deg:.1f}{DEGREE} {point}"


def clock(moment):
    """Return the time of day of a datetime to the nearest minute, as almanacs give it, a dash for None."""
    return f"{moment + datetime.timedelta(seconds=30):%H:%M}" if moment is not None else DASH


def amount(value):
    """Return a number with three digits that count."""
    if value >= 1000.0:
        return f"{round(value, 3 - len(str(int(value)))):,.0f}"
    return f"{value:.3g}"


def place(settings):
    """Return what place the coordinates are at, such as 12 km N of Lund, or an empty text if they are none."""
    try:
        return _nearest(**values.coordinates(settings))
    except jobs.USER_ERRORS:
        return ""


# A panel is drawn at every move of the mouse.
@functools.lru_cache(maxsize=64)
def _nearest(latitude, longitude):
    return places.nearest(latitude, longitude).label


def time(settings):
    """Return the time of day of the settings with its seconds, or a dash if it is no number."""
    try:
        return "{:02d}:{:02d}:{:02d}".format(*values.clock(settings))
    except ValueError:
        return DASH


def zone(settings):
    """Return the lines that say how the clock at the place stands to universal time; none if the settings make no sense."""
    try:
        civil = values.civil_time(settings)
    except jobs.USER_ERRORS:
        return []
    minutes = round(60.0 * civil.utc_offset_h)
    offset = f"UTC{'-' if minutes < 0 else '+'}{abs(minutes) // 60:02d}:{abs(minutes) % 60:02d}"
    found = [", ".join(filter(None, (civil.zone, offset)))]
    if civil.daylight_saving:
        found.append(f"Daylight saving time ({civil.abbreviation})")
    if civil.notice:
        found.extend(wrapped(civil.notice))
    return found


def wrapped(message):
    """Return the lines of a message for a narrow panel."""
    return textwrap.wrap(message, LINE) or [""]
