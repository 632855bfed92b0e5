"""Random scenes, made from the table of parameters: each is varied as its row allows.

Numbers have five digits, so that a host with single precision can keep them.
"""

import importlib.util
import random
import re
from pathlib import Path

import skyprobe

PARAMETERS_FILE = Path(__file__).resolve().parents[1] / "blender_addon" / "parameter_table.py"
TIMES = ("2005-06-21T13:00:00+02:00", "1987-01-02T03:04", "2005-01-25", "2024-02-29 00:30Z", "2011-12-30T12:00[Europe/Paris]")
ZONES = ("Europe/Stockholm", "UTC", "America/St_Johns")
PLACES = ("Lund, Sweden", "55.71, 13.19", "24 37 38 S 70 24 15 W", "Santorini")
FLAGS = {"atmosphere.polarisation", "probe.sun_disc", "probe.moon_disc", "file.layers"}


def parameters():
    """Return the rows of the table of parameters by their ways, such as night.bortle."""
    spec = importlib.util.spec_from_file_location("parameter_table", PARAMETERS_FILE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.PARAMETERS


def by_way(scene):
    """Return the values of a scene's dictionary by the ways to them."""
    values = {}
    for key, value in scene.items():
        is_table = isinstance(value, dict) and key != "sun"
        values.update({f"{key}.{name}": inner for name, inner in value.items()} if is_table else {key: value})
    return values


def scenes(seed, count):
    """Return `count` dictionaries that skyprobe.Scene takes."""
    chance = random.Random(seed)
    return [_consistent(_any_document(chance)) for _ in range(count)]


def remove(document, way):
    """Take what stands at `way` out of `document`; return whether there was something."""
    table, _, name = way.rpartition(".")
    at = document.get(table) if table else document
    found = isinstance(at, dict) and at.pop(name, None) is not None
    if not found and way == "atmosphere.aerosol":
        # A preset stands for the kind that it has.
        return remove(document, "atmosphere.preset")
    return found


def way_of(error):
    """Return the way that a message is about."""
    return re.match(r"(?:unknown key )?([\w.]+) = ", str(error)).group(1)


def _consistent(document):
    """Return `document` without keys that contradict others or would be ignored: each error names one."""
    while True:
        try:
            skyprobe.Scene(**document)
        except skyprobe.InputError as error:
            assert remove(document, way_of(error)), error
        else:
            return document


def _any_document(chance):
    document = {}
    is_put, is_named = chance.random() < 0.25, chance.random() < 0.3
    for way, row in parameters().items():
        table, _, name = way.rpartition(".")
        is_of_place = way in {"latitude", "longitude", "time"} or way == "place"
        if table == "sun":
            is_left_out = not is_put
        elif is_of_place:
            is_left_out = is_put or is_named == (way in {"latitude", "longitude"}) and way != "time"
        else:
            is_left_out = chance.random() < 0.6
        if not is_left_out:
            (document.setdefault(table, {}) if table else document)[name] = _any_value(way, row, chance)
    return document


def _any_value(way, row, chance):
    if way == "layers":
        return {name: _number(0.0, 10.0, chance) for name in chance.sample(row["words"], 3)}
    if way == "probe.width":
        return 4 * chance.randint(row["low"] // 4, row["high"] // 4)
    if way in FLAGS:
        return chance.random() < 0.5
    texts = {"time": TIMES, "zone": ZONES, "place": PLACES}
    if way in texts:
        return chance.choice(texts[way])
    if way == "output":
        return [f"{chance.choice('abc')}.{suffix}" for suffix in chance.sample(["exr", "hdr", "png"], chance.randint(1, 3))]
    if way == "polarising_filter.held_towards_deg":
        return [_number(-90.0, 90.0, chance), _number(-360.0, 360.0, chance)]
    if way == "atmosphere.wavelengths_nm":
        return sorted(_number(300.0, 1000.0, chance) for _ in range(4))
    if "words" in row and ("low" not in row or chance.random() < 0.5):
        return chance.choice(row["words"])
    if isinstance(row["low"], int):
        return chance.randint(row["low"], row["high"])
    return _number(row["low"], row["high"], chance)


def _number(low, high, chance):
    return min(max(float(f"{chance.uniform(low, high):.5g}"), low), high)
