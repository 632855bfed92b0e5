"""The extension, built once from the wheel and installed once in each Blender."""

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

TESTS = Path(__file__).resolve().parent.parent
# The interpreter that runs pytest need not be told where the shared modules are.
sys.path.insert(0, str(TESTS))

from blender import hosts, window  # noqa: E402


@dataclass(frozen=True)
class Host:
    """A Blender in which the extension is installed."""

    version: str
    resources: Path

    def run(self, function, **arguments):
        """Call `function` of a script in this folder inside this Blender; see hosts.run."""
        return hosts.run(self.version, function, self.resources, **arguments)


@pytest.fixture(scope="session")
def wheel():
    """The wheel under test: SKYPROBE_WHEEL, or the newest in dist/."""
    named = os.environ.get("SKYPROBE_WHEEL")
    wheels = [Path(named)] if named else sorted((hosts.ROOT / "dist").glob("skyprobe-*.whl"), key=lambda path: path.stat().st_mtime)
    if not wheels:
        pytest.fail("no wheel in dist/: build it with maturin, or name it in SKYPROBE_WHEEL")
    return wheels[-1]


@pytest.fixture(scope="session")
def extension(wheel, tmp_path_factory):
    """The path of the extension's zip, made by its build script."""
    folder = tmp_path_factory.mktemp("extension")
    build = [sys.executable, hosts.ROOT / "blender_addon" / "build.py", wheel, "--output", folder]
    run = subprocess.run(build, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    (archive,) = folder.glob("*.zip")
    assert str(archive) in run.stdout
    return archive


@pytest.fixture(scope="session")
def host_of(request, tmp_path_factory):
    """A function that returns the Blender of a version, with the extension installed from its zip."""
    found = {}

    def make(version):
        if version not in found:
            hosts.python_of(version)
            extension = request.getfixturevalue("extension")
            host = Host(version, tmp_path_factory.mktemp(f"blender{version}"))
            answer = host.run("steps.install", archive=str(extension))
            assert answer["version"].startswith(version)
            found[version] = host
        return found[version]

    return make


@pytest.fixture(scope="session", params=hosts.VERSIONS)
def host(request, host_of):
    """Each Blender in turn, with the extension installed from its zip."""
    return host_of(request.param)


@dataclass(frozen=True)
class Window:
    """A Blender with a window, into which the add-on is loaded from its folder."""

    blender: window.Blender
    wheel: Path

    def run(self, function, **arguments):
        """Let the step function `function` run in a window of its own; see window.run."""
        return window.run(self.blender, function, self.wheel, **arguments)


@pytest.fixture(scope="session", params=window.find_blenders() or [None], ids=lambda blender: blender.name if blender else "none")
def windowed(request, wheel):
    """Each Blender in turn that opens a window."""
    if request.param is None:
        if os.environ.get("SKYPROBE_SKIP_HOSTS") == "1":
            pytest.skip("no blender, and SKYPROBE_SKIP_HOSTS=1")
        pytest.fail("no blender in the PATH: tests/setup_hosts.sh installs it, or set SKYPROBE_SKIP_HOSTS=1")
    return Window(request.param, wheel)


@pytest.fixture
def pictures(windowed, tmp_path):
    """The folder for screenshots: one inside SKYPROBE_PICTURES, to look at them, or one that goes."""
    kept = os.environ.get("SKYPROBE_PICTURES")
    folder = Path(kept) / windowed.blender.name if kept else tmp_path
    folder.mkdir(parents=True, exist_ok=True)
    return folder
