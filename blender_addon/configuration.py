# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings as a scene of the library, which configurations and headers of pictures hold, and back.

The library reads, checks and writes; here is what its values mean to the panel. What a configuration leaves out stays as it is, so a file may hold
the air alone; one that --dump-config wrote holds all, and what it leaves out is none. A value that Blender cannot follow is an error if the light
would be another, and told if only a file would. Where north is, and what Blender does with the probe, is in no scene.
"""

import datetime
import json
import math
from pathlib import Path

import skyprobe
from skyprobe import places

from . import choices, values

# Letters of a time without its offset.
LOCAL = len("2025-06-21T13:00:00")
# What a section of the panel writes.
SECTIONS = ("place", "time", "air", "night", "filter", "probe")
# The tables that --dump-config always writes: a configuration with all of them is whole.
WHOLE = {"atmosphere", "night", "probe"}
# What makes another file of the same light.
OF_FILES = {"tolerance", "output", "probe.rows", "probe.turn_deg", "probe.scale", "probe.color_space", "probe.gamut"}
AMOUNTS = ("aod550", "turbidity", "visibility_km")
NIGHT = {"when": "night_when", "star_limit": "star_limit", "solar_flux_sfu": "solar_flux", "led_share": "led_share"}


def from_settings(settings, sections=SECTIONS):
    """Return the configuration of the `sections` of `settings`, without settings that are out of force."""
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
    written = skyprobe.Scene.without_ignored(**content).to_dict()
    # No layer is scaled, and there is no filter, where nothing is written of them.
    return {key: written.get(key, {} if key == "layers" else None) for key in content}


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


def load(path):
    """Return what the file `path` holds: JSON, or the header of a picture; ValueError that names it."""
    scene = skyprobe.Scene.load(path)
    try:
        return json.loads(Path(path).read_bytes())
    except ValueError:
        # What the library takes and is no JSON is a picture, whose header holds all.
        return scene.to_dict()


def to_settings(content, settings):
    """Give `settings` what the configuration `content` holds; return what of it Blender does without, as texts.

    ValueError, before any change, for what it cannot hold.
    """
    scene = skyprobe.Scene(**content).to_dict()
    given = {key for key, value in content.items() if value is not None}
    if WHOLE <= given:
        given |= {"layers", "polarising_filter"}
    else:
        given |= {key for key in ("layers", "polarising_filter") if key in content}
    notes = []
    if "place" in given:
        notes.append(f"place = {content['place']}: {places.locate(content['place']).label}")
    changes = list(_changes(scene, given, content, settings, notes))
    notes += _without({way for way, _, _ in changes}, scene)
    for way, name, value in changes:
        _check(way, value, settings.bl_rna.properties[name])
    for _, name, value in changes:
        setattr(settings, name, value)
    return notes


def _without(known, scene):
    """Return what files of `scene` have and Blender's have not; ValueError for other light than Blender shows. `known` are the ways to what it has."""
    default = _by_way(skyprobe.Scene().to_dict())
    notes = []
    for way, value in _by_way(scene).items():
        own = default.get(way)
        if way in known or value == own:
            continue
        if way not in OF_FILES and not way.startswith("file."):
            raise ValueError(f"{way} = {value!r}: must be {'left out' if own is None else repr(own)}; Blender's sky has no other")
        why = "no file is written here" if way == "output" else "not in Blender" + ("" if own is None else f", which has {own!r}")
        notes.append(f"{way} = {value!r}: {why}")
    return notes


def _by_way(scene):
    """Return the values of `scene` by the ways to them, such as night.bortle."""
    # Where the Sun is put is one thing.
    tables = {key: value if isinstance(value, dict) and key != "sun" else {"": value} for key, value in scene.items()}
    return {f"{key}.{name}".rstrip("."): value for key, table in tables.items() for name, value in table.items()}


def _check(way, value, kind):
    """Find values of the library that a property would refuse or cut."""
    if kind.type == "ENUM":
        allowed = [item.identifier for item in kind.enum_items]
        if value not in allowed:
            raise ValueError(f"{way} = {value!r}: must be one of {', '.join(allowed)} in Blender")
    elif kind.type == "FLOAT" and kind.subtype != "ANGLE":
        # Blender keeps single precision.
        room = 1e-6 * max(abs(kind.hard_min), abs(kind.hard_max))
        if not kind.hard_min - room <= value <= kind.hard_max + room:
            raise ValueError(f"{way} = {value!r}: must be from {kind.hard_min:g} to {kind.hard_max:g} in Blender")


def _changes(scene, given, content, settings, notes):
    """Yield (the way in the scene, the setting, its value) for all that is `given`."""
    for name in ("latitude", "longitude"):
        if name in scene:
            yield name, name, math.radians(scene[name])
    if given & {"place", "latitude", "longitude", "elevation_m"}:
        yield "elevation_m", "elevation_m", scene["elevation_m"]
    if "time" in scene:
        place = values.coordinates(settings)
        for name, value in _clock(scene, {name: scene.get(name, place[name]) for name in place}, notes).items():
            yield "time", name, value
    if "zone" in scene:
        yield "zone", "zone_name", scene["zone"]
        if "time" not in scene:
            yield "zone", "zone_mode", "NAME"
    if "atmosphere" in given:
        yield from _air(scene["atmosphere"])
    if "night" in given:
        for name, setting in NIGHT.items():
            yield f"night.{name}", setting, scene["night"][name]
        yield "night.bortle", "light_pollution", str(scene["night"].get("bortle", choices.NO_TOWNS))
    if "layers" in given:
        for name, _, _ in choices.LAYERS:
            yield f"layers.{name}", f"layer_{name}", scene.get("layers", {}).get(name, 1.0)
    if "polarising_filter" in given:
        yield from _filter(scene.get("polarising_filter"))
    for name in content.get("probe") or {}:
        if name == "width":
            width = scene["probe"]["width"]
            offered = [item for item, _, _ in choices.WIDTHS]
            yield "probe.width", "width", width
            yield "probe.width", "width_choice", str(width) if str(width) in offered else "OTHER"
        elif name in {"sun_disc", "moon_disc"}:
            yield f"probe.{name}", name.replace("disc", "mode"), "MAP" if scene["probe"][name] else "LAMP"


def _air(air):
    amount = next((name for name in AMOUNTS if name in air), None)
    yield f"atmosphere.{amount}", "haze", amount or choices.OF_PRESET
    if amount:
        yield f"atmosphere.{amount}", amount, air[amount]
    # What an air leaves out is its preset's.
    for name in ("preset", "quality", "aerosol", "ground"):
        yield f"atmosphere.{name}", name, air.get(name, choices.OF_PRESET)
    for switch, name in values.OPTIONAL_AIR:
        yield f"atmosphere.{name}", switch, name in air
        if name in air:
            yield f"atmosphere.{name}", name, air[name]


def _filter(held):
    towards = held and held.get("held_towards_deg")
    yield "polarising_filter", "filter_mode", "HELD" if towards else "VIEW" if held else "NONE"
    if held:
        yield "polarising_filter.strength", "filter_strength", held["strength"]
        yield "polarising_filter.angle_deg", "filter_angle", math.radians(held["angle_deg"])
    if towards:
        for name, angle in zip(("filter_altitude", "filter_azimuth"), towards, strict=True):
            yield "polarising_filter.held_towards_deg", name, math.radians(angle)


def _clock(scene, place, notes):
    """Return the settings of date, time of day and kind of zone of a `scene` at a `place`."""
    # The same reader as the command line's.
    said = places.parse_time(scene["time"])
    given_zone = {name: scene[name] for name in ("zone",) if name in scene}
    civil = places.civil_time(scene["time"], **place, **given_zone)
    if civil.notice:
        notes.append(civil.notice)
    zone = scene.get("zone") or said.zone
    has_offset = said.utc_offset_h is not None or scene["time"].strip().lower() == "now"
    if zone is not None:
        # The second of an hour that comes twice is known by its offset only.
        local = civil.time.replace(tzinfo=None).isoformat()
        has_offset = places.civil_time(local, **place, zone=zone).time != civil.time
    moment, mode = civil.time, {"zone_mode": "PLACE"} if zone is None else {"zone_mode": "NAME", "zone_name": zone}
    if has_offset:
        # The panel has offsets of whole minutes.
        hours = min(max(round(moment.utcoffset().total_seconds() / 60.0) / 60.0, -14.0), 14.0)
        moment = moment.astimezone(datetime.timezone(datetime.timedelta(minutes=round(60.0 * hours))))
        mode = {"zone_mode": "OFFSET", "utc_offset": hours}
    whole = moment.replace(microsecond=0)
    if moment.microsecond:
        notes.append(f"time = {scene['time']}: the panel has whole seconds")
        whole += datetime.timedelta(seconds=round(moment.microsecond * 1e-6))
    hour = min(whole.hour + whole.minute / 60.0 + whole.second / 3600.0, 23.9997)
    return {"year": whole.year, "month": whole.month, "day": whole.day, "hour": hour, "time_offset_h": 0.0, **mode}
