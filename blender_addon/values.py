# SPDX-License-Identifier: GPL-3.0-or-later
"""From what the panel holds to the plain values that the skyprobe library takes, and the times that a panel can mean."""

import datetime
import math
import os
import re
from dataclasses import replace

import bpy
from skyprobe import places

from . import choices, compat, jobs

# Values of the air that a switch takes from the preset.
OPTIONAL_AIR = (
    ("use_humidity", "relative_humidity"),
    ("use_ozone", "ozone_du"),
    ("use_stratosphere", "stratospheric_aod550"),
)
# Years of the civil date.
FIRST_YEAR, LAST_YEAR = 1000, 3000
# Letters that no zone's name has more of.
LONGEST_ZONE = 64
# The longest path that Blender keeps [bytes].
LONGEST_PATH = 1023
# The preview's air is solved as coarsely as the library offers.
PREVIEW_QUALITY = "draft"
# Digits of a request's digest in the name of its file.
DIGITS = 8
# What the eye sees at best [magnitude].
PREVIEW_STAR_LIMIT = 6.5


def air(settings, quality=None):
    """Return the keywords of skyprobe.Atmosphere; what is left to the preset is absent."""
    keywords = {"preset": settings.preset, "quality": quality or settings.quality}
    for name in ("aerosol", "ground"):
        if getattr(settings, name) != choices.OF_PRESET:
            keywords[name] = getattr(settings, name)
    if settings.haze != choices.OF_PRESET:
        keywords[settings.haze] = as_typed(getattr(settings, settings.haze))
    for switch, name in OPTIONAL_AIR:
        if getattr(settings, switch):
            keywords[name] = as_typed(getattr(settings, name))
    return keywords


def polarising_filter(settings):
    """Return the keywords of skyprobe.PolarisingFilter, or None without a filter."""
    if settings.filter_mode == "NONE":
        return None
    keywords = {"strength": as_typed(settings.filter_strength), "angle_deg": degrees(settings.filter_angle)}
    if settings.filter_mode == "HELD":
        keywords["held_towards_deg"] = (degrees(settings.filter_altitude), degrees(settings.filter_azimuth))
    return keywords


def night(settings):
    """Return the keywords of skyprobe.Night."""
    keywords = {
        "when": settings.night_when,
        "star_limit": as_typed(settings.star_limit),
        "solar_flux_sfu": as_typed(settings.solar_flux),
    }
    if settings.light_pollution != choices.NO_TOWNS:
        keywords["bortle"] = int(settings.light_pollution)
        keywords["led_share"] = as_typed(settings.led_share)
    return keywords


def layers(settings):
    """Return the factors on layers that are not 1."""
    factors = ((name, as_typed(getattr(settings, f"layer_{name}"))) for name, _, _ in choices.LAYERS)
    return {name: factor for name, factor in factors if factor != 1.0}


def place(settings):
    """Return latitude, longitude [degrees] and elevation_m as keywords of skyprobe.Sky."""
    return {**coordinates(settings), "elevation_m": as_typed(settings.elevation_m)}


def coordinates(settings):
    """Return latitude and longitude [degrees] as keywords; the poles and the date line are exact."""
    limits = {"latitude": math.pi / 2.0, "longitude": math.pi}
    return {name: degrees(min(max(getattr(settings, name), -limit), limit)) for name, limit in limits.items()}


def width(settings):
    """Return the width of the probe to render [pixels]."""
    return settings.width if settings.width_choice == "OTHER" else int(settings.width_choice)


def as_typed(value):
    """Return the number that the user typed: Blender keeps single precision, seven digits, in which 0.1 is another."""
    return float(f"{value:.7g}")


def degrees(angle):
    """Return an angle [radians] as the degrees that the user typed; in single precision the poles lie beyond 90."""
    return round(math.degrees(angle), 5)


def check_finite(settings, *names):
    """Raise ValueError for a property that a script or a driver made no number."""
    for name in names:
        if not math.isfinite(getattr(settings, name)):
            raise ValueError(f"{name} = {getattr(settings, name)}: must be a number; look for the script or the driver that sets it")


def clock(settings):
    """Return (hour, minute, second) of the time of day."""
    check_finite(settings, "hour")
    seconds = min(round(settings.hour * 3600.0), 86399)
    return seconds // 3600, seconds // 60 % 60, seconds % 60


def date(settings):
    """Return the date; ValueError for a day that the month does not have."""
    try:
        return datetime.date(settings.year, settings.month, settings.day)
    except ValueError:
        text = f"{settings.year:04d}-{settings.month:02d}-{settings.day:02d}"
        raise ValueError(f"date = {text}: must be a day of the calendar; that month is shorter") from None


def zone_name(settings):
    """Return the name of the time zone; ValueError for what can be no name of one."""
    name = settings.zone_name.strip()
    if len(name) > LONGEST_ZONE or not re.fullmatch(r"[\w+-]+(/[\w+-]+)*", name, re.ASCII):
        raise ValueError(f"zone = {name or '(empty)'}: must be a name of the IANA database, such as Europe/Stockholm")
    return name


def time(settings):
    """Return the time as ISO 8601 with its zone in brackets, its offset, or neither where the place decides.

    With a time offset it has its offset from universal time and its zone, as hours that pass do not know of daylight saving.
    """
    date(settings)
    hour, minute, second = clock(settings)
    text = f"{settings.year:04d}-{settings.month:02d}-{settings.day:02d}T{hour:02d}:{minute:02d}:{second:02d}"
    if settings.zone_mode == "NAME":
        text = f"{text}[{zone_name(settings)}]"
    elif settings.zone_mode == "OFFSET":
        check_finite(settings, "utc_offset")
        minutes = round(settings.utc_offset * 60.0)
        text = f"{text}{'-' if minutes < 0 else '+'}{abs(minutes) // 60:02d}:{abs(minutes) % 60:02d}"
    check_finite(settings, "time_offset_h")
    if settings.time_offset_h == 0.0:
        return text
    start = places.civil_time(text, **coordinates(settings))
    try:
        shifted = start.time.astimezone(datetime.timezone.utc) + datetime.timedelta(seconds=round(settings.time_offset_h * 3600.0))
    except OverflowError:
        shifted = None
    # The years that the calendar of the panel has.
    if shifted is None or not FIRST_YEAR <= shifted.year <= LAST_YEAR:
        raise ValueError(f"time_offset_h = {settings.time_offset_h:g}: must lead to a year from {FIRST_YEAR} to {LAST_YEAR}")
    if start.zone is None:
        return shifted.astimezone(start.time.tzinfo).isoformat(timespec="seconds")
    shown = places.civil_time(f"{shifted:%Y-%m-%dT%H:%M:%S}Z[{start.zone}]", **coordinates(settings)).time
    return f"{shown.isoformat(timespec='seconds')}[{start.zone}]"


def civil_time(settings):
    """Return the skyprobe.places.CivilTime of the settings: the time with its offset, zone, and whether it is summer time."""
    return places.civil_time(time(settings), **coordinates(settings))


def now(settings):
    """Return this moment as a datetime with the offset of the settings' zone."""
    moment = datetime.datetime.now(datetime.timezone.utc)
    if settings.zone_mode == "OFFSET":
        check_finite(settings, "utc_offset")
        return moment.astimezone(datetime.timezone(datetime.timedelta(hours=settings.utc_offset)))
    zone = zone_name(settings) if settings.zone_mode == "NAME" else places.time_zone(**coordinates(settings))
    return moment.astimezone(places.civil_time(f"{moment:%Y-%m-%dT%H:%M:%S}Z[{zone}]", **coordinates(settings)).time.tzinfo)


def set_clock(settings, moment):
    """Set date and time of day of `settings` to what the datetime `moment` says, and no time offset."""
    settings.year, settings.month, settings.day = moment.year, moment.month, moment.day
    settings.hour = min(moment.hour + moment.minute / 60.0 + moment.second / 3600.0, 23.9997)
    settings.time_offset_h = 0.0


def span(settings, name):
    """Return when the span of a time-lapse begins (a datetime, None for now) and how long it is [hours]; ValueError if the Sun does not do that."""
    if name == "YEAR":
        return None, 365.0 * 24.0
    sun = jobs.day(sky_request(settings, PREVIEW_QUALITY, 64)).sun
    if name == "WHOLE":
        return sun.solar_noon.replace(hour=0, minute=0, second=0, microsecond=0), 24.0
    hour = datetime.timedelta(hours=1.0)
    names = {
        "DAY": (sun.civil_dawn, sun.civil_dusk),
        "SUNRISE": (sun.sunrise, sun.sunrise),
        "SUNSET": (sun.sunset, sun.sunset),
        "NIGHT": (sun.sunset, sun.sunrise),
    }
    begin, end = names[name]
    if begin is None or end is None:
        raise ValueError(f"span = {name}: must be another; on that date the Sun does not rise or set there")
    if name in {"SUNRISE", "SUNSET"}:
        begin, end = begin - hour, end + hour
    if name == "NIGHT":
        end += 24.0 * hour
    return begin, (end - begin).total_seconds() / 3600.0


def preview_request(scene):
    """Return the jobs.SkyRequest of the live preview of `scene`; ValueError for settings that make no sense."""
    settings = scene.skyprobe
    wanted = sky_request(settings, PREVIEW_QUALITY, settings.preview_width)
    # The light of fainter stars goes into the Milky Way: as much light, sooner.
    return replace(wanted, night={**wanted.night, "star_limit": min(wanted.night["star_limit"], PREVIEW_STAR_LIMIT)})


def final_request(scene):
    """Return the jobs.SkyRequest of the probe that `scene` asks for; ValueError for settings that make no sense."""
    settings = scene.skyprobe
    return sky_request(settings, settings.quality, width(settings))


def sky_request(settings, quality, pixels):
    """Return the jobs.SkyRequest of `settings` at a quality of the air and a width [pixels]; ValueError for settings that make no sense."""
    check_finite(settings, "north")
    return jobs.SkyRequest(
        air=air(settings, quality),
        place=place(settings),
        time=time(settings),
        night=night(settings),
        layers=layers(settings),
        polarising_filter=polarising_filter(settings),
        width=pixels,
        sun_in_map=settings.sun_mode == "MAP",
        moon_in_map=settings.moon_mode == "MAP",
        lamp_color_space=compat.working_color_space(),
    )


def folder(settings, directory=None):
    """Return the absolute folder `directory` (by default that of `settings`) for files that are kept; ValueError for one that cannot be meant."""
    directory = settings.directory if directory is None else directory
    if directory.startswith("//") and not bpy.data.filepath:
        raise ValueError(f"folder = {directory}: must be absolute until the .blend is saved")
    if not directory.strip():
        raise ValueError("folder = (empty): must be the name of a folder; // is where the .blend is")
    path = bpy.path.abspath(directory)
    if not os.path.isabs(path):
        raise ValueError(f"folder = {directory}: must be absolute, or begin with // for where the .blend is")
    return os.path.normpath(path)


def check_path(path):
    """Raise ValueError for a path that is too long for Blender; return it."""
    length = len(os.fsencode(path))
    if length > LONGEST_PATH:
        raise ValueError(f"folder = {os.path.dirname(path)}: must be shorter; {length} bytes with the file's name, and Blender takes {LONGEST_PATH}")
    return path


def probe_path(settings):
    """Return the absolute path of the probe's file: in the folder, or in Blender's temporary one if it is to be packed.

    The name tells place, time and width, and ends in a digest of all that the picture depends on: a file of other settings, which a saved .blend
    may show, is never written over.
    """
    request = sky_request(settings, settings.quality, width(settings))
    where, when = request.place, request.time
    stamp = when[:16].replace("-", "").replace(":", "")
    name = f"sky_{where['latitude']:+.4f}_{where['longitude']:+.4f}_{stamp}_{request.width}_{request.digest[:DIGITS]}.exr"
    return check_path(os.path.join(bpy.app.tempdir if settings.storage == "PACKED" else folder(settings), name))
