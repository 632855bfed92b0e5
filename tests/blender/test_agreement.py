"""Blender and the command line tool make the same picture of the same settings."""

import os

import pytest

from blender import hosts


@pytest.mark.parametrize("host", hosts.VERSIONS[-1:], indirect=True)
def test_each_setting_makes_the_same_picture_on_the_command_line(host, tmp_path):
    binary = os.environ.get("SKYPROBE_BINARY", str(hosts.ROOT / "target" / "release" / "skyprobe"))
    answer = host.run("agreement_steps.compare", timeout_s=600, folder=str(tmp_path), binary=binary)
    assert answer.pop("untried") == []
    wrong = {
        name: found
        for name, found in answer.items()
        if not isinstance(found, dict) or found["lost"] or found["time"] or not isinstance(found["difference"], float) or found["difference"] > 1e-5
    }
    assert not wrong
    # A setting that changes nothing proves nothing.
    means = [found["mean"] for found in answer.values()]
    assert len({f"{mean:.9g}" for mean in means}) == len(means), answer
