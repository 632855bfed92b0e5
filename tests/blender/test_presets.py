"""Presets and configurations: the same keys as the command line tool, and back."""

import json
import os
import subprocess

import pytest

from blender import hosts


def skyprobe(*arguments):
    """Run the command line tool; return what it prints."""
    binary = os.environ.get("SKYPROBE_BINARY", str(hosts.ROOT / "target" / "release" / "skyprobe"))
    run = subprocess.run([binary, *arguments], capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


def test_a_configuration_goes_out_and_comes_back_whole(host, tmp_path):
    path = tmp_path / "sky.json"
    answer = host.run("preset_steps.round_trip", path=str(path))
    assert answer == {"different": {}, "reset": []}
    content = json.loads(path.read_text(encoding="utf-8"))
    assert content["atmosphere"]["visibility_km"] == 12.5 and content["night"]["bortle"] == 4
    # The command line tool takes the same file, and has read the same numbers.
    dumped = json.loads(skyprobe("render", "--config", str(path), "-o", str(tmp_path / "sky.exr"), "--dump-config"))
    for key in ("latitude", "longitude", "elevation_m", "time", "zone", "layers", "polarising_filter"):
        assert dumped[key] == content[key], key
    for table in ("atmosphere", "night", "probe"):
        assert {key: dumped[table][key] for key in content[table]} == content[table]


def test_times_of_each_spelling_are_understood(host):
    assert host.run("preset_steps.offset_times") == {
        "2024-02-29T06:30": ["PLACE", "Europe/Stockholm", 0.0, "2024-02-29T06:30:00"],
        "2024-02-29 06:30": ["PLACE", "Europe/Stockholm", 0.0, "2024-02-29T06:30:00"],
        "2024-02-29T06": ["PLACE", "Europe/Stockholm", 0.0, "2024-02-29T06:00:00"],
        "2024-02-29T06:30+02": ["OFFSET", "Europe/Stockholm", 2.0, "2024-02-29T06:30:00+02:00"],
        "2024-02-29T06:30:15-03:30": ["OFFSET", "Europe/Stockholm", -3.5, "2024-02-29T06:30:15-03:30"],
        "2024-02-29T06:30Z": ["OFFSET", "Europe/Stockholm", 0.0, "2024-02-29T06:30:00+00:00"],
        "2024-02-29T06:30[Asia/Tokyo]": ["NAME", "Asia/Tokyo", 0.0, "2024-02-29T06:30:00[Asia/Tokyo]"],
        "2005-06-21T13:00Z[Europe/Stockholm]": ["NAME", "Europe/Stockholm", 0.0, "2005-06-21T15:00:00[Europe/Stockholm]"],
        "2005-06-21T13:00Z in Europe/Stockholm": ["NAME", "Europe/Stockholm", 0.0, "2005-06-21T15:00:00[Europe/Stockholm]"],
        "2005-06-21T13:00 in Asia/Tokyo": ["NAME", "Asia/Tokyo", 0.0, "2005-06-21T13:00:00[Asia/Tokyo]"],
        "2005-10-30T02:30+02:00[Europe/Stockholm]": ["NAME", "Europe/Stockholm", 0.0, "2005-10-30T02:30:00[Europe/Stockholm]"],
        "2005-10-30T02:30+01:00[Europe/Stockholm]": ["OFFSET", "Europe/Stockholm", 1.0, "2005-10-30T02:30:00+01:00"],
        "1850-06-21T12:00:00+01:12:12": ["OFFSET", "Europe/Stockholm", 1.2, "1850-06-21T11:59:48+01:12"],
        "2005-06-21T12:00+18:00": ["OFFSET", "Europe/Stockholm", 14.0, "2005-06-21T08:00:00+14:00"],
    }


def test_what_blender_does_without_is_told(host):
    answer = host.run("preset_steps.told")
    notes = "\n".join(answer["notes"])
    for fragment in (
        "Lund", "2005-03-27T02:30:00 does not exist", "tolerance = 0.01", "probe.rows = 'corner'", "probe.turn_deg = 90.0", "probe.scale = 'mitsuba'", "probe.color_space = 'acescg'",
        "probe.gamut = 'keep'", "file.half = 'scale'", "file.exposure_stops = 1.0", "file.operator = 'aces'", "file.layers = True", "output = ['sky.exr', 'sky.png']",
    ):
        assert fragment in notes, fragment
    assert answer["width"] == 512 and answer["latitude"] == pytest.approx(55.706, abs=1e-3) and answer["hour"] == pytest.approx(3.5)


def test_what_the_command_line_dumps_takes_the_place_of_all_settings(host, tmp_path):
    path = tmp_path / "dumped.json"
    path.write_text(skyprobe("render", "--lat", "55.71", "--lon", "13.19", "--time", "2005-06-21 13:00", "-o", "x.exr", "--dump-config"), encoding="utf-8")
    answer = host.run("preset_steps.dumped", path=str(path))
    assert answer == {
        "notes": ["output = ['x.exr']: no file is written here"],
        "layers": {},
        "filter": None,
        "air": {"preset": "clear", "quality": "standard"},
        "place": {"latitude": 55.71, "longitude": 13.19, "elevation_m": 0.0},
        "time": "2005-06-21T13:00:00",
    }


def test_each_preset_that_is_shipped_shows_what_it_promises(host, tmp_path):
    answer = host.run("preset_steps.shipped")
    # Illuminance of the ground [lx], wide ranges of what each is called after.
    expected = {
        "Airliner at Sunset": (100.0, 2e4),
        "Blue Hour": (0.5, 30.0),
        "City Night": (1e-3, 0.3),
        "Desert Afternoon": (3e4, 1.1e5),
        "Full Moon": (0.1, 0.5),
        "Golden Hour": (1e3, 2e4),
        "Milky Way over Chile": (5e-4, 2e-3),
        "Morning Fog": (1e3, 3e4),
        "Polar Night": (20.0, 500.0),
        "Summer Noon": (6e4, 1.1e5),
        "Volcanic Twilight": (1.0, 100.0),
    }
    assert set(answer) == set(expected)
    for title, (least, most) in expected.items():
        assert least < answer[title]["lx"] < most, (title, answer[title]["lx"])
        content = json.loads(answer[title]["text"])
        if "latitude" in content:
            path = tmp_path / "preset.json"
            path.write_text(answer[title]["text"], encoding="utf-8")
            skyprobe("render", "--config", str(path), "-o", str(tmp_path / "sky.exr"), "--dump-config")


def test_a_preset_of_ones_own_holds_what_was_chosen(host):
    answer = host.run("preset_steps.own")
    assert answer["content"] == {"atmosphere": {"preset": "desert", "quality": "draft", "polarisation": True}}
    assert answer["applied"] == ["desert", 7]
    assert answer["left"] == []
    assert "must be a file's name" in answer["bad_name"]


def test_a_file_that_makes_no_sense_changes_nothing(host, tmp_path):
    answer = host.run("preset_steps.refused", folder=str(tmp_path))
    told = {
        "not JSON": "must be JSON",
        "a list": "must be a table of keys and values",
        "an unknown key": "unknown key month = 3",
        "an unknown preset": "stormy",
        "a text for a number": "must be a number",
        "a latitude too far": "latitude",
        "no such date": "2025-02-30",
        "two amounts of haze, one negative": "aod550 = -1",
        "another model": "model = 'preetham'",
        "another theory of the Sun": "sun_model = 'thesis'",
        "a Sun that is put": "sun = ",
        "another projection": "probe.projection = 'fisheye'",
        "the upper half": "probe.extent = 'upper'",
        "a mirrored ground": "probe.ground = 'mirrored'",
        "light without polarisation": "atmosphere.polarisation = False",
        "chosen wavelengths": "atmosphere.wavelengths_nm = [500.0, 600.0]",
        "a ground by its albedo": "atmosphere.ground = 0.3: must be one of preset, grass",
        "a layer as bright as no property": "layers.stars = 100000000.0: must be from 0 to 1e+06 in Blender",
        "towns by their brightness": "night.zenith_brightness = 20.0: must be left out; Blender's sky has no other",
        "a scattering function": "atmosphere.asymmetry = 0.5: must be left out",
        "a night that is never shown": "night.bortle = 4: must be left out where night.when is never",
        "a place twice": 'place = "Lund, Sweden"',
        "two amounts of haze": "atmosphere.turbidity = 3",
        "a key that is there twice": 'atmosphere.preset = "fog" and "clear": must be given once',
        "no such zone": "Nowhere/Atlantis",
        "not UTF-8": "must be JSON",
    }
    for name, fragment in told.items():
        assert fragment in answer[name]["message"], (name, answer[name])
        assert "\n" not in answer[name]["message"]
        assert answer[name]["unchanged"], name
    assert "95" in answer["a latitude too far"]["message"]
