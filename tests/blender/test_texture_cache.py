"""The tiles that Cycles keeps beside pictures, from Blender 5.2 on."""

import pytest

from blender import hosts


@pytest.mark.parametrize("host", [version for version in hosts.VERSIONS if version >= "5.2"], indirect=True)
def test_tiles_go_with_the_picture_that_they_are_of(host, tmp_path):
    answer = host.run("texture_cache_steps.use_and_remove", folder=str(tmp_path))
    folder, tile = answer["probe"]
    assert folder == "blender_tx" and tile.startswith("blender_tx/sky_+55.7100_+13.1900_")
    assert answer["probe replaced"] == []
    assert sum("sky_000" in name for name in answer["sequence"]) == 2
    assert answer["removed"] == ["frames/blender_tx", "frames/blender_tx/wood.exr.0-AB.tx"]
