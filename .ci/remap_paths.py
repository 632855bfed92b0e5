#!/usr/bin/env python3
"""Print the compiler flags that keep the builder's folders out of what is built, as CARGO_ENCODED_RUSTFLAGS wants them.

    export CARGO_ENCODED_RUSTFLAGS=$(.ci/remap_paths.py)

Messages of panics and line tables then say `crates/exr-1.74.2/src/...`, `/rustc/...` and `skyprobe/src/...`, the same on every machine. Flags that
RUSTFLAGS or CARGO_ENCODED_RUSTFLAGS hold already are kept. Needs cargo, rustc and the standard library alone.
"""

import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SEPARATOR = "\x1f"


def output(*command):
    """Return what the command prints; its complaints go to ours."""
    return subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, encoding="utf-8").stdout


def flags_from_outside():
    """Return the flags that the caller's environment asks for."""
    if encoded := os.environ.get("CARGO_ENCODED_RUSTFLAGS"):
        return encoded.split(SEPARATOR)
    return os.environ.get("RUSTFLAGS", "").split()


def folders():
    """Return pairs (folder of this machine, name that stands for it); where one is inside another, the later counts."""
    compiler = dict(line.split(": ", 1) for line in output("rustc", "-vV").splitlines() if ": " in line)
    target = os.environ.get("CARGO_BUILD_TARGET", compiler["host"])
    metadata = json.loads(output("cargo", "metadata", "--format-version=1", "--locked", "--filter-platform", target))
    pairs = [(str(ROOT), "skyprobe")]
    sources = {Path(package["manifest_path"]).parent.parent for package in metadata["packages"] if package["source"]}
    pairs += [(str(source), "crates") for source in sorted(sources)]
    library = Path(output("rustc", "--print", "sysroot").strip(), "lib", "rustlib", "src", "rust")
    # A link, where distributions have it; the compiler names both.
    pairs += [(str(path), f"/rustc/{compiler['commit-hash']}") for path in dict.fromkeys([library, library.resolve()])]
    return pairs


def main():
    remaps = [f"--remap-path-prefix={folder}={name}" for folder, name in folders()]
    kept = [flag for flag in flags_from_outside() if flag not in remaps]
    print(SEPARATOR.join(kept + remaps), end="")


if __name__ == "__main__":
    sys.exit(main())
