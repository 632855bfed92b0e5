"""`Scene`: one value that says all, the same in Python, in files and on the command line."""

import copy
import datetime
import json
import os
import pathlib
import pickle
import subprocess
import sys

import jsonschema
import numpy
import pytest
import random_scenes
import skyprobe as sp


@pytest.fixture(scope="module")
def scene() -> sp.Scene:
    return sp.Scene(
        latitude=55.71,
        longitude=13.19,
        time="2005-06-21T13:00",
        atmosphere={"turbidity": 3, "quality": "draft"},
        probe={"width": 64},
    )


def test_a_scene_is_what_its_parts_make(scene: sp.Scene, tmp_path: pathlib.Path) -> None:
    air = sp.Atmosphere(turbidity=3.0, quality="draft")
    sky = sp.Sky(latitude=55.71, longitude=13.19, time="2005-06-21T13:00", atmosphere=air)
    expected = sky.render(width=64).pixels
    numpy.testing.assert_array_equal(scene.render().pixels, expected)
    numpy.testing.assert_array_equal(scene.sky(air).render(width=64).pixels, expected)
    scene.render_to_files([tmp_path / "a.exr", tmp_path / "a.hdr"], air)
    for name in ("a.exr", "a.hdr"):
        again = sp.Scene.load(tmp_path / name)
        numpy.testing.assert_array_equal(again.render(air).pixels, expected)
        assert again == sky.render(width=64).scene
    assert sky.scene is not None and sky.scene.replace(probe={"width": 64}) == sky.render(width=64).scene


def test_a_scene_says_itself_again_in_every_way(scene: sp.Scene, tmp_path: pathlib.Path) -> None:
    scene.save(tmp_path / "a.json")
    ways = [
        sp.Scene.load(tmp_path / "a.json"),
        sp.Scene.from_json(scene.to_json()),
        sp.Scene(**scene.to_dict()),
        pickle.loads(pickle.dumps(scene)),
        copy.copy(scene),
        copy.deepcopy(scene),
        scene.replace(),
        scene.replace(night={"bortle": 4}).replace(night={"bortle": None}),
    ]
    assert all(way == scene for way in ways)
    assert scene != scene.replace(probe={"width": 128}) and scene != scene.replace(time="2005-06-21T13:01")
    named = sp.Scene(place="Lund, Sweden", time=datetime.date(2005, 6, 21))
    assert pickle.loads(pickle.dumps(named)) == named and json.loads(named.to_json())["time"] == "2005-06-21"
    assert repr(scene) == "<Scene: latitude 55.71, longitude 13.19, 2005-06-21T13:00; air clear, quality draft; 64 x 32>"


def test_values_of_numpy_and_paths_are_taken() -> None:
    scene = sp.Scene(
        latitude=numpy.float32(55.5),
        longitude=numpy.int64(13),
        time=datetime.datetime(2005, 6, 21, 13, tzinfo=datetime.timezone.utc),
        atmosphere={"wavelengths_nm": numpy.linspace(400.0, 700.0, 7), "ground": 0.25},
        output=[pathlib.Path("a.exr")],
        polarising_filter={"held_towards_deg": (20, 90)},
    )
    content = scene.to_dict()
    assert (content["latitude"], content["longitude"], content["output"]) == (55.5, 13.0, ["a.exr"])
    assert content["time"] == "2005-06-21T13:00:00+00:00"
    assert content["atmosphere"]["wavelengths_nm"] == [400.0, 450.0, 500.0, 550.0, 600.0, 650.0, 700.0]  # type: ignore[index]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"lattitude": 1}, "unknown key lattitude = 1: must be left out"),
        ({"atmosphere": {"turbidity": -1}}, "atmosphere.turbidity = -1: must be a number from 1 to 64"),
        ({"atmosphere": {"turbidity": float("nan")}}, "atmosphere.turbidity = nan: must be a finite number"),
        ({"atmosphere": {"aod550": 0.1, "turbidity": 2}}, "atmosphere.turbidity = 2: must be left out when aod550"),
        ({"probe": {"width": 65}}, "probe.width = 65: must be even"),
        ({"night": {"bortle": 10}}, "night.bortle = 10: must be a whole number from 1 to 9"),
        ({"sun": {"altitude_deg": 3, "azimuth_deg": 3}, "latitude": 3}, "sun = altitude 3, azimuth 3: must be left out"),
        ({"place": object()}, "place = <object"),
        ({"output": {1: 2}}, "output: must have texts as keys"),
    ],
)
def test_what_cannot_be_is_named(keys: dict[str, object], message: str) -> None:
    with pytest.raises(sp.InputError) as error:
        sp.Scene(**keys)
    assert str(error.value).startswith(message), str(error.value)


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"night": {"when": "never", "bortle": 4}}, "night.bortle = 4: must be left out where night.when is never"),
        ({"sun": {"altitude_deg": 3, "azimuth_deg": 3}, "zone": "UTC"}, 'zone = "UTC": must be left out where the Sun is put'),
        ({"model": "preetham", "layers": {"stars": 2}}, "layers.stars = 2: must be left out for the model preetham"),
        ({"probe": {"projection": "fisheye", "rows": "corner"}}, 'probe.rows = "corner": must be left out for a fisheye'),
        ({"file": {"exposure_stops": 1}, "output": "a.exr"}, "file.exposure_stops = 1: must be left out without an output"),
    ],
)
def test_what_would_be_ignored_is_refused_unless_it_is_asked_to_go(keys: dict[str, object], message: str) -> None:
    with pytest.raises(sp.InputError) as error:
        sp.Scene(**keys)
    assert str(error.value).startswith(message), str(error.value)
    kept = sp.Scene.without_ignored(**keys)
    assert sp.Scene(**kept.to_dict()) == kept


def test_other_values_put_what_was_there_out_of_force(scene: sp.Scene) -> None:
    night = scene.replace(night={"bortle": 4, "star_limit": 6.0}, layers={"moon": 2.0, "sky": 3.0})
    never = night.replace(night={"when": "never"})
    assert never == scene.replace(night={"when": "never"}, layers={"sky": 3.0})
    with pytest.raises(sp.InputError, match=r"night\.bortle = 5: must be left out where night\.when is never"):
        night.replace(night={"when": "never", "bortle": 5})


@pytest.mark.filterwarnings("ignore::skyprobe.TimeWarning")
def test_random_scenes_are_the_same_in_every_way(tmp_path: pathlib.Path) -> None:
    default = random_scenes.by_way(sp.Scene().to_dict())
    varied: set[str] = set()
    for number, document in enumerate(random_scenes.scenes(seed=1, count=200)):
        scene = sp.Scene(**document)
        values = random_scenes.by_way(scene.to_dict())
        for way, value in random_scenes.by_way(document).items():
            assert way == "place" or values.get(way, default.get(way, 0.0 if way == "probe.turn_deg" else 1.0)) == value, (way, document)
        varied |= {way for way, value in values.items() if value != default.get(way)}
        scene.save(tmp_path / "a.json")
        ways = [
            sp.Scene.load(tmp_path / "a.json"),
            sp.Scene.from_json(json.dumps(document)),
            sp.Scene.from_json(scene.to_json()),
            sp.Scene(**scene.to_dict()),
            sp.Scene.without_ignored(**document),
            sp.Scene().replace(**document),
            pickle.loads(pickle.dumps(scene)),
        ]
        assert all(way == scene for way in ways), document
        # A sky knows its scene; hazes without a solution, and models, are not asked here.
        if number % 8 == 0 and ("sun" in document or {"latitude", "longitude", "time"} <= values.keys()):
            known = random_scenes.by_way(scene.sky().scene.to_dict())  # type: ignore[union-attr]
            kept = ("night.", "atmosphere.")
            assert {way: value for way, value in known.items() if way.startswith(kept)} == {
                way: value for way, value in values.items() if way.startswith(kept)
            }
        if number % 10 == 0:
            command = [sys.executable, "-m", "skyprobe", "render", "--config", "a.json", "--dump-config"]
            dumped = subprocess.run(command, check=True, cwd=tmp_path, capture_output=True, text=True).stdout
            assert sp.Scene.from_json(dumped) == scene, document
    missing = {way for way in random_scenes.parameters() if way not in varied and way not in {"place", "layers"}}
    assert missing == {"sun.altitude_deg", "sun.azimuth_deg"} and "sun" in varied and "layers.moon" in varied


def test_what_is_missing_is_named_when_it_is_needed(tmp_path: pathlib.Path) -> None:
    with pytest.raises(sp.InputError, match="latitude = nothing"):
        sp.Scene().sky()
    with pytest.raises(sp.InputError, match="paths = "):
        sp.Scene(sun={"altitude_deg": 3, "azimuth_deg": 3}).render_to_files()
    with pytest.raises(sp.InputError, match="config = .*missing.json"):
        sp.Scene.load(tmp_path / "missing.json")
    deep: dict[str, object] = {}
    for _ in range(50):
        deep = {"a": deep}
    with pytest.raises(sp.InputError, match="less deep"):
        sp.Scene(**deep)


def test_the_command_line_makes_the_same_of_it(scene: sp.Scene, tmp_path: pathlib.Path) -> None:
    scene.save(tmp_path / "a.json")
    command = [sys.executable, "-m", "skyprobe", "render", "--config", "a.json", "-o", "a.exr"]
    subprocess.run(command, check=True, cwd=tmp_path, env={**os.environ}, capture_output=True)
    scene.render_to_files([tmp_path / "b.exr"])
    assert (tmp_path / "a.exr").read_bytes() == (tmp_path / "b.exr").read_bytes()


def test_the_schema_takes_what_the_reader_takes(scene: sp.Scene) -> None:
    command = [sys.executable, "-m", "skyprobe", "schema"]
    schema = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    judge = jsonschema.Draft202012Validator(schema)
    folder = pathlib.Path(__file__).parents[1] / "blender_addon" / "presets"
    presets = [json.loads(path.read_text(encoding="utf-8")) for path in sorted(folder.glob("*.json"))]
    for good in [scene.to_dict(), sp.Scene().to_dict(), {"sun": {"altitude_deg": 3, "azimuth_deg": 3}}, *presets]:
        sp.Scene(**good)
        assert judge.is_valid(good), good
    for bad in [
        {"lattitude": 1},
        {"latitude": 91},
        {"atmosphere": {"aod550": 0.1, "turbidity": 2}},
        {"atmosphere": {"preset": "nice"}},
        {"night": {"bortle": 10}},
        {"night": {"bortle": 3, "zenith_brightness": 20}},
        {"probe": {"width": 1.5}},
        {"place": "Lund", "latitude": 3},
        {"sun": {"altitude_deg": 3}},
        {"layers": {"comets": 1}},
        {"polarising_filter": {"held_towards_deg": [1]}},
    ]:
        with pytest.raises(sp.InputError):
            sp.Scene(**bad)
        assert not judge.is_valid(bad), bad
