"""Installed, used, switched off and on again, ten times over: nothing of the extension may stay behind."""

import zipfile

from blender import hosts


def test_the_zip_holds_every_part_of_the_add_on(extension, wheel):
    folder = hosts.ROOT / "blender_addon"
    names = set(zipfile.ZipFile(extension).namelist())
    sources = {
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts and path.name != "build.py"
    }
    licences = {path.name for path in hosts.ROOT.glob("LICENSE-*")}
    assert len(licences) == 3 and names == sources | licences | {f"wheels/{wheel.name}"}


def test_ten_times_off_and_on_leaves_nothing_behind(host):
    answer = host.run("leftovers_steps.off_and_on", times=10)
    clean, used = answer["clean"], answer["used"]
    # The steps notice what there is: else they could not notice what stays.
    assert used["classes"] and used["handlers"] and used["draw_handlers"] == 2 and used["scene_properties"] == ["skyprobe"]
    assert len(answer["off"]) == 10
    for number, state in enumerate(answer["off"]):
        assert state == clean, f"after time {number + 1}"
    for number, state in enumerate(answer["on"]):
        assert state == used, f"time {number + 1}"
    assert answer["rendered"] == 2


def test_it_is_off_in_a_file_that_was_lit_and_the_light_stays(host, tmp_path):
    answer = host.run("leftovers_steps.off_while_lit")
    assert answer["before"] == answer["after"], "the light is plain data of the file: it stays when the extension goes"
    assert answer["removed_after_return"]
