"""Files from Python: whole or not at all, cancelled at any moment, and nothing overwritten that was asked to be read."""

from __future__ import annotations

import pathlib
import signal
import subprocess
import sys
import time

import pytest

import skyprobe as sp


@pytest.fixture(scope="module")
def sky() -> sp.Sky:
    return sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=sp.Atmosphere(quality="draft"))


@pytest.fixture(scope="module")
def probe(sky: sp.Sky) -> sp.Probe:
    return sky.render(width=64)


class Stages:
    """Says no at the last report of a stage, or at the first from a share of it on."""

    def __init__(self, stage: str, share: float) -> None:
        self.stage, self.share = stage, share
        self.said_no = False

    def __call__(self, stage: str, fraction: float) -> bool:
        self.said_no = self.said_no or (stage == self.stage and fraction >= self.share)
        return not self.said_no


@pytest.mark.parametrize("name", ["sky.exr", "sky.hdr", "sky.png"])
@pytest.mark.parametrize(("stage", "share"), [("render", 1.0), ("write", 0.0), ("write", 1.0)])
def test_a_no_at_any_report_leaves_no_file(sky: sp.Sky, tmp_path: pathlib.Path, name: str, stage: str, share: float) -> None:
    path = tmp_path / name
    path.write_text("before")
    for target in (path, tmp_path / f"new_{name}"):
        before = sorted(tmp_path.iterdir())
        no = Stages(stage, share)
        with pytest.raises(sp.Cancelled):
            sky.render_to_file(target, width=256, progress=no)
        assert no.said_no and sorted(tmp_path.iterdir()) == before
    assert path.read_text() == "before"


@pytest.mark.parametrize("name", ["sky.exr", "sky.hdr", "sky.png"])
def test_saving_reports_and_is_cancelled(probe: sp.Probe, tmp_path: pathlib.Path, name: str) -> None:
    heard: list[tuple[str, float]] = []
    for share in (0.0, 1.0):
        with pytest.raises(sp.Cancelled):
            probe.save(tmp_path / name, progress=Stages("write", share))
        assert not list(tmp_path.iterdir())
    probe.save(tmp_path / name, progress=lambda stage, fraction: heard.append((stage, fraction)))
    assert heard[-1] == ("write", 1.0) and [path.name for path in tmp_path.iterdir()] == [name]


INTERRUPTED = """
import pathlib, sys, skyprobe as sp
what, path = sys.argv[1:]
sky = sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=180.0, atmosphere=sp.Atmosphere(quality="draft", cache=False))
probe = sky.render(width=2048 if what == "save" else 64)
done = False
print("ready", flush=True)
try:
    if what == "save":
        for turn in range(1000):
            probe.save(path)
            pathlib.Path(path).unlink()
    elif what == "render_to_file":
        sky.render_to_file(path, width=16384)
    elif what == "solve":
        sp.Atmosphere(quality="reference", cache=False).solve()
    else:
        import numpy, skyprobe.post
        pixels = numpy.ones((2048, 4096, 3), numpy.float32)
        pixels[700, 600] = 1e6
        sp.post.glare(pixels, projection="latlong", state="scotopic", all_light=True)
    done = True
except KeyboardInterrupt:
    print("interrupted", [entry.name for entry in pathlib.Path(path).parent.iterdir() if entry.name.endswith(".part")], flush=True)
assert not done
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
@pytest.mark.parametrize("what", ["save", "render_to_file", "solve", "glare"])
def test_ctrl_c_interrupts_long_calls(tmp_path: pathlib.Path, what: str) -> None:
    arguments = [sys.executable, "-c", INTERRUPTED, what, str(tmp_path / "sky.png")]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout is not None and child.stdout.readline() == "ready\n"
        time.sleep(0.5)
        child.send_signal(signal.SIGINT)
        told = child.communicate()[0]
    assert (told, child.returncode) == ("interrupted []\n", 0)
    # Whole, if it was there in that moment.
    assert what == "save" or not list(tmp_path.iterdir())


def test_files_are_checked_before_any_work(tmp_path: pathlib.Path) -> None:
    first, second, link = tmp_path / "a.exr", tmp_path / "b.exr", tmp_path / "c.exr"
    first.write_text("")
    link.hardlink_to(first)
    sp.check_files([first], [second])
    for inputs, outputs in [([first], [link]), ([], [second, tmp_path / "." / "b.exr"]), ([first], [tmp_path / ".." / tmp_path.name / "a.exr"])]:
        with pytest.raises(sp.InputError, match="must be another file than"):
            sp.check_files(inputs, outputs)
    first.chmod(0o444)
    for write in (lambda: sp.check_files([], [first]), lambda: sp.Sky.with_sun(altitude_deg=30.0, azimuth_deg=0.0, atmosphere=sp.Atmosphere()).render_to_file(first)):
        with pytest.raises(OSError, match="read-only"):
            write()
    assert first.read_text() == ""
