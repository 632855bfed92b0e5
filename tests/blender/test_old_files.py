"""Files of Blender 4 in Blender 5, which keeps the settings elsewhere."""

import pytest

from blender import hosts

FIVES = [version for version in hosts.VERSIONS if version >= "5"]


@pytest.mark.parametrize("late", [False, True], ids=["", "extension switched on later"])
@pytest.mark.parametrize("host", FIVES, indirect=True)
def test_a_sky_of_blender_4_goes_without_a_trace(host, host_of, late, tmp_path):
    path = str(tmp_path / "old.blend")
    saved = host_of("4.5").run("old_file_steps.save", path=path)
    assert saved["lit"] != saved["before"]
    answer = host.run("old_file_steps.remove", path=path, late=late)
    assert answer["kept"] == {"year": 2005, "hour": 0.5, "moon_mode": "LAMP", "shown": "PROBE"}
    assert answer["lit"] == saved["lit"]
    assert answer["left"] == saved["before"]
    assert answer["world"] == "Mine"
    assert not answer["custom"]
