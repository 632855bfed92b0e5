"""Rebuilds data/planets_vsop.bin, series of the planets' motion: VSOP87A for Mercury to Saturn, VSOP2013 for Uranus and Neptune.

    python data/scripts/planets_vsop.py

Needs numpy and cargo. From the crates vsop87 3.0.0 and celestial-ephemeris 0.1.1-alpha.2 (both MIT or Apache-2.0), which carry the authors' files:
Bretagnon & Francou 1988, A&A 202, 309; Simon, Francou, Fienga & Manche 2013, A&A 557, A49. VSOP87 was fitted to DE200, which leaves
1.7 arcseconds in Uranus and 2.6 in Neptune between 1900 and 2100; VSOP2013 (the crate's cut: 1e-7) has 0.9 and 0.6. The crate's VSOP2013
of the inner planets is not usable (36 arcseconds and more).

Terms of VSOP87A are left out that move the planet by less than 0.01 arcseconds at its smallest distance from the Earth, at a millennium from J2000.

The file: blocks of a planet (1 Mercury, 2 Venus, 4 Mars .. 8 Neptune), a variable, a power of t, 0 (u8 each) and a number of terms (u32), then the
terms: amplitude, phase [radians], frequency [radians a millennium] (f64). Value: sum of amplitude t^power cos(phase + frequency t), t in
Julian millennia from J2000. Variables of VSOP87A: x, y, z [au], of VSOP2013: a [au], mean longitude [radians], k, h, q, p. Little endian.
"""

import re
import struct
from pathlib import Path

import numpy as np

from packages import DATA, unpack_from_crates_io

VSOP87A = {"mercury": 1, "venus": 2, "mars": 4, "jupiter": 5, "saturn": 6}
VSOP2013 = {"uranus": 7, "neptune": 8}
SMALLEST_DISTANCE_AU = {"mercury": 0.53, "venus": 0.26, "mars": 0.37, "jupiter": 3.95, "saturn": 8.0}
CUT_ARCSECONDS = 0.01

# Mean longitudes at J2000 [radians] and mean motions [radians a millennium] that VSOP2013's multipliers belong to (as its authors' program has them).
LONGITUDES = np.array([
    4.402608631669, 3.176134461576, 1.753470369433, 6.203500014141, 4.091360003050, 1.713740719173, 5.598641292287, 2.805136360408,
    2.326989734620, 0.599546107035, 0.874018510107, 5.481225395663, 5.311897933164, 0.0, 5.19846640063, 1.62790513602, 2.35555563875,
])  # fmt: skip
MOTIONS = np.array([
    26087.90314068555, 10213.28554743445, 6283.075850353215, 3340.612434145457, 1731.170452721855, 1704.450855027201, 1428.948917844273,
    1364.756513629990, 1361.923207632842, 529.6909615623250, 213.2990861084880, 74.78165903077800, 38.13297222612500, 0.3595362285049309,
    77713.7714481804, 84334.6615717837, 83286.9142477147,
])  # fmt: skip


def number(text: str) -> float:
    text = text.strip().replace("_", "")
    return np.pi if text == "PI" else float(text)


def vsop87a(folder: Path, planet: str):
    """Yields variable, power, (amplitude, phase, frequency) of each kept term."""
    cut = CUT_ARCSECONDS * np.pi / 648000 * SMALLEST_DISTANCE_AU[planet]
    source = (folder / f"src/vsop87a/{planet}.rs").read_text()
    for axis, power, table in re.findall(r"const ([XYZ])(\d): \[\[f64; \d+\]; 3\] = \[(.*?)\n\];", source, re.S):
        columns = [[number(v) for v in part.split(",") if v.strip()] for part in re.findall(r"\[(.*?)\]", table, re.S)]
        for term in zip(*columns, strict=True):
            if abs(term[0]) > cut:
                yield "XYZ".index(axis), int(power), term


def vsop2013(folder: Path, planet: str):
    """Yields variable, power, (amplitude, phase, frequency) of each term."""
    source = (folder / f"src/planetary_coefficients/{planet}.rs").read_text()
    names = ["A", "LAMBDA", "K", "H", "Q", "P"]
    for name, table in re.findall(r"pub const (\w+): &\[TimeBlock\] = &\[(.*?)\n\];", source, re.S):
        for power, terms in re.findall(r"power: (\d+),\s*terms: &\[(.*?)\n        \],", table, re.S):
            for sine, cosine, multipliers in re.findall(r"s: ([-\d.e]+),\s*c: ([-\d.e]+),\s*mult: \[([^\]]*)\]", terms):
                s, c = float(sine), float(cosine)
                counts = np.array([int(v) for v in multipliers.split(",") if v.strip()])
                phase = (counts @ LONGITUDES - np.arctan2(s, c)) % (2 * np.pi)
                yield names.index(name), int(power), (np.hypot(s, c), phase, counts @ MOTIONS)


def main() -> None:
    by_87, by_2013 = unpack_from_crates_io("vsop87", "3.0.0"), unpack_from_crates_io("celestial-ephemeris", "0.1.1-alpha.2")
    series = [(number, vsop87a(by_87, planet)) for planet, number in VSOP87A.items()]
    series += [(number, vsop2013(by_2013, planet)) for planet, number in VSOP2013.items()]
    count, blocks = 0, []
    for planet, terms in series:
        by_block: dict[tuple, list] = {}
        for variable, power, term in terms:
            by_block.setdefault((variable, power), []).append(term)
        for (variable, power), block in sorted(by_block.items()):
            block.sort(key=lambda term: abs(term[0]))
            blocks.append(struct.pack("<BBBBI", planet, variable, power, 0, len(block)))
            blocks += [struct.pack("<ddd", *term) for term in block]
            count += len(block)
    (DATA / "planets_vsop.bin").write_bytes(b"".join(blocks))
    print(f"data/planets_vsop.bin: {count} terms")


if __name__ == "__main__":
    main()
