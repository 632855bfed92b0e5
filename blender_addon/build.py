# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the installable extension: this folder and the skyprobe wheel in one zip, for each platform.

    python blender_addon/build.py [WHEEL...]

A WHEEL is a skyprobe wheel for Python 3.11 or later (abi3) and one platform; without it, the only one in dist/ is taken. The results are
dist/skyprobe-VERSION-PLATFORM.zip, checked by Blender's own extension tool where a bpy package is found: in this Python, or in a
virtual environment .venv-bpy* of the checkout. Needs nothing but the standard library. docs/packaging.md explains the rest.
"""

import argparse
import importlib.util
import re
import subprocess
import sys
import tempfile
import tomllib
import zipfile
from pathlib import Path

ADDON = Path(__file__).resolve().parent
ROOT = ADDON.parent
DIST = ROOT / "dist"

# Blender's platform names by the platform tags of wheels.
PLATFORMS = {
    r"manylinux_.*_x86_64|manylinux2014_x86_64|linux_x86_64": "linux-x64",
    r"manylinux_.*_aarch64|linux_aarch64": "linux-arm64",
    r"macosx_.*_arm64": "macos-arm64",
    r"macosx_.*_x86_64": "macos-x64",
    r"win_amd64": "windows-x64",
    r"win_arm64": "windows-arm64",
}

# What the extension consists of, by the ending of names; whatever else lies about in the folder stays out.
ENDINGS = {".py", ".json", ".png", ".svg"}


class BuildError(Exception):
    """The extension cannot be built; the message says why."""


def find_wheel():
    """Return the only skyprobe wheel in dist/."""
    wheels = sorted(DIST.glob("skyprobe-*.whl"))
    if len(wheels) != 1:
        raise BuildError(f"{len(wheels)} skyprobe wheels in {DIST}: name the one to bundle")
    return wheels[0]


def read_wheel_name(wheel):
    """Return (version, Blender platform) of the wheel at the path `wheel`."""
    match = re.fullmatch(r"skyprobe-([^-]+)-cp311-abi3-([^-]+)\.whl", wheel.name)
    if not match:
        raise BuildError(f"{wheel.name}: must be skyprobe-VERSION-cp311-abi3-PLATFORM.whl, which every Blender from 4.2 on can load")
    version, tags = match.groups()
    for pattern, platform in PLATFORMS.items():
        if re.fullmatch(pattern, tags.split(".")[0]):
            return version, platform
    raise BuildError(f"{wheel.name}: Blender does not know the platform {tags}")


def manifest_with(wheel, version, platform):
    """Return the text of the manifest with the lines that depend on the wheel."""
    text = (ADDON / "blender_manifest.toml").read_text(encoding="utf-8")
    stated = tomllib.loads(text)["version"]
    if stated != version:
        raise BuildError(f"the wheel is version {version}, blender_manifest.toml says {stated}: make them the same")
    lines = f'platforms = ["{platform}"]\nwheels = ["./wheels/{wheel.name}"]\n'
    # Keys of the top level must come before the first table.
    return text.replace("\n[permissions]", f"{lines}\n[permissions]", 1)


def write_zip(target, wheel, manifest):
    """Write the extension to `target`, the same bytes for the same input."""
    content = {"blender_manifest.toml": manifest.encode(), f"wheels/{wheel.name}": wheel.read_bytes()}
    content["LICENSE"] = (ADDON / "LICENSE").read_bytes()
    # Those of the library and of what is in it: the wheel carries them too, but few look there.
    content |= {path.name: path.read_bytes() for path in ROOT.glob("LICENSE-*")}
    for source in ADDON.rglob("*"):
        if source.suffix in ENDINGS and source != Path(__file__).resolve():
            content[source.relative_to(ADDON).as_posix()] = source.read_bytes()
    with zipfile.ZipFile(target, "w") as archive:
        for name in sorted(content):
            # A fresh ZipInfo carries a fixed date.
            entry = zipfile.ZipInfo(name)
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content[name], zipfile.ZIP_DEFLATED)


def refuse_two_of_a_platform(wheels):
    """Make sure that no zip would take the place of another."""
    seen = {}
    for wheel in wheels:
        _, platform = read_wheel_name(wheel)
        if platform in seen:
            raise BuildError(f"{seen[platform].name} and {wheel.name} are both for {platform}: name one")
        seen[platform] = wheel


def find_validator():
    """Return the path of the newest Blender's extension tool, or None."""
    roots = [Path(path) for path in ROOT.glob(".venv-bpy*/lib/python3.*/site-packages/bpy")]
    spec = importlib.util.find_spec("bpy")
    if spec and spec.submodule_search_locations:
        roots[:0] = [Path(path) for path in spec.submodule_search_locations]
    tools = [tool for root in roots for tool in root.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")]
    # The rules of the newest Blender hold for all that come.
    return max(tools, key=lambda tool: _version(tool.parents[4].name), default=None)


def _version(name):
    return tuple(int(number) for number in name.split("."))


def validate(archive, tool):
    """Let Blender's own tool judge `archive`."""
    run = subprocess.run([sys.executable, tool, "validate", archive], capture_output=True, text=True)
    if run.returncode != 0:
        raise BuildError(f"Blender refuses the extension:\n{run.stdout}{run.stderr}".rstrip())


def build(wheel, target_folder):
    """Build the extension around `wheel` into `target_folder`; return its path and whether it was validated."""
    version, platform = read_wheel_name(wheel)
    target_folder.mkdir(parents=True, exist_ok=True)
    target = target_folder / f"skyprobe-{version}-{platform.replace('-', '_')}.zip"
    tool = find_validator()
    # Only an extension that is whole and valid takes the name.
    with tempfile.TemporaryDirectory(dir=target_folder) as folder:
        archive = Path(folder) / target.name
        write_zip(archive, wheel, manifest_with(wheel, version, platform))
        if tool:
            validate(archive, tool)
        archive.replace(target)
    return target, tool is not None


def main():
    parser = argparse.ArgumentParser(description="Make the installable Blender extension of skyprobe.")
    parser.add_argument("wheels", nargs="*", type=Path, help="the skyprobe wheels to bundle, one a platform (default: the one in dist/)")
    parser.add_argument("--output", type=Path, default=DIST, help="folder for the zip (default: dist/)")
    arguments = parser.parse_args()
    try:
        wheels = arguments.wheels or [find_wheel()]
        refuse_two_of_a_platform(wheels)
        for wheel in wheels:
            target, validated = build(wheel, arguments.output)
            print(f"{target} ({'valid by Blender' if validated else 'not validated: no bpy found'})")
    except (BuildError, OSError) as error:
        print(f"build: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
