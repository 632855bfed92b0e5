# SPDX-License-Identifier: GPL-3.0-or-later
"""What each key of a configuration means to the settings.

A reader takes a key's name, its value and the Reading, to which it adds the changes of settings that follow, and raises ValueError for what the
settings cannot hold. null stands for a key that is not there.
"""

import datetime
import math

from skyprobe import places

from . import choices, values

# The tables that --dump-config always writes: a configuration with all of them is whole.
WHOLE = {"atmosphere", "night", "probe"}
# The one value with which Blender shows the light that is meant.
ONLY = {"model": "scattering", "sun_model": "iau"}
ONLY_OF_PROBE = {"projection": "latlong", "extent": "full", "ground": "on"}
# The value that Blender's own picture has. Another makes another file of the same light.
OWN_OF_PROBE = {"rows": "centre", "turn_deg": 0.0, "scale": "blender", "color_space": "lin_rec709", "gamut": "desaturate"}
OWN_OF_FILE = {"half": "off", "exposure_stops": 0.0, "operator": "sky", "layers": False}
AMOUNTS = ("aod550", "turbidity", "visibility_km")


class Reading:
    """What was read of a configuration: the `changes` of settings by name, and as `notes` what Blender does without."""

    def __init__(self, settings):
        self.changes = {}
        self.notes = []
        self.time = self.zone = None
        self._settings = settings

    def end(self, content):
        """Add what follows from several keys of the configuration `content` together."""
        changes = self.changes
        if content.get("place") is not None and any(content.get(key) is not None for key in ("latitude", "longitude", "sun")):
            raise ValueError(f"place = {content['place']!r}: must be left out where latitude and longitude are given")
        if {"latitude", "longitude"} & changes.keys():
            changes.setdefault("elevation_m", 0.0)
        if WHOLE <= content.keys():
            for key in ("layers", "polarising_filter"):
                if content.get(key) is None:
                    READERS[key](key, None, self)
        if self.time is not None:
            self._end_time()
        elif self.zone is not None:
            changes.update(zone_mode="NAME", zone_name=self.zone)

    def _end_time(self):
        # The same reader as the command line's.
        said = places.parse_time(self.time)
        place = values.coordinates(self._settings)
        place.update({name: math.degrees(self.changes[name]) for name in place if name in self.changes})
        civil = places.civil_time(self.time, **place, **({} if self.zone is None else {"zone": self.zone}))
        if civil.notice:
            self.notes.append(civil.notice)
        zone = self.zone or said.zone
        if zone is None and (said.utc_offset_h is not None or self.time.strip().lower() == "now"):
            self._set_offset(civil.time)
            return
        self._set_clock(civil.time)
        self.changes.update({"zone_mode": "PLACE"} if zone is None else {"zone_mode": "NAME", "zone_name": zone})
        # The second of an hour that comes twice is known by its offset only.
        local = civil.time.replace(tzinfo=None).isoformat()
        if zone is not None and places.civil_time(local, **place, zone=zone).time != civil.time:
            self._set_offset(civil.time)

    def _set_offset(self, moment):
        hours = moment.utcoffset().total_seconds() / 3600.0
        # The panel has offsets of whole minutes.
        kept = min(max(round(60.0 * hours) / 60.0, -14.0), 14.0)
        self._set_clock(moment.astimezone(datetime.timezone(datetime.timedelta(minutes=round(60.0 * kept)))))
        self.changes.update(zone_mode="OFFSET", utc_offset=kept)

    def _set_clock(self, moment):
        whole = moment.replace(microsecond=0)
        if moment.microsecond:
            self.notes.append(f"time = {self.time}: the panel has whole seconds")
            whole += datetime.timedelta(seconds=round(moment.microsecond * 1e-6))
        hour = min(whole.hour + whole.minute / 60.0 + whole.second / 3600.0, 23.9997)
        self.changes.update(year=whole.year, month=whole.month, day=whole.day, hour=hour, time_offset_h=0.0)


def checked_number(key, value):
    """Return `value` if it is a number that single precision can hold."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) <= 3e38:
        raise ValueError(f"{key} = {value!r}: must be a number")
    return value


def _text(key, value):
    if not isinstance(value, str) or not value.isprintable():
        raise ValueError(f"{key} = {value!r}: must be a text of letters that can be shown")
    return value


def _table(key, value):
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise ValueError(f"{key} = {value!r}: must be a JSON object")
    return {name: content for name, content in value.items() if content is not None}


def _only(allowed, key, value):
    """Refuse what would be other light than Blender shows."""
    if value is not None and value != allowed:
        raise ValueError(f"{key} = {value!r}: must be {allowed!r} or left out; Blender's sky has no other")


def _told(own, key, value, reading):
    """Tell what Blender's picture does without."""
    if value is not None and value != own:
        reading.notes.append(f"{key} = {value!r}: not in Blender, which has {own!r}")


def _read_angle(key, value, reading):
    if value is not None:
        reading.changes[key] = math.radians(checked_number(key, value))


def _read_elevation(key, value, reading):
    if value is not None:
        reading.changes[key] = checked_number(key, value)


def _read_place(key, value, reading):
    if value is None:
        return
    found = places.locate(_text(key, value))
    reading.changes.update(latitude=math.radians(found.latitude), longitude=math.radians(found.longitude))
    # A height of its own counts more, wherever it stands.
    reading.changes.setdefault("elevation_m", found.elevation_m)
    reading.notes.append(f"place = {value}: {found.label}")


def _read_time(key, value, reading):
    reading.time = None if value is None else _text(key, value)


def _read_zone(key, value, reading):
    reading.zone = None if value is None else _text(key, value)


def _read_sun(key, value, reading):
    if value is not None:
        raise ValueError(f"sun = {value!r}: must be left out; Blender's sky has a place and a time, and the Sun stands where it does then")


def _read_air(key, value, reading):
    changes = reading.changes
    switches = {name: switch for switch, name in values.OPTIONAL_AIR}
    # What an air leaves out is its preset's.
    changes.update({switch: False for switch in switches.values()})
    changes.update(preset=choices.PRESETS[0][0], aerosol=choices.OF_PRESET, ground=choices.OF_PRESET, haze=choices.OF_PRESET)
    table = _table(key, value)
    amounts = [name for name in AMOUNTS if name in table]
    if len(amounts) > 1:
        raise ValueError(f"{key}.{amounts[1]} = {table[amounts[1]]!r}: must be left out beside {amounts[0]}, which says the same in another way")
    for name, content in table.items():
        if name in {"preset", "aerosol", "ground", "quality"}:
            changes[name] = content
        elif name in AMOUNTS:
            changes.update({"haze": name, name: checked_number(f"{key}.{name}", content)})
        elif name in switches:
            changes.update({switches[name]: True, name: checked_number(f"{key}.{name}", content)})
        elif name == "polarisation":
            _only(True, f"{key}.{name}", content)
        else:
            raise ValueError(f"{key}.{name} = {content!r}: must not be there; the panel has no such setting")


def _read_night(key, value, reading):
    names = {"when": "night_when", "star_limit": "star_limit", "solar_flux_sfu": "solar_flux", "led_share": "led_share"}
    # What a night leaves out is as the command line has it.
    reading.changes.update(night_when="auto", star_limit=8.5, solar_flux=130.0, led_share=0.5, light_pollution=choices.NO_TOWNS)
    for name, content in _table(key, value).items():
        if name == "bortle":
            reading.changes["light_pollution"] = str(content)
        elif name in names:
            reading.changes[names[name]] = content if name == "when" else checked_number(f"{key}.{name}", content)
        else:
            raise ValueError(f"{key}.{name} = {content!r}: must not be there; the panel has no such setting")


def _read_layers(key, value, reading):
    known = [name for name, _, _ in choices.LAYERS]
    reading.changes.update({f"layer_{name}": 1.0 for name in known})
    for name, factor in _table(key, value).items():
        if name not in known:
            raise ValueError(f"{key}.{name} = {factor!r}: must be one of {', '.join(known)}")
        reading.changes[f"layer_{name}"] = checked_number(f"{key}.{name}", factor)


def _read_filter(key, value, reading):
    changes = reading.changes
    if value is None:
        changes["filter_mode"] = "NONE"
        return
    changes.update(filter_mode="VIEW", filter_strength=1.0, filter_angle=0.0)
    for name, content in _table(key, value).items():
        if name == "strength":
            changes["filter_strength"] = checked_number(f"{key}.{name}", content)
        elif name == "angle_deg":
            changes["filter_angle"] = math.radians(checked_number(f"{key}.{name}", content))
        elif name == "held_towards_deg":
            if not isinstance(content, (list, tuple)) or len(content) != 2:
                raise ValueError(f"{key}.{name} = {content!r}: must be altitude and azimuth")
            altitude, azimuth = (checked_number(f"{key}.{name}", angle) for angle in content)
            changes.update(filter_mode="HELD", filter_altitude=math.radians(altitude), filter_azimuth=math.radians(azimuth))
        else:
            raise ValueError(f"{key}.{name} = {content!r}: must be strength, angle_deg or held_towards_deg")


def _read_probe(key, value, reading):
    for name, content in _table(key, value).items():
        if name == "width":
            offered = [item for item, _, _ in choices.WIDTHS]
            reading.changes["width"] = checked_number(f"{key}.{name}", content)
            reading.changes["width_choice"] = str(content) if str(content) in offered else "OTHER"
            if content % 2:
                raise ValueError(f"{key}.{name} = {content}: must be even")
        elif name in {"sun_disc", "moon_disc"}:
            if not isinstance(content, bool):
                raise ValueError(f"{key}.{name} = {content!r}: must be true or false")
            reading.changes[name.replace("disc", "mode")] = "MAP" if content else "LAMP"
        elif name in ONLY_OF_PROBE:
            _only(ONLY_OF_PROBE[name], f"{key}.{name}", content)
        elif name in OWN_OF_PROBE:
            _told(OWN_OF_PROBE[name], f"{key}.{name}", content, reading)
        else:
            raise ValueError(f"{key}.{name} = {content!r}: must not be there; the panel has no such setting")


def _read_file(key, value, reading):
    for name, content in _table(key, value).items():
        if name not in OWN_OF_FILE:
            raise ValueError(f"{key}.{name} = {content!r}: must be one of {', '.join(OWN_OF_FILE)}")
        _told(OWN_OF_FILE[name], f"{key}.{name}", content, reading)


def _read_only(key, value, reading):
    _only(ONLY[key], key, value)


def _read_tolerance(key, value, reading):
    _told(None, key, value, reading)


def _read_output(key, value, reading):
    if value:
        reading.notes.append(f"{key} = {value!r}: no file is written here")


READERS = {
    "latitude": _read_angle,
    "longitude": _read_angle,
    "elevation_m": _read_elevation,
    "place": _read_place,
    "time": _read_time,
    "zone": _read_zone,
    "sun": _read_sun,
    "sun_model": _read_only,
    "model": _read_only,
    "tolerance": _read_tolerance,
    "atmosphere": _read_air,
    "night": _read_night,
    "layers": _read_layers,
    "polarising_filter": _read_filter,
    "probe": _read_probe,
    "file": _read_file,
    "output": _read_output,
}
