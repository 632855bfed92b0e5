"""Rebuilds data/moon_elp_mpp02.bin, the series of the Moon's motion ELP/MPP02, from the crate celestial-ephemeris 0.1.1-alpha.2 (MIT or Apache-2.0).

    python data/scripts/moon_elp_mpp02.py

Needs numpy and cargo. The crate carries the authors' files (Chapront & Francou 2003, A&A 404, 735), already without terms below 0.001
arcseconds; terms below the cuts here are left out too. The crate evaluates the main problem with its nominal constants; here the
amplitudes are corrected to the constants fitted to DE405 by the derivatives B1 to B5 that it carries along, as the
authors' paper says, which removes 0.1 arcseconds.

The file: blocks of a coordinate (0 longitude, 1 latitude, 2 distance), a power of t and a number of terms (u8, u8, u16), then the terms: amplitude
[arcseconds or km] and phase [radians] (f64), 13 multipliers (i8) of D, F, l, l', the longitudes of Mercury to Neptune, and zeta. Value: sum of
amplitude t^power sin(phase + multipliers . arguments), t in Julian centuries from J2000. Little endian.
"""

import re
import struct

import numpy as np

from packages import DATA, unpack_from_crates_io

CUTS = {"LONGITUDE": 0.002, "LATITUDE": 0.002, "DISTANCE": 0.005}
ARCSECOND = np.pi / 648000

# Constants of the main problem [radians, radians a century] and their corrections for DE405 (Chapront & Francou 2003 and their
# program ELPMPP02).
M = 0.074801329
ALPHA = 0.002571881
MEAN_MOTION = (1732559343.73604 - 0.35106) * ARCSECOND
NU = (0.55604 - 0.35106) * ARCSECOND / MEAN_MOTION
GAMMA = (-0.08066 + 0.00085) * ARCSECOND
ECCENTRICITY = (0.01789 - 0.00006) * ARCSECOND
NU_OF_SUN = (-0.06424 + 0.00732) * ARCSECOND / MEAN_MOTION
ECCENTRICITY_OF_SUN = (-0.12879 + 0.00224) * ARCSECOND
SHIFTS = np.array(
    [NU_OF_SUN - M * NU, GAMMA, ECCENTRICITY, ECCENTRICITY_OF_SUN, 2 * ALPHA / (3 * M) * (NU_OF_SUN - M * NU)]
)


def numbers(text: str) -> list[float]:
    return [float(field) for field in text.split(",") if field.strip()]


def main_problem(source: str, coordinate: str) -> list[tuple]:
    table = re.search(rf"const MAIN_{coordinate}:.*?= &\[(.*?)\n\];", source, re.S).group(1)
    for multipliers, coefficients in re.findall(r"delaunay: \[([^\]]*)\],\s*coeffs: \[([^\]]*)\]", table):
        values = np.array(numbers(coefficients))
        is_distance = coordinate == "DISTANCE"
        amplitude = values[0] * (1 - 2 / 3 * NU if is_distance else 1) + values[1:6] @ SHIFTS
        yield amplitude, np.pi / 2 if is_distance else 0.0, [int(v) for v in numbers(multipliers)] + [0] * 9


def perturbations(source: str, coordinate: str, power: int) -> list[tuple]:
    table = re.search(rf"const PERT_{coordinate}_T{power}:.*?= &\[(.*?)\n?\];", source, re.S).group(1)
    pattern = r"amplitude: ([-\d.eE+]+),\s*phase: ([-\d.eE+]+),\s*multipliers: \[([^\]]*)\]"
    for amplitude, phase, multipliers in re.findall(pattern, table):
        yield float(amplitude), float(phase), [int(v) for v in numbers(multipliers)][:13]


def main() -> None:
    source = (unpack_from_crates_io("celestial-ephemeris", "0.1.1-alpha.2") / "src/lunar_coefficients/moon.rs").read_text()
    count, blocks = 0, []
    for index, (coordinate, cut) in enumerate(CUTS.items()):
        for power in range(4):
            terms = list(perturbations(source, coordinate, power))
            if power == 0:
                terms += main_problem(source, coordinate)
            terms = sorted((term for term in terms if abs(term[0]) >= cut), key=lambda term: abs(term[0]))
            if terms:
                blocks.append(struct.pack("<BBH", index, power, len(terms)))
                blocks += [struct.pack("<dd13b", amplitude, phase, *multipliers) for amplitude, phase, multipliers in terms]
                count += len(terms)
    (DATA / "moon_elp_mpp02.bin").write_bytes(b"".join(blocks))
    print(f"data/moon_elp_mpp02.bin: {count} terms")


if __name__ == "__main__":
    main()
