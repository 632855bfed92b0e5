# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings as the configuration of the command line tool, with the same keys, and back.

What a configuration leaves out stays as it is, so a file may hold the air alone. Where north is, and what Blender does with the probe, is the
scene's own and in no configuration.
"""

import datetime
import math
import re

from . import choices, values

# Keys of a configuration that a section of the panel writes.
PLACE = ("latitude", "longitude", "elevation_m")
SECTIONS = ("place", "time", "air", "night", "filter", "probe")
# Keys that the command line tool has and a panel does not, with the only value that changes nothing here.
IGNORED = ("output", "file", "sun_model", "model", "tolerance")
IGNORED_PROBE = ("projection", "rows", "extent", "ground", "scale", "color_space", "gamut")


def from_settings(settings, sections=SECTIONS):
    """Return the configuration of the `sections` of `settings`."""
    content = {}
    if "place" in sections:
        content.update(values.place(settings))
    if "time" in sections:
        hour, minute, second = values.clock(settings)
        content["time"] = f"{values.date(settings).isoformat()}T{hour:02d}:{minute:02d}:{second:02d}"
        if settings.zone_mode == "NAME":
            content["zone"] = settings.zone_name.strip()
        elif settings.zone_mode == "OFFSET":
            minutes = round(settings.utc_offset * 60.0)
            content["time"] += f"{'-' if minutes < 0 else '+'}{abs(minutes) // 60:02d}:{abs(minutes) % 60:02d}"
    if "air" in sections:
        content["atmosphere"] = values.air(settings)
    if "night" in sections:
        content["night"] = values.night(settings)
        if values.layers(settings):
            content["layers"] = values.layers(settings)
    if "filter" in sections and values.polarising_filter(settings):
        content["polarising_filter"] = values.polarising_filter(settings)
    if "probe" in sections:
        content["probe"] = {"width": values.width(settings), "sun_disc": settings.sun_mode == "MAP"}
    return content


def to_settings(content, settings):
    """Give `settings` what the configuration `content` holds; ValueError, before any change, for what it cannot hold."""
    if not isinstance(content, dict):
        raise ValueError(f"configuration = {content!r}: must be a JSON object, as skyprobe render --dump-config writes it")
    changes = {}
    readers = {
        **{key: _read_place for key in PLACE},
        "time": _read_time,
        "zone": _read_zone,
        "atmosphere": _read_air,
        "night": _read_night,
        "layers": _read_layers,
        "polarising_filter": _read_filter,
        "probe": _read_probe,
        **{key: _ignore for key in IGNORED},
    }
    # A zone belongs to the time, and is read after it.
    for key in sorted(content, key=lambda key: key == "zone"):
        if key not in readers:
            raise ValueError(f"{key} = {content[key]!r}: must not be there; a panel knows {', '.join(sorted(readers))}")
        readers[key](key, content[key], changes)
    _check(changes, settings)
    for name, value in changes.items():
        setattr(settings, name, value)


def _check(changes, settings):
    """Find values that a property would refuse or cut."""
    for name, value in changes.items():
        kind = settings.bl_rna.properties[name]
        if kind.type == "ENUM":
            allowed = [item.identifier for item in kind.enum_items]
            if value not in allowed:
                raise ValueError(f"{name} = {value!r}: must be one of {', '.join(allowed)}")
        elif kind.type in {"INT", "FLOAT"}:
            _number(name, value)
            if kind.type == "INT" and value != int(value):
                raise ValueError(f"{name} = {value!r}: must be a whole number")
            # Blender keeps single precision.
            room = 1e-6 * max(abs(kind.hard_min), abs(kind.hard_max), 1e-30)
            if not kind.hard_min - room <= value <= kind.hard_max + room:
                shown = [math.degrees(number) if kind.subtype == "ANGLE" else number for number in (value, kind.hard_min, kind.hard_max)]
                unit = " degrees" if kind.subtype == "ANGLE" else ""
                raise ValueError(f"{name} = {shown[0]:g}: must be from {shown[1]:g} to {shown[2]:g}{unit}")
            if kind.type == "INT":
                changes[name] = int(value)
        elif kind.type == "STRING" and not (isinstance(value, str) and value.isprintable()):
            raise ValueError(f"{name} = {value!r}: must be a text of letters that can be shown")


def _ignore(key, value, changes):
    pass


def _table(key, value):
    if not isinstance(value, dict):
        raise ValueError(f"{key} = {value!r}: must be a JSON object")
    return value


def _number(key, value):
    """Return `value` if it is a number that single precision can hold."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= 3e38:
        raise ValueError(f"{key} = {value!r}: must be a number")
    return value


def _read_place(key, value, changes):
    changes[key] = _number(key, value) if key == "elevation_m" else math.radians(_number(key, value))


def _read_time(key, value, changes):
    pattern = r"(\d{4})-(\d\d)-(\d\d)T(\d\d):(\d\d)(?::(\d\d)(?:\.\d+)?)?(Z|[+-]\d\d:?\d\d)?(?:\[([^\]]+)\])?"
    found = re.fullmatch(pattern, value.strip()) if isinstance(value, str) else None
    if not found:
        raise ValueError(f"time = {value!r}: must be ISO 8601, such as 2025-06-21T13:00 or 2025-06-21T13:00:00+02:00")
    year, month, day, hour, minute, second = (int(number or 0) for number in found.groups()[:6])
    try:
        moment = datetime.datetime(year, month, day, hour, minute, second)
    except ValueError as error:
        raise ValueError(f"time = {value}: must be a date and time of the calendar ({error})") from None
    changes.update(year=moment.year, month=moment.month, day=moment.day, time_offset_h=0.0)
    changes["hour"] = min(moment.hour + moment.minute / 60.0 + moment.second / 3600.0, 23.9997)
    offset, zone = found.group(7), found.group(8)
    if zone:
        changes.update(zone_mode="NAME", zone_name=zone)
    elif offset == "Z":
        changes.update(zone_mode="OFFSET", utc_offset=0.0)
    elif offset:
        sign = -1.0 if offset[0] == "-" else 1.0
        changes.update(zone_mode="OFFSET", utc_offset=sign * (int(offset[1:3]) + int(offset[-2:]) / 60.0))
    else:
        changes["zone_mode"] = "PLACE"


def _read_zone(key, value, changes):
    # An offset in the time says all.
    if changes.get("zone_mode") != "OFFSET":
        changes.update(zone_mode="NAME", zone_name=value)


def _read_air(key, value, changes):
    amounts = ("aod550", "turbidity", "visibility_km")
    switches = {name: switch for switch, name in values.OPTIONAL_AIR}
    # What an air leaves out is its preset's.
    changes.update({switch: False for switch in switches.values()})
    changes.update(aerosol=choices.OF_PRESET, ground=choices.OF_PRESET, haze=choices.OF_PRESET)
    for name, content in _table(key, value).items():
        if name in {"preset", "aerosol", "ground", "quality"}:
            changes[name] = content
        elif name in amounts:
            changes.update({"haze": name, name: _number(f"{key}.{name}", content)})
        elif name in switches:
            changes.update({switches[name]: True, name: _number(f"{key}.{name}", content)})
        elif name == "polarisation" and content is True:
            continue
        else:
            raise ValueError(f"{key}.{name} = {content!r}: must not be there; the panel has no such setting")


def _read_night(key, value, changes):
    changes["light_pollution"] = choices.NO_TOWNS
    names = {"when": "night_when", "star_limit": "star_limit", "solar_flux_sfu": "solar_flux", "led_share": "led_share"}
    for name, content in _table(key, value).items():
        if name == "bortle":
            changes["light_pollution"] = str(content)
        elif name in names:
            changes[names[name]] = content if name == "when" else _number(f"{key}.{name}", content)
        else:
            raise ValueError(f"{key}.{name} = {content!r}: must not be there; the panel has no such setting")


def _read_layers(key, value, changes):
    known = [name for name, _, _ in choices.LAYERS]
    changes.update({f"layer_{name}": 1.0 for name in known})
    for name, factor in _table(key, value).items():
        if name not in known:
            raise ValueError(f"{key}.{name} = {factor!r}: must be one of {', '.join(known)}")
        changes[f"layer_{name}"] = _number(f"{key}.{name}", factor)


def _read_filter(key, value, changes):
    if value is None:
        changes["filter_mode"] = "NONE"
        return
    changes["filter_mode"] = "VIEW"
    for name, content in _table(key, value).items():
        if name == "strength":
            changes["filter_strength"] = _number(f"{key}.{name}", content)
        elif name == "angle_deg":
            changes["filter_angle"] = math.radians(_number(f"{key}.{name}", content))
        elif name == "held_towards_deg":
            if content is None:
                continue
            if not isinstance(content, (list, tuple)) or len(content) != 2:
                raise ValueError(f"{key}.{name} = {content!r}: must be altitude and azimuth")
            altitude, azimuth = (_number(f"{key}.{name}", angle) for angle in content)
            changes.update(filter_mode="HELD", filter_altitude=math.radians(altitude), filter_azimuth=math.radians(azimuth))
        else:
            raise ValueError(f"{key}.{name} = {content!r}: must be strength, angle_deg or held_towards_deg")


def _read_probe(key, value, changes):
    for name, content in _table(key, value).items():
        if name == "width":
            offered = [item for item, _, _ in choices.WIDTHS]
            changes["width"] = _number(f"{key}.{name}", content)
            changes["width_choice"] = str(content) if str(content) in offered else "OTHER"
            if content % 2:
                raise ValueError(f"{key}.{name} = {content}: must be even")
        elif name == "sun_disc":
            if not isinstance(content, bool):
                raise ValueError(f"{key}.{name} = {content!r}: must be true or false")
            changes["sun_mode"] = "MAP" if content else "LAMP"
        elif name not in IGNORED_PROBE:
            raise ValueError(f"{key}.{name} = {content!r}: must not be there; the panel has no such setting")
