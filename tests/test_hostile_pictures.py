"""Pictures that ask for more than there is: refused by the command line with a message, soon and in little memory."""

from __future__ import annotations

import os
import pathlib
import resource
import struct
import subprocess
import sys
import time

import pytest

ROOT = pathlib.Path(__file__).resolve().parent.parent
FLOAT = 2
INT_MIN, INT_MAX = -(2**31), 2**31 - 1

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="measures memory as Linux tells it")


@pytest.fixture(scope="module")
def binary() -> str:
    """The tool under test: SKYPROBE_BINARY, or what `cargo build --release` made."""
    path = pathlib.Path(os.environ.get("SKYPROBE_BINARY", ROOT / "target" / "release" / "skyprobe"))
    if not path.exists():
        pytest.fail(f"{path} is missing: cargo build --release, or name the tool in SKYPROBE_BINARY")
    return str(path)


def attribute(name: str, kind: str, value: bytes) -> bytes:
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value


def header(
    data: tuple[int, ...],
    display: tuple[int, ...] | None = None,
    *,
    compression: int = 0,
    flags: int = 0,
    more: bytes = b"",
    names: list[str] | None = None,
) -> bytes:
    channels = b"".join(
        name.encode() + b"\0" + struct.pack("<i4xii", FLOAT, 1, 1) for name in (names or ["B", "G", "R"])
    )
    return (
        struct.pack("<II", 0x01312F76, 2 | flags)
        + attribute("channels", "chlist", channels + b"\0")
        + attribute("compression", "compression", bytes([compression]))
        + attribute("dataWindow", "box2i", struct.pack("<4i", *data))
        + attribute("displayWindow", "box2i", struct.pack("<4i", *(display or data)))
        + attribute("lineOrder", "lineOrder", b"\0")
        + more
        + b"\0"
    )


def block(start: bytes, content: bytes) -> bytes:
    return start + struct.pack("<Qii", len(start) + 8, 0, len(content)) + content


PIXEL = struct.pack("<3f", 1, 1, 1)
ONE_TILE = attribute("tiles", "tiledesc", struct.pack("<IIB", 1, 1, 0))
COUNTERS = struct.pack("<11Q", 2, 1 << 46, 10, 10, 10, 10, 1 << 46, 1 << 46, 1 << 46, 1 << 46, 1)
CASES = {
    "a pixel in 32768 x 32768": block(header((0, 0, 0, 0), (0, 0, 32767, 32767)), PIXEL),
    "a pixel in 16000 x 16000": block(header((0, 0, 0, 0), (0, 0, 15999, 15999)), PIXEL),
    "windows of all numbers": block(header((INT_MIN, INT_MIN, INT_MAX, INT_MAX)), PIXEL),
    "windows inside out": block(header((INT_MAX, INT_MAX, INT_MIN, INT_MIN)), PIXEL),
    "256 million pixels in a block": block(header((0, 0, 15999, 15999), compression=9), PIXEL),
    "256 million pixels in zeros": header((0, 0, 15999, 15999), compression=3) + bytes(1 << 17),
    "a table of 256 million tiles": header((0, 0, 15999, 15999), flags=0x200, more=ONE_TILE) + bytes(1 << 12),
    "counters of 70 terabytes": block(header((0, 0, 15, 15), compression=8), COUNTERS + bytes(2800)),
    "36000 channels": header((0, 0, 0, 0), names=[f"{k:05}.R" for k in range(36000)]),
    "100000 parts": struct.pack("<II", 0x01312F76, 0x1002) + b"x\0string\0\0\0\0\0\0" * 100_000,
    "250 x 250 pixels in 15999 x 15999": header((0, 0, 249, 249), (0, 0, 15998, 15998)) + bytes(4096),
    "zeros that unpack to 256 million pixels": header((0, 0, 15998, 15998), compression=3) + bytes(535_000),
    "an attribute of 2 GB": header((0, 0, 0, 0))[:-1] + b"p\0preview\0" + struct.pack("<i", INT_MAX),
}


ONE_COLOUR = bytes([128, 64, 32, 129, 1, 1, 1, 255, 1, 1, 1, 127])
RADIANCE = {
    "rows of one colour": b"#?RADIANCE\n\n-Y 976 +X 32768\n" + 976 * ONE_COLOUR,
    "131 kB of zeros": b"#?RADIANCE\n\n-Y 32768 +X 32768\n" + bytes(131_072),
    "a header of 40 MB": b"#?RADIANCE\n" + 4_000_000 * b"# comment\n",
}


@pytest.mark.parametrize("name", [*CASES, *RADIANCE])
def test_hostile_files_are_refused(binary: str, tmp_path: pathlib.Path, name: str) -> None:
    source, target = tmp_path / ("a.exr" if name in CASES else "a.hdr"), tmp_path / "b.exr"
    source.write_bytes({**CASES, **RADIANCE}[name])
    # An allocation beyond this fails: one that were made in full would end the process.
    bound = 4 << 30
    limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (bound, bound))  # noqa: E731
    start = time.monotonic()
    process = subprocess.Popen(
        [binary, "glare", source, target], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, preexec_fn=limit
    )
    assert process.stdout is not None
    told = process.stdout.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.monotonic() - start
    print(f"{seconds:.2f} s, {usage.ru_maxrss / 1024:.0f} MB: {told.strip()}")
    assert process.returncode in (1, 2), told
    assert told.startswith("error: ") and "panicked" not in told
    assert usage.ru_maxrss < 500 * 1024
    assert not target.exists()
