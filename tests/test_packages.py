"""What is handed out: notices that go with it, nothing of the builder's machine in it, and old enough systems that load it."""

import os
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
LICENCES = ["LICENSE-APACHE", "LICENSE-MIT", "LICENSE-THIRD-PARTY"]
# The glibc that Blender itself asks for.
GLIBC = (2, 28)


@pytest.fixture(scope="module")
def wheel():
    """The wheel under test: SKYPROBE_WHEEL, or the newest in dist/."""
    named = os.environ.get("SKYPROBE_WHEEL")
    wheels = [Path(named)] if named else sorted((ROOT / "dist").glob("skyprobe-*.whl"), key=lambda path: path.stat().st_mtime)
    if not wheels:
        pytest.fail("no wheel in dist/: build it as tests/run.sh does, or name it in SKYPROBE_WHEEL")
    return wheels[-1]


@pytest.fixture(scope="module")
def library(wheel):
    """The bytes of the extension module in the wheel."""
    archive = zipfile.ZipFile(wheel)
    (name,) = [name for name in archive.namelist() if re.fullmatch(r"skyprobe/_core\..*(so|pyd)", name)]
    return archive.read(name)


@pytest.fixture(scope="module")
def tool():
    """The bytes of the command line tool: SKYPROBE_BINARY, or what `cargo build --release` made."""
    path = Path(os.environ.get("SKYPROBE_BINARY", ROOT / "target" / "release" / "skyprobe"))
    if not path.exists():
        pytest.fail(f"{path} is missing: cargo build --release, or name the tool in SKYPROBE_BINARY")
    return path.read_bytes()


def output(*command):
    return subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def folders_of_this_machine():
    """Everything whose path a compiler could leave in what it makes."""
    named = [os.environ.get(name) for name in ("CARGO_HOME", "RUSTUP_HOME", "CARGO_TARGET_DIR")]
    folders = [ROOT, Path.home(), Path(output("rustc", "--print", "sysroot").strip()), *(Path(name) for name in named if name)]
    return [folder for folder in folders if len(folder.parts) > 1]


def check_no_paths(content):
    for folder in folders_of_this_machine():
        found = re.findall(re.escape(os.fsencode(folder)) + rb"[/\\][ -~]{0,60}", content)
        assert not found, f"{len(found)} paths, such as {found[0]}: set CARGO_ENCODED_RUSTFLAGS=$(.ci/remap_paths.py) where it is built"
    assert b".cargo/registry" not in content and b".rustup/toolchains" not in content


def test_the_notices_are_those_of_the_crates_and_the_data():
    check = subprocess.run([sys.executable, ROOT / ".ci" / "notices.py", "--check"], capture_output=True, text=True)
    assert check.returncode == 0, check.stderr


def test_a_crate_that_comes_goes_or_changes_makes_the_notices_stale():
    listed = set(re.findall(r"(?m)^(\S+) (\d\S*): ", (ROOT / "LICENSE-THIRD-PARTY").read_text(encoding="utf-8")))
    locked = set(re.findall(r'name = "(.+)"\nversion = "(.+)"', (ROOT / "Cargo.lock").read_text(encoding="utf-8")))
    assert listed <= locked
    linked = output("cargo", "tree", "--locked", "--features", "python", "--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}")
    linked = set(re.findall(r"(?m)^(\S+) v(\S+)", linked)) - {("skyprobe", version) for name, version in locked if name == "skyprobe"}
    assert len(linked) > 50 and linked <= listed


def test_every_table_has_its_notice():
    notices = (ROOT / "data" / "NOTICES.txt").read_text(encoding="utf-8")
    tables = [path.name for path in (ROOT / "data").iterdir() if path.suffix in {".bin", ".csv", ".png", ".txt"} and path.name != "NOTICES.txt"]
    assert len(tables) > 15
    assert [name for name in tables if name not in notices] == []


def test_the_notices_hold_the_texts_that_licences_ask_for():
    text = (ROOT / "LICENSE-THIRD-PARTY").read_text(encoding="utf-8")
    for part in [
        "ODC Open Database License (ODbL)",
        "© OpenStreetMap contributors",
        "https://creativecommons.org/licenses/by/4.0/",
        "Redistributions in binary form must reproduce the above copyright",
        "This notice may not be removed or altered from any source distribution.",
        "UNICODE LICENSE V3",
        "derived from software provided by SOFA",
        "© Axel Mellinger",
    ]:
        assert part in text, part


def test_wheel_zip_and_source_carry_the_notices(wheel, tmp_path):
    archive = zipfile.ZipFile(wheel)
    carried = {name.rsplit("/", 1)[1]: archive.read(name) for name in archive.namelist() if ".dist-info/licenses/" in name}
    assert carried == {name: (ROOT / name).read_bytes() for name in LICENCES}
    metadata = archive.read(next(name for name in archive.namelist() if name.endswith(".dist-info/METADATA"))).decode()
    assert sorted(re.findall("(?m)^License-File: (.*)$", metadata)) == LICENCES
    subprocess.run([sys.executable, ROOT / "blender_addon" / "build.py", wheel, "--output", tmp_path], check=True, capture_output=True)
    (extension,) = tmp_path.glob("*.zip")
    extension = zipfile.ZipFile(extension)
    assert {name: extension.read(name) for name in LICENCES} == carried
    assert set(LICENCES) < set(output("cargo", "package", "--list", "--locked", "--allow-dirty").split())


def test_nothing_of_the_builder_s_machine_is_in_the_library(library):
    check_no_paths(library)
    # Messages of panics still say where.
    assert re.search(rb"crates/exr-\d[\d.]*/src/", library) and re.search(rb"(?<![/\w])src/light/", library)


def test_nothing_of_the_builder_s_machine_is_in_the_tool(tool):
    check_no_paths(tool)
    assert re.search(rb"crates/exr-\d[\d.]*/src/", tool)


@pytest.mark.skipif(sys.platform != "linux", reason="of Linux alone")
def test_the_library_loads_where_blender_does(wheel, library):
    assert re.search(r"-cp311-abi3-manylinux_2_28_(x86_64|aarch64)\.whl$", wheel.name)
    asked = {(int(major), int(minor)) for major, minor in re.findall(rb"GLIBC_(\d+)\.(\d+)", library)}
    assert asked and max(asked) <= GLIBC
