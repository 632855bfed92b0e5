# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings as the configuration of the command line tool, with the same keys, and back.

What a configuration leaves out stays as it is, so a file may hold the air alone; one that --dump-config wrote holds all, and what it leaves out
is none. A key that Blender cannot follow is an error if the light would be another, and told if only a file would. Where north is, and what
Blender does with the probe, is the scene's own and in no configuration.
"""

import math

from skyprobe import places

from . import values
from .configuration_keys import READERS, Reading, checked_number

# Letters of a time without its offset.
LOCAL = len("2025-06-21T13:00:00")
# Keys of a configuration that a section of the panel writes.
SECTIONS = ("place", "time", "air", "night", "filter", "probe")


def from_settings(settings, sections=SECTIONS):
    """Return the configuration of the `sections` of `settings`."""
    content = {}
    if "place" in sections:
        content.update(values.place(settings))
    if "time" in sections:
        content.update(_time(settings))
    if "air" in sections:
        content["atmosphere"] = values.air(settings)
    if "night" in sections:
        content["night"] = values.night(settings)
        content["layers"] = values.layers(settings)
    if "filter" in sections:
        content["polarising_filter"] = values.polarising_filter(settings)
    if "probe" in sections:
        content["probe"] = {
            "width": values.width(settings),
            "sun_disc": settings.sun_mode == "MAP",
            "moon_disc": settings.moon_mode == "MAP",
        }
    return content


def _time(settings):
    """Return the keys `time` and, for a zone by its name, `zone`, with the time offset in them."""
    zone = {"zone": values.zone_name(settings)} if settings.zone_mode == "NAME" else {}
    place = values.coordinates(settings)
    text = values.time(settings).partition("[")[0]
    if settings.time_offset_h == 0.0 or settings.zone_mode == "OFFSET":
        return {"time": text, **zone}
    # Clocks that are set back show an hour twice, and only the offset says which is meant.
    local = text[:LOCAL]
    is_plain = places.civil_time(local, **place, **zone).time == places.civil_time(text, **place).time
    return {"time": local if is_plain else text, **zone}


def to_settings(content, settings):
    """Give `settings` what the configuration `content` holds; return what of it Blender does without, as texts.

    ValueError, before any change, for what it cannot hold.
    """
    if not isinstance(content, dict):
        raise ValueError(f"configuration = {content!r}: must be a JSON object, as skyprobe render --dump-config writes it")
    reading = Reading(settings)
    for key, value in content.items():
        if key not in READERS:
            raise ValueError(f"{key} = {value!r}: must not be there; a panel knows {', '.join(sorted(READERS))}")
        READERS[key](key, value, reading)
    reading.end(content)
    _check(reading.changes, settings)
    for name, value in reading.changes.items():
        setattr(settings, name, value)
    return reading.notes


def _check(changes, settings):
    """Find values that a property would refuse or cut."""
    for name, value in changes.items():
        kind = settings.bl_rna.properties[name]
        if kind.type == "ENUM":
            allowed = [item.identifier for item in kind.enum_items]
            if value not in allowed:
                raise ValueError(f"{name} = {value!r}: must be one of {', '.join(allowed)}")
        elif kind.type in {"INT", "FLOAT"}:
            checked_number(name, value)
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
