# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panel tells of the sky, as text."""

import textwrap

from . import exposure, jobs, values

DEGREE = "\N{DEGREE SIGN}"
# Letters of a line that a narrow panel has room for.
LINE = 48
POINTS = ("N", "NE", "E", "SE", "S", "SW", "W", "NW")


def lines(shown, settings):
    """Return (icon, text) of each line on the live.Readout `shown`."""
    found = []
    result, day = shown.result, shown.day
    if result is not None:
        found.append(("LIGHT_SUN", f"Sun {where(result.sun)}"))
        if result.moon is not None:
            found.append(("LIGHT_HEMI", f"Moon {where(result.moon)}, {result.moon_fraction:.0%} lit"))
    if day is not None:
        sun = day.sun
        found.append(("TRIA_UP", f"Sunrise {clock(sun.sunrise)}, sunset {clock(sun.sunset)}"))
        found.append(("DOT", f"Dawn {clock(sun.civil_dawn)}, dusk {clock(sun.civil_dusk)}, noon {clock(sun.solar_noon)}"))
        found.append(("DOT", f"Moonrise {clock(day.moon_rise)}, moonset {clock(day.moon_set)}"))
    if result is not None:
        lux = result.horizontal_lx
        found.append(("OUTLINER_OB_LIGHT", f"{amount(lux)} lx on the ground (EV {exposure.exposure_value(lux):+.1f})"))
    return found


def where(lamp):
    """Return altitude and azimuth of a jobs.Lamp in words."""
    point = POINTS[round(lamp.azimuth_deg / 45.0) % 8]
    return f"{lamp.altitude_deg:.1f}{DEGREE} high, {lamp.azimuth_deg:.1f}{DEGREE} {point}"


def clock(moment):
    """Return the time of day of a datetime, a dash for None."""
    return f"{moment:%H:%M}" if moment is not None else "\N{EN DASH}"


def amount(value):
    """Return a number with three digits that count."""
    if value >= 1000.0:
        return f"{round(value, 3 - len(str(int(value)))):,.0f}"
    return f"{value:.3g}"


def zone(settings):
    """Return how the clock at the place stands to universal time, or an empty text if the settings make no sense."""
    try:
        return _zone(values.civil_time(settings))
    except jobs.USER_ERRORS:
        return ""


def _zone(civil):
    minutes = round(civil.time.utcoffset().total_seconds() / 60.0)
    offset = f"UTC{'-' if minutes < 0 else '+'}{abs(minutes) // 60:02d}:{abs(minutes) % 60:02d}"
    return ", ".join(filter(None, (civil.zone, offset, "daylight saving" if civil.is_daylight_saving else "")))


def wrapped(message):
    """Return the lines of a message for a narrow panel."""
    return textwrap.wrap(message, LINE) or [""]
