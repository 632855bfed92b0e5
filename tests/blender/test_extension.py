"""The extension, from its zip to a lit scene and back, in each Blender."""

import subprocess
import sys
import zipfile

import numpy as np
import pytest

from blender import hosts


def test_the_zip_carries_wheel_and_licence_and_no_build_script(extension, wheel):
    names = set(zipfile.ZipFile(extension).namelist())
    assert {"blender_manifest.toml", "__init__.py", "LICENSE", f"wheels/{wheel.name}"} <= names
    assert "build.py" not in names


@pytest.mark.parametrize("version", hosts.VERSIONS)
def test_each_blender_finds_the_zip_valid(version, extension):
    python = hosts.python_of(version)
    (tool,) = python.parent.parent.glob("lib/python3.*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py")
    run = subprocess.run([python, tool, "validate", extension], capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr


def test_a_wheel_that_not_every_blender_can_load_is_refused(wheel, tmp_path):
    wrong = tmp_path / wheel.name.replace("-abi3-", "-cp311-")
    wrong.write_bytes(wheel.read_bytes())
    build = [sys.executable, hosts.ROOT / "blender_addon" / "build.py", wrong, "--output", tmp_path]
    run = subprocess.run(build, capture_output=True, text=True)
    assert run.returncode == 2
    assert run.stderr.count("\n") == 1 and "cp311-abi3" in run.stderr
    assert not list(tmp_path.glob("*.zip"))


@pytest.mark.parametrize("sun_mode", ["LAMP", "MAP"])
def test_the_operator_lights_a_scene_and_gives_the_old_world_back(host, sun_mode, tmp_path):
    answer = host.run("steps.light_up", sun_mode=sun_mode, picture_path=str(tmp_path / "picture.npy"))
    assert answer["answer"] == ["FINISHED"]

    state = answer["state"]
    assert state["image_size"] == [256, 128]
    assert state["image_float"] and state["image_packed"]
    assert state["color_space"] == "Linear Rec.709"
    assert state["mist_start"] == 7.0, "the copy of the world keeps what is not the sky's"
    assert len(state["lamps"]) == (1 if sun_mode == "LAMP" else 0)
    if sun_mode == "LAMP":
        strength, red, green, blue, angle = state["lamps"][0]
        assert strength > 10.0 and max(red, green, blue) == pytest.approx(1.0)
        assert np.degrees(angle) == pytest.approx(0.533, abs=0.02)
        assert state["importance"][0] == "AUTOMATIC"
        assert state["sun_threshold"] == 0.0, "EEVEE must not take a second Sun out of the map"
    else:
        assert state["importance"] == ["MANUAL", 512]
        assert 0.0 < state["sun_threshold"] < state["brightest"]

    before, after = answer["before"], answer["after_second"]
    added = {kind: after[kind] - before[kind] for kind in before}
    lamps = 1 if sun_mode == "LAMP" else 0
    assert added == {"worlds": 1, "images": 1, "lights": lamps, "objects": lamps, "node_groups": 0}
    assert answer["restored"] == {"world": True, "census": True, "strength": 3.0, "nodes": 2}

    assert not answer["alone_has_addon"]
    assert answer["alone_relative_difference"] < 1e-3, "the saved file shows the sky without the extension"
    picture = np.load(tmp_path / "picture.npy")
    assert picture.shape == (128, 192, 3) and np.isfinite(picture).all() and picture.mean() > 1.0


def test_a_probe_can_be_kept_beside_the_blend(host, tmp_path):
    answer = host.run("steps.keep_as_file", folder=str(tmp_path))
    assert "must be absolute until the .blend is saved" in answer["unsaved"]
    clear, desert, again = answer["rendered"]
    for probe in answer["rendered"]:
        assert probe["size"] == [256, 128] and not probe["packed"]
    # Another air at the same minute does not overwrite what a saved .blend shows.
    assert {f"//{path.name}" for path in tmp_path.glob("*.exr")} == {clear["filepath"], desert["filepath"]}
    assert clear == again and clear["filepath"] != desert["filepath"] and abs(clear["mean"] / desert["mean"] - 1.0) > 0.01


def test_mistakes_are_told_in_a_line_and_change_nothing(host, tmp_path):
    answers = host.run("steps.mistakes", unwritable=str(tmp_path / "absent"))
    told = {"zone": "Nowhere/Atlantis", "day": "02-30", "folder": "absent"}
    for name, word in told.items():
        message = answers[name]["message"]
        assert message.startswith("Error: ") and "\n" not in message, f"{name}: {message}"
        assert word in message
        assert answers[name]["untouched"], name


def test_a_job_runs_on_its_thread_and_a_cancelled_one_leaves_nothing(host, tmp_path):
    answer = host.run("steps.threads", folder=str(tmp_path))
    assert answer["first"] == ["NoneType", True]
    assert answer["second"] == ["Cancelled", False]
    assert answer["files"] == [answer["written"]]


def test_the_library_knows_every_air_of_the_panel(host):
    assert host.run("steps.choices") == {}


def test_a_polarising_filter_changes_the_sky(host):
    answer = host.run("steps.filtered")
    assert answer["NONE"]["keywords"] is None
    assert answer["VIEW"]["keywords"] == {"strength": 1.0, "angle_deg": 0.0}
    assert answer["HELD"]["keywords"] == {"strength": 1.0, "angle_deg": 0.0, "held_towards_deg": [20.0, 0.0]}
    for mode in ("VIEW", "HELD"):
        assert 0.01 < abs(answer[mode]["mean"] / answer["NONE"]["mean"] - 1.0) < 0.5, answer


def test_the_night_of_the_panel_is_that_of_the_probe(host):
    answer = host.run("steps.nights")
    assert answer["defaults"] == {"when": "auto", "star_limit": 8.5, "solar_flux_sfu": 130.0}
    assert answer["town_keywords"] == {"when": "auto", "star_limit": 6.5, "solar_flux_sfu": 200.0, "bortle": 8, "led_share": 0.5}
    # A mean radiance of pi times 1e-4 W m-2 sr-1 over 683 lm/W is 0.2 lx: moonlight. A city's sky is about as bright.
    assert 2e-5 < answer["full_moon"] < 3e-4, answer
    assert answer["town"] > 1.2 * answer["full_moon"], answer
    assert 0.0 <= answer["never"] < 1e-9, answer


def test_the_time_says_its_zone(host):
    assert host.run("steps.time_texts") == {
        "PLACE": "2025-06-21T13:30:00",
        "NAME": "2025-06-21T13:30:00[Europe/Stockholm]",
        "OFFSET": "2025-06-21T13:30:00-03:30",
    }
